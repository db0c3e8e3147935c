#include "sil/report/tables.hpp"

#include <initializer_list>

#include "math/trig.hpp"
#include "sil/metrics/number_text.hpp"
#include "sil/report/picture_style.hpp"

namespace semtrack::sil {

namespace {

/// Fields with one separator between them.
class Fields {
public:
    explicit Fields(char separator) : separator_(separator) {}
    Fields& text(const char* value) {
        next();
        row_ += value;
        return *this;
    }
    Fields& integer(std::int64_t value) {
        next();
        row_ += std::to_string(value);
        return *this;
    }
    Fields& number(double value) {
        next();
        append_number(row_, value);
        return *this;
    }
    Fields& numbers(std::initializer_list<double> values) {
        for (const double v : values) {
            number(v);
        }
        return *this;
    }
    Fields& empty() { return text(""); }
    [[nodiscard]] std::string row() const { return row_ + "\n"; }

private:
    void next() {
        if (started_) {
            row_ += separator_;
        }
        started_ = true;
    }
    char separator_;
    bool started_{false};
    std::string row_;
};

/// "ok", or what is wrong in this frame.
std::string health_text(const Health& health) {
    std::string text;
    const auto add = [&text](bool flag, const char* word) {
        if (flag) {
            text += text.empty() ? "" : "+";
            text += word;
        }
    };
    add(health.ego_degraded, "ego_degraded");
    add(health.no_right_image, "no_right_image");
    add(health.no_detections, "no_detections");
    add(health.road_not_plane, "road_not_plane");
    add(health.can_state == CanState::kErrorPassive, "can_error_passive");
    add(health.can_state == CanState::kBusOff, "can_bus_off");
    add(health.can_state == CanState::kDown, "can_down");
    return text.empty() ? "ok" : text;
}

}  // namespace

KittiPlace kitti_place(const TrackedObject& object, const Pose& T_c_v, const std::array<double, 3>& t_c0_c) {
    const Vec3 bottom_v(object.position_v[0], object.position_v[1], object.position_v[2] - 0.5 * object.size[2]);
    const SinCos yaw = sin_cos(object.yaw_v);
    const Vec3 heading_c = T_c_v.R * Vec3(yaw.cos, yaw.sin, 0.0);
    KittiPlace place;
    place.bottom_c0 = T_c_v * bottom_v + Vec3(t_c0_c[0], t_c0_c[1], t_c0_c[2]);
    place.rotation_y = wrap_angle(atan2_rad(-heading_c(2), heading_c(0)));
    place.alpha = wrap_angle(place.rotation_y - atan2_rad(place.bottom_c0(0), place.bottom_c0(2)));
    return place;
}

std::string pose_row(const Pose& T) {
    Fields f(' ');
    for (int r = 0; r < 3; ++r) {
        f.numbers({T.R(r, 0), T.R(r, 1), T.R(r, 2), T.t(r)});
    }
    return f.row();
}

const char* ego_header() {
    return "frame,time_us,status,speed,yaw_rate,sigma_speed,sigma_yaw_rate,features,inliers,health\n";
}

std::string ego_row(int frame, const EgoState& ego, const Health& health) {
    Fields f(',');
    f.integer(frame).integer(ego.time_us).text(status_text(ego.status));
    if (ego.status == EgoStatus::kStart) {
        f.empty().empty().empty().empty();  // a first frame has no motion
    } else {
        f.numbers({ego.speed, ego.yaw_rate, ego.sigma_speed, ego.sigma_yaw_rate});
    }
    return f.integer(ego.features).integer(ego.inliers).text(health_text(health).c_str()).row();
}

bool belongs_in_objects(const TrackedObject& object) {
    return object.box_valid && (object.status == TrackStatus::kMeasured || object.status == TrackStatus::kCoasted);
}

std::string objects_row(int frame, const TrackedObject& o, const KittiPlace& place) {
    Fields f(' ');
    f.integer(frame).integer(o.id).text(class_text(o.object_class)).number(o.truncation).integer(o.occlusion);
    f.numbers({place.alpha, o.box.left, o.box.top, o.box.right, o.box.bottom, o.size[2], o.size[1], o.size[0]});
    f.numbers({place.bottom_c0(0), place.bottom_c0(1), place.bottom_c0(2), place.rotation_y, o.score, o.speed});
    return f.row();
}

const char* states_header() {
    return "frame,time_us,id,class,status,x,y,z,yaw,speed,steering,length,width,height,sigma_x,sigma_y,sigma_z,"
           "sigma_yaw,sigma_speed,existence,age\n";
}

std::string states_row(int frame, std::int64_t time_us, const TrackedObject& o) {
    Fields f(',');
    f.integer(frame).integer(time_us).integer(o.id).text(class_text(o.object_class)).text(status_text(o.status));
    f.numbers({o.position_w[0], o.position_w[1], o.position_w[2], o.yaw_w, o.speed});
    if (o.has_heading) {
        f.number(o.steering);
    } else {
        f.empty();  // a pedestrian does not steer
    }
    f.numbers({o.size[0], o.size[1], o.size[2]});
    f.numbers({o.sigma_position_w[0], o.sigma_position_w[1], o.sigma_position_w[2], o.sigma_yaw, o.sigma_speed});
    return f.number(o.existence).integer(o.age).row();
}

const char* points_header() {
    return "frame,owner,x,y,z\n";
}

std::string points_row(int frame, std::uint32_t owner, const SparsePoint& point) {
    Fields f(',');
    f.integer(frame).integer(owner);
    for (const float x : point.position_w) {
        f.number(static_cast<double>(x));
    }
    return f.row();
}

std::string timing_header() {
    std::string text = "frame,total_us";
    for (int s = 0; s < kStages; ++s) {
        text += std::string(",") + stage_name(static_cast<Stage>(s)) + "_us";
    }
    return text + ",objects,features\n";
}

std::string timing_row(int frame, const FrameTiming& timing, int objects, int features) {
    Fields f(',');
    f.integer(frame).number(timing.total_us);
    for (const double t : timing.stage_us) {
        f.number(t);
    }
    return f.integer(objects).integer(features).row();
}

}  // namespace semtrack::sil
