#include "estimate/factor/size_prior.hpp"

#include "model/class_prior.hpp"

namespace semtrack {

namespace {
// Correlations of length, width, height over labelled cars; other classes take them too.
constexpr double kLengthWidth = 0.34;
constexpr double kLengthHeight = 0.14;
constexpr double kWidthHeight = 0.32;
}  // namespace

SizePrior size_prior(ObjectClass object_class) {
    const ClassPrior& prior = class_prior(object_class);
    Mat3 correlation;
    correlation << 1.0, kLengthWidth, kLengthHeight, kLengthWidth, 1.0, kWidthHeight, kLengthHeight, kWidthHeight, 1.0;
    const Mat3 sigma = prior.size_sigma_m.asDiagonal();
    const Mat3 covariance = sigma * correlation * sigma;
    return {prior.size_m, covariance, covariance.inverse()};
}

double size_prior_cost(const SizePrior& prior, const Vec3& size_m) {
    const Vec3 d = size_m - prior.mean_m;
    return d.dot(prior.information * d);
}

}  // namespace semtrack
