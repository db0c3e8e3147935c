#include "sil/world/scene.hpp"

#include "sil/world/model_street.hpp"

namespace semtrack::sil::world {

namespace {

constexpr double kBehind_m = 30.0;
constexpr double kAhead_m = 170.0;  // beyond the last camera position
constexpr double kStep_m = 0.75;    // of a pedestrian
constexpr double kCrank_m = 5.0;    // per turn of the pedals

ShadowBlock shadow_of(const RoadUser& user, const Pose& T_n_m) {
    ShadowBlock b;
    b.x = static_cast<float>(T_n_m.t(0));
    b.z = static_cast<float>(T_n_m.t(2));
    b.along_x = static_cast<float>(T_n_m.R(0, 0));
    b.along_z = static_cast<float>(T_n_m.R(2, 0));
    b.half_length = static_cast<float>(0.5 * user.length);
    b.half_width = static_cast<float>(0.5 * user.width);
    b.height = static_cast<float>(user.height);
    return b;
}

}  // namespace

Scene::Scene(const Scenario& scenario, int frames) : scenario_(scenario) {
    ego_ = integrate(scenario.ego.motion, kRearAxleToCamera_m, frames);
    for (const RoadUser& u : scenario.users) {
        users_.push_back(integrate(u.motion, rear_axle_to_middle(u), frames));
    }
    double z_max = 0.0;
    double z_min = 0.0;
    for (const PathState& s : ego_) {
        z_max = s.z > z_max ? s.z : z_max;
        z_min = s.z < z_min ? s.z : z_min;
    }
    StreetModel model = make_street(scenario.street, z_min - kBehind_m, z_max + kAhead_m);
    still_ = std::move(model.pieces);
    houses_ = std::move(model.houses);
    crowns_ = std::move(model.crowns);
}

Pose Scene::T_n_m(std::size_t user, int frame) const {
    return user_pose(scenario_.street, this->user(user, frame));
}

FrameScene Scene::at(int frame) const {
    FrameScene out;
    out.T_n_c = T_n_c(frame);
    out.shadows = crowns_;
    for (std::size_t k = 0; k < scenario_.users.size(); ++k) {
        const RoadUser& u = scenario_.users[k];
        const Pose pose = T_n_m(k, frame);
        const double travelled = user(k, frame).travelled;
        const double gait = u.object_class == ObjectClass::kPedestrian ? travelled / kStep_m : travelled / kCrank_m;
        Pieces pieces = make_road_user(u.object_class, Vec3(u.length, u.width, u.height), u.look, gait);
        for (Piece& p : pieces) {
            p = transformed(p, pose);
        }
        out.users.push_back(std::move(pieces));
        out.T_n_m.push_back(pose);
        out.shadows.push_back(shadow_of(u, pose));
    }
    return out;
}

}  // namespace semtrack::sil::world
