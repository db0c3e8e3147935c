#include "sil/world/truth.hpp"

#include "math/trig.hpp"
#include "model/box_geometry.hpp"

namespace semtrack::sil::world {

namespace {

double truncation(const Calibration& c, const ObjectTruth& truth) {
    Box2d box;
    if (projected_box(c.left, truth.T_c_o, truth.size_m, box) != Status::kOk) {
        return 1.0;
    }
    Box2d inside;
    if (!clip_box(box, c.width, c.height, inside)) {
        return 1.0;
    }
    const auto area = [](const Box2d& b) { return (b.right - b.left) * (b.bottom - b.top); };
    const double whole = area(box);
    return whole > 0.0 ? 1.0 - area(inside) / whole : 0.0;
}

}  // namespace

RigidTransform ego_truth(const Scene& scene, int frame) {
    // The first frame is the identity to the last bit.
    if (frame == 0) {
        return RigidTransform{};
    }
    return to_rigid_transform(scene.T_n_c(0).inverse() * scene.T_n_c(frame));
}

ObjectTruth object_truth(const Scene& scene, std::size_t user, int frame) {
    const RoadUser& u = scene.scenario().users[user];
    const PathState& state = scene.user(user, frame);
    ObjectTruth t;
    t.frame = frame;
    t.id = u.id;
    t.speed = state.speed;
    t.yaw_rate = 0.0 - state.turn_rate;
    t.size_m = Vec3(u.length, u.width, u.height);
    t.T_c_o = scene.T_n_c(frame).inverse() * scene.T_n_m(user, frame);
    t.T_c_o.t = t.T_c_o * Vec3(0, 0, 0.5 * u.height);
    return t;
}

int occlusion_level(double visible_share) {
    return visible_share >= 0.85 ? 0 : (visible_share >= 0.5 ? 1 : (visible_share >= 0.1 ? 2 : 3));
}

const char* type_name(ObjectClass object_class) {
    switch (object_class) {
        case ObjectClass::kCar:
            return "Car";
        case ObjectClass::kVan:
            return "Van";
        case ObjectClass::kTruck:
            return "Truck";
        case ObjectClass::kPedestrian:
            return "Pedestrian";
        case ObjectClass::kCyclist:
            return "Cyclist";
        case ObjectClass::kTram:
            return "Tram";
        case ObjectClass::kMisc:
            break;
    }
    return "Misc";
}

Label make_label(const Scene& scene, const Calibration& calibration, std::size_t user, int frame,
                 const Silhouette& silhouette) {
    const RoadUser& u = scene.scenario().users[user];
    const ObjectTruth truth = object_truth(scene, user, frame);
    const Vec3 bottom = truth.T_c_o * Vec3(0, 0, -0.5 * u.height);
    Label l;
    l.frame = frame;
    l.id = u.id;
    l.type = type_name(u.object_class);
    l.truncated = truncation(calibration, truth);
    l.occluded = occlusion_level(silhouette.visible_share());
    l.box = silhouette.whole;
    l.height = u.height;
    l.width = u.width;
    l.length = u.length;
    l.x = bottom(0);
    l.y = bottom(1);
    l.z = bottom(2);
    l.rotation_y = atan2_rad(-truth.T_c_o.R(2, 0), truth.T_c_o.R(0, 0));
    l.alpha = wrap_angle(l.rotation_y - atan2_rad(l.x, l.z));
    if (u.object_class != ObjectClass::kPedestrian) {
        l.viewpoint = visible_faces(truth.T_c_o, truth.size_m);
        if (l.viewpoint.horizontal < 0) {
            l.viewpoint = Viewpoint{};  // the camera stands over the box: no class at all
        }
    }
    return l;
}

}  // namespace semtrack::sil::world
