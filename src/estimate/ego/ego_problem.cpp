#include "estimate/ego/ego_problem.hpp"

#include "math/robust.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr double kTukey = 4.0;  // sigmas
constexpr int kHeldFrames = 2;  // the oldest: measured better than four
// A point that falls behind a camera costs what an outlier costs.
constexpr double kBehindCost = 0.5 * kTukey * kTukey / 3.0;

}  // namespace

void EgoProblem::begin(const EgoWindow& window, const Calibration& calibration) {
    window_ = &window;
    calibration_ = &calibration;
    frames_ = window.frames.size();
    fixed_ = frames_ > kHeldFrames + 1 ? kHeldFrames : 1;
    for (int k = 0; k < frames_; ++k) {
        current_.T_c_w[static_cast<std::size_t>(k)] = window.frames[k].T_c_w;
    }
    points_ = 0;
    for (int s = 0; s < kMaxBackgroundFeatures; ++s) {
        const EgoLandmark& landmark = window.landmarks[static_cast<std::size_t>(s)];
        if (!landmark.valid) {
            continue;
        }
        int seen = 0;
        for (int k = 0; k < frames_; ++k) {
            seen += landmark.seen[static_cast<std::size_t>(window.frames[k].column)].valid ? 1 : 0;
        }
        if (seen < 2) {
            continue;
        }
        slot_of_point_[static_cast<std::size_t>(points_)] = static_cast<std::int16_t>(s);
        current_.x_w[static_cast<std::size_t>(points_)] = landmark.x_w;
        ++points_;
    }
}

void EgoProblem::store(EgoWindow& window) const {
    for (int k = fixed_; k < frames_; ++k) {
        window.frames[k].T_c_w = current_.T_c_w[static_cast<std::size_t>(k)];
    }
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        window.landmarks[static_cast<std::size_t>(slot_of_point_[i])].x_w = current_.x_w[i];
    }
}

double EgoProblem::try_step(const SolverStep& step) {
    candidate_ = current_;
    for (int k = fixed_; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        candidate_.T_c_w[i] = perturbed_left(current_.T_c_w[i], step.frame[static_cast<std::size_t>(k - fixed_)]);
    }
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        candidate_.x_w[i] += step.point[i];
    }
    return evaluate(candidate_, nullptr);
}

double EgoProblem::evaluate(const Variables& x, NormalEquations* system) const {
    if (system != nullptr) {
        system->clear(frames_ - fixed_, points_, false);
    }
    double cost = 0.0;
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        const EgoLandmark& landmark = window_->landmarks[static_cast<std::size_t>(slot_of_point_[i])];
        for (int k = 0; k < frames_; ++k) {
            const EgoObservation& o = landmark.seen[static_cast<std::size_t>(window_->frames[k].column)];
            if (!o.valid) {
                continue;
            }
            const Pose& T = x.T_c_w[static_cast<std::size_t>(k)];
            const Vec3 x_c = T * x.x_w[i];
            StereoPointResidual z;
            if (stereo_point_residual(*calibration_, x_c, o.measurement(), system != nullptr, z) != Status::kOk) {
                cost += kBehindCost;
                continue;
            }
            const Robust rho = tukey(z.r.dot(z.r), kTukey);
            cost += 0.5 * rho.rho;
            if (system == nullptr || !(rho.weight > 0.0)) {
                continue;
            }
            const Mat3 J_x = z.J * T.R;
            const Vec3 wr = rho.weight * z.r;
            system->add_point(p, rho.weight * (J_x.transpose() * J_x), J_x.transpose() * wr);
            if (k < fixed_) {
                continue;
            }
            Mat3x6 J;  // by (translation, rotation): x_c' = x_c + t + w x x_c
            J.leftCols<3>() = z.J;
            J.rightCols<3>() = -(z.J * skew(x_c));
            system->add_frame(k - fixed_, rho.weight * (J.transpose() * J), J.transpose() * wr);
            system->add_frame_point(k - fixed_, p, rho.weight * (J.transpose() * J_x));
        }
    }
    return cost;
}

}  // namespace semtrack
