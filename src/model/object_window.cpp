#include "model/object_window.hpp"

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/bicycle.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

Pose ObjectState::T_l_o() const {
    return {rot_z(theta), p};
}

ObjectState predicted_state(const ObjectState& x, ObjectClass object_class, const Vec3& size_m, double dt_s) {
    const ClassPrior& prior = class_prior(object_class);
    if (prior.motion == MotionModel::kPedestrian) {
        const SinCos h = sin_cos(x.theta);
        ObjectState next = x;
        next.p += Vec3(h.cos, h.sin, 0.0) * (x.v * dt_s);
        return next;
    }
    return bicycle_step(x, prior.wheelbase_ratio * size_m(0), dt_s);
}

void relevel(ObjectWindow& window, const Mat3& R_l_w_new) {
    const Mat3 R_new_old = R_l_w_new * window.R_l_w.transpose();
    for (ObjectFrame& frame : window.frames) {
        const SinCos h = sin_cos(frame.state.theta);
        const Vec3 heading = R_new_old * Vec3(h.cos, h.sin, 0.0);
        frame.state.theta = atan2_rad(heading(1), heading(0));
        frame.state.p = R_new_old * frame.state.p;
    }
    window.R_l_w = R_l_w_new;
}

void thin_out(ObjectWindow& window) {
    // The frame that is about to leave the dense part stays only when it is a stride away from the older neighbour.
    const int leaving = window.frames.size() - kObjectDenseFrames;
    if (leaving >= 1) {
        const std::uint32_t gap = window.frames[leaving].frame - window.frames[leaving - 1].frame;
        if (gap < static_cast<std::uint32_t>(kObjectFrameStride)) {
            window.frames.erase(leaving);
        }
    }
    if (window.frames.full()) {
        window.frames.erase(0);
    }
}

void change_object_frame(ObjectWindow& window, const Vec3& shift_o, double turn_rad) {
    const Mat3 R_new_old = rot_z(-turn_rad);
    for (ObjectFrame& frame : window.frames) {
        frame.state.p = frame.state.T_l_o() * shift_o;
        frame.state.theta = wrap_angle(frame.state.theta + turn_rad);
    }
    for (ObjectLandmark& landmark : window.landmarks) {
        if (landmark.valid) {
            landmark.f_o = R_new_old * (landmark.f_o - shift_o);
        }
    }
}

int find_frame(const ObjectWindow& window, std::uint32_t frame) {
    for (int i = window.frames.size() - 1; i >= 0; --i) {
        if (window.frames[i].frame == frame) {
            return i;
        }
    }
    return -1;
}

}  // namespace semtrack
