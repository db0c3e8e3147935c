#include "estimate/ego/ego_problem.hpp"

#include "math/robust.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr double kTukey = 4.0;  // sigmas
constexpr double kHuber = 3.5;  // sigmas of all six together: 95 %
// A point that falls behind a camera costs what an outlier costs.
constexpr double kBehindCost = 0.5 * kTukey * kTukey / 3.0;
constexpr int kMinSeen = 6;  // landmarks that a free frame must see

}  // namespace

void EgoProblem::take_landmarks(bool seen_now, int first_free, std::array<int, kEgoFrames>& seen_by_frame) {
    for (int l = 0; l < kEgoLandmarks && points_ < kSolverPoints; ++l) {
        const EgoLandmark& landmark = window_->landmarks[static_cast<std::size_t>(l)];
        if (!landmark.valid || window_->seen(l, window_->frames.back()).valid != seen_now) {
            continue;
        }
        int seen = 0;
        int seen_free = 0;
        for (int k = 0; k < frames_; ++k) {
            const bool valid = window_->seen(l, window_->frames[k]).valid;
            seen += valid ? 1 : 0;
            seen_free += valid && k >= first_free ? 1 : 0;
        }
        if (seen < 2 || seen_free < 1) {
            continue;
        }
        landmark_of_point_[static_cast<std::size_t>(points_)] = static_cast<std::int16_t>(l);
        current_.x_w[static_cast<std::size_t>(points_)] = landmark.x_w;
        for (int k = 0; k < frames_; ++k) {
            seen_by_frame[static_cast<std::size_t>(k)] += observation(points_, k).valid ? 1 : 0;
        }
        ++points_;
    }
}

void EgoProblem::begin(const EgoWindow& window, const Calibration& calibration) {
    window_ = &window;
    calibration_ = &calibration;
    frames_ = window.frames.size();
    points_ = 0;
    // The oldest pose is always held: without it the window could drift as a whole.
    const int first_free = frames_ - kFreeFrames > 1 ? frames_ - kFreeFrames : 1;
    std::array<int, kEgoFrames> seen_by_frame{};
    take_landmarks(true, first_free, seen_by_frame);
    take_landmarks(false, first_free, seen_by_frame);
    free_ = 0;
    for (int k = 0; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        current_.T_c_w[i] = window.frames[k].T_c_w;
        block_[i] = k >= first_free && seen_by_frame[i] >= kMinSeen ? free_++ : -1;
    }
}

void EgoProblem::store(EgoWindow& window) const {
    for (int k = 0; k < frames_; ++k) {
        window.frames[k].T_c_w = current_.T_c_w[static_cast<std::size_t>(k)];
    }
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        window.landmarks[static_cast<std::size_t>(landmark_of_point_[i])].x_w = current_.x_w[i];
    }
}

double EgoProblem::try_step(const SolverStep& step) {
    for (int k = 0; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        candidate_.T_c_w[i] = block_[i] < 0
                                  ? current_.T_c_w[i]
                                  : perturbed_left(current_.T_c_w[i], step.frame[static_cast<std::size_t>(block_[i])]);
    }
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        candidate_.x_w[i] = current_.x_w[i] + step.point[i];
    }
    return evaluate(candidate_, nullptr);
}

double EgoProblem::evaluate(const Variables& x, NormalEquations* system) const {
    if (system != nullptr) {
        system->clear(free_, points_, false);
    }
    double cost = 0.0;
    for (int p = 0; p < points_; ++p) {
        for (int k = 0; k < frames_; ++k) {
            if (observation(p, k).valid) {
                cost += add_observation(x, p, k, system);
            }
        }
    }
    for (int k = 1; k < frames_; ++k) {
        cost += add_vehicle_step(x, k, system);
    }
    return cost;
}

double EgoProblem::add_vehicle_step(const Variables& x, int k, NormalEquations* system) const {
    const EgoFrame& now = window_->frames[k];
    const int block = block_[static_cast<std::size_t>(k)];
    if (!now.step.valid || block < 0 || window_->frames[k - 1].frame != now.step_from) {
        return 0.0;
    }
    Vec6 e;
    Mat6 J_now;
    Mat6 J_before;
    vehicle_residual(x.T_c_w[static_cast<std::size_t>(k)], x.T_c_w[static_cast<std::size_t>(k - 1)], now.step, e, J_now,
                     J_before);
    const Vec6 weighted = now.step.information * e;
    const Robust rho = huber(e.dot(weighted), kHuber);
    if (system != nullptr) {
        const Mat6 wJ_now = rho.weight * now.step.information * J_now;
        system->add_frame(block, J_now.transpose() * wJ_now, rho.weight * J_now.transpose() * weighted);
        const int before = block_[static_cast<std::size_t>(k - 1)];
        if (before >= 0) {
            const Mat6 wJ_before = rho.weight * now.step.information * J_before;
            system->add_frame(before, J_before.transpose() * wJ_before, rho.weight * J_before.transpose() * weighted);
            system->add_frame_pair(before, block, J_before.transpose() * wJ_now);
        }
    }
    return 0.5 * rho.rho;
}

double EgoProblem::add_observation(const Variables& x, int p, int k, NormalEquations* system) const {
    const Pose& T = x.T_c_w[static_cast<std::size_t>(k)];
    const Vec3 x_c = T * x.x_w[static_cast<std::size_t>(p)];
    StereoPointResidual z;
    if (stereo_point_residual(*calibration_, x_c, observation(p, k).measurement(), system != nullptr, z) !=
        Status::kOk) {
        return kBehindCost;
    }
    const Robust rho = tukey(z.r.dot(z.r), kTukey);
    if (system != nullptr && rho.weight > 0.0) {
        const Mat3 J_x = z.J * T.R;
        const Mat3 wJ_x = rho.weight * J_x;
        system->add_point(p, J_x.transpose() * wJ_x, wJ_x.transpose() * z.r);
        const int block = block_[static_cast<std::size_t>(k)];
        if (block >= 0) {
            const Mat3x6 J = pose_jacobian(z.J, x_c);
            const Mat3x6 wJ = rho.weight * J;
            system->add_frame(block, J.transpose() * wJ, wJ.transpose() * z.r);
            system->add_frame_point(block, p, J.transpose() * wJ_x);
        }
    }
    return 0.5 * rho.rho;
}

}  // namespace semtrack
