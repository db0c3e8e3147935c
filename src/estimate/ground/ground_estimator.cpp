#include "estimate/ground/ground_estimator.hpp"

#include <cmath>

#include "math/robust.hpp"

namespace semtrack {

namespace {

// Roads keep their slope against the vehicle within 0.7 degrees (pitch of a car that brakes included), their crown and
// the vehicle's roll within 1.7.
constexpr double kSlopeForwardSigma = 0.012;
constexpr double kSlopeLeftSigma = 0.03;
constexpr double kMemory_s = 0.4;
constexpr double kHuber = 2.0;  // sigmas: a car on a drive-way, or of another size than its class

// To 2^-16. Sums of such numbers below 2^36 are exact, so that the order of the slots does not change a bit.
template <class Matrix>
Matrix rounded(const Matrix& m) {
    constexpr double kMagic = 1.5 * 68719476736.0;  // 1.5 * 2^36: its last bit is worth 2^-16
    Matrix out;
    for (int i = 0; i < static_cast<int>(m.size()); ++i) {
        const double shifted = m(i) + kMagic;
        out(i) = shifted - kMagic;
    }
    return out;
}

}  // namespace

void GroundEstimator::init(const Config& config) {
    mean_ = Vec3(config.camera_height_m, 0.0, 0.0);
    vehicle_ = mean_;
    const Vec3 sigma(config.camera_height_sigma_m, kSlopeForwardSigma, kSlopeLeftSigma);
    fresh_ = 1.0;
    prior_ = Evidence{};
    prior_.information = sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
    all_ = Evidence{};
    road_ = Evidence{};
    of_slot_.fill(Evidence{});
}

void GroundEstimator::fade(double dt_s) {
    const double keep = 1.0 / (1.0 + (dt_s > 0.0 ? dt_s : 0.0) / kMemory_s);
    fresh_ = 1.0 - keep;
    for (Evidence* e : {&all_, &road_}) {
        e->information *= keep;
        e->vector *= keep;
    }
    for (Evidence& e : of_slot_) {
        e.information *= keep;
        e.vector *= keep;
    }
}

void GroundEstimator::add(int slot, const Pose& T_c_l, const Vec3& x_l, double sigma_m) {
    const Vec3 camera_l = -(T_c_l.R.transpose() * T_c_l.t);
    const Vec3 a = ground_row(T_c_l, x_l);
    const GroundPlane others = plane(slot);
    const Vec3 theta(others.height_m, others.slope_forward, others.slope_left);
    const double height = x_l(2) - camera_l(2);
    const double r = height - a.dot(theta);
    const double variance = sigma_m * sigma_m + a.dot(others.covariance * a);
    if (!(sigma_m > 0.0) || !std::isfinite(variance) || !std::isfinite(r)) {
        return;
    }
    const bool of_object = slot >= 0 && slot < kMaxObjects;
    Evidence& e = of_object ? of_slot_[static_cast<std::size_t>(slot)] : all_;
    const bool first = of_object && e.information(0, 0) == 0.0;
    const double share = of_object && !first ? fresh_ : 1.0;
    const double w = share * huber(r * r / variance, kHuber).weight / (sigma_m * sigma_m);
    e.information += w * (a * a.transpose());
    e.vector += (w * height) * a;
}

bool GroundEstimator::add_road(const RoadPoints& points, std::uint32_t seed) {
    const RoadFit fit = fit_road(points, {vehicle_, prior_.information}, seed);
    if (!fit.valid) {
        return false;
    }
    const double share = road_.information(0, 0) == 0.0 ? 1.0 : fresh_;
    road_.information += share * fit.information;
    road_.vector += share * fit.vector;
    return true;
}

void GroundEstimator::set_vehicle(double slope_forward, double slope_left) {
    if (std::isfinite(slope_forward) && std::isfinite(slope_left)) {
        vehicle_(1) = slope_forward;
        vehicle_(2) = slope_left;
    }
}

void GroundEstimator::release(int slot) {
    Evidence& e = of_slot_[static_cast<std::size_t>(slot)];
    all_.information += e.information;
    all_.vector += e.vector;
    e = Evidence{};
}

GroundPlane GroundEstimator::plane(int without_slot) const {
    Mat3 of_objects = Mat3::Zero();
    Vec3 vector_of_objects = Vec3::Zero();
    for (int s = 0; s < kMaxObjects; ++s) {
        if (s != without_slot) {
            of_objects += rounded(of_slot_[static_cast<std::size_t>(s)].information);
            vector_of_objects += rounded(of_slot_[static_cast<std::size_t>(s)].vector);
        }
    }
    const Mat3 information = prior_.information + all_.information + road_.information + of_objects;
    const Vec3 vector = prior_.information * mean_ + all_.vector + road_.vector + vector_of_objects;
    GroundPlane out;
    out.valid = true;
    out.covariance = information.inverse();
    const Vec3 theta = out.covariance * vector;
    out.height_m = theta(0);
    out.slope_forward = theta(1);
    out.slope_left = theta(2);
    return out;
}

}  // namespace semtrack
