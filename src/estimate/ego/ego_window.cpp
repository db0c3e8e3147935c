#include "estimate/ego/ego_window.hpp"

#include <cmath>

#include "math/camera.hpp"

namespace semtrack {

namespace {

constexpr double kMinBirthDisparity_px = 1.5;
// Far points hold the rotation, near ones the motion: a disparity's bias of 0.05 px is 1 % of the depth at 80 m.
constexpr double kNearDisparity_px = 20.0;
constexpr float kFarFactor = 4.0F;
constexpr double kMinDisparity_px = -2.0;  // below, it is no noise but a wrong match
constexpr float kMinSigma_px = 0.01F;

bool usable(const FeatureMeasurement& m) {
    return m.owner == kBackground && m.slot >= 0 && m.slot < kMaxBackgroundFeatures && std::isfinite(m.u) &&
           std::isfinite(m.v) && std::isfinite(m.sigma_px) && m.sigma_px > kMinSigma_px;
}

bool usable_right(const FeatureMeasurement& m, double disparity_px) {
    return m.stereo && std::isfinite(m.u_right) && std::isfinite(m.sigma_right_px) && m.sigma_right_px > kMinSigma_px &&
           disparity_px > kMinDisparity_px;
}

}  // namespace

StereoPointMeasurement EgoObservation::measurement() const {
    StereoPointMeasurement z;
    z.u = static_cast<double>(u);
    z.v = static_cast<double>(v);
    z.u_right = static_cast<double>(u_right);
    z.stereo = stereo;
    z.sigma_px = static_cast<double>(sigma_px);
    z.sigma_right_px = static_cast<double>(sigma_right_px);
    return z;
}

void EgoLandmark::forget() {
    valid = false;
    for (EgoObservation& o : seen) {
        o.valid = false;
    }
}

void EgoLandmark::release() {
    used = false;
    slot = -1;
    forget();
}

void EgoWindow::clear() {
    frames.clear();
    for (EgoLandmark& landmark : landmarks) {
        landmark.release();
    }
    landmark_of_slot.fill(-1);
}

int EgoWindow::leaving() const {
    const int oldest_dense = frames.size() - kDenseFrames;
    if (oldest_dense >= 0 && !frames[oldest_dense].keyframe) {
        return oldest_dense;
    }
    return frames.full() ? 0 : -1;
}

void EgoWindow::drop(int index) {
    const auto column = static_cast<std::size_t>(frames[index].column);
    for (EgoLandmark& landmark : landmarks) {
        landmark.seen[column].valid = false;
    }
    frames.erase(index);
}

void EgoWindow::push(std::uint32_t frame, const Pose& T_c_w) {
    std::array<bool, kEgoFrames> used{};
    for (const EgoFrame& f : frames) {
        used[static_cast<std::size_t>(f.column)] = true;
    }
    EgoFrame now;
    now.frame = frame;
    now.T_c_w = T_c_w;
    for (int c = kEgoFrames - 1; c >= 0; --c) {
        now.column = used[static_cast<std::size_t>(c)] ? now.column : c;
    }
    (void)frames.try_push_back(now);  // never full: leaving() went
}

// Landmarks without a feature that fewer than two frames of the window have seen say nothing any more.
void EgoWindow::release_unseen() {
    for (EgoLandmark& landmark : landmarks) {
        if (!landmark.used || landmark.slot >= 0) {
            continue;
        }
        int seen = 0;
        for (const EgoObservation& o : landmark.seen) {
            seen += o.valid ? 1 : 0;
        }
        if (seen < 2 || !landmark.valid) {
            landmark.release();
        }
    }
}

// From `from` on, else the oldest without a feature: there are twice as many landmarks as features.
int EgoWindow::free_landmark(int from) const {
    for (int k = from; k < kEgoLandmarks; ++k) {
        if (!landmarks[static_cast<std::size_t>(k)].used) {
            return k;
        }
    }
    int oldest = 0;
    bool any = false;
    for (int k = 0; k < kEgoLandmarks; ++k) {
        const EgoLandmark& landmark = landmarks[static_cast<std::size_t>(k)];
        if (landmark.slot < 0 && (!any || landmark.id < landmarks[static_cast<std::size_t>(oldest)].id)) {
            oldest = k;
            any = true;
        }
    }
    return oldest;
}

void EgoWindow::take(const FrameFeatures& features, const Calibration& calibration) {
    release_unseen();
    const auto column = static_cast<std::size_t>(frames.back().column);
    int free_from = 0;
    for (const FeatureMeasurement& m : features) {
        if (!usable(m)) {
            continue;
        }
        std::int16_t& index = landmark_of_slot[static_cast<std::size_t>(m.slot)];
        if (index < 0 || landmarks[static_cast<std::size_t>(index)].id != m.id) {
            if (index >= 0) {
                landmarks[static_cast<std::size_t>(index)].slot = -1;
            }
            index = static_cast<std::int16_t>(free_landmark(free_from));
            free_from = index + 1;
            EgoLandmark& landmark = landmarks[static_cast<std::size_t>(index)];
            landmark.release();
            landmark.used = true;
            landmark.id = m.id;
            landmark.slot = m.slot;
        }
        const double d = disparity(calibration, static_cast<double>(m.u), static_cast<double>(m.u_right));
        EgoObservation& o = landmarks[static_cast<std::size_t>(index)].seen[column];
        o.valid = true;
        o.stereo = usable_right(m, d);
        o.u = m.u;
        o.v = m.v;
        o.u_right = o.stereo ? m.u_right : 0.0F;
        o.sigma_px = m.sigma_px;
        o.sigma_right_px = o.stereo ? m.sigma_right_px * (d < kNearDisparity_px ? kFarFactor : 1.0F) : 1.0F;
    }
}

void EgoWindow::give_birth(const Calibration& calibration) {
    const EgoFrame& frame = frames.back();
    const Pose T_w_c = frame.T_c_w.inverse();
    for (EgoLandmark& landmark : landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
        if (landmark.valid || !o.valid || !o.stereo) {
            continue;
        }
        const double u = static_cast<double>(o.u);
        const double v = static_cast<double>(o.v);
        const double d = disparity(calibration, u, static_cast<double>(o.u_right));
        if (!(d > kMinBirthDisparity_px)) {
            continue;
        }
        landmark.x_w = T_w_c * (bearing(calibration.left, u, v) * depth_from_disparity(calibration, d));
        landmark.valid = true;
    }
}

int EgoWindow::last_keyframe() const {
    for (int k = frames.size() - 2; k >= 0; --k) {
        if (frames[k].keyframe) {
            return k;
        }
    }
    return -1;
}

}  // namespace semtrack
