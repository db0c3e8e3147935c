#include "sil/metrics/agreement.hpp"

#include <cmath>

namespace semtrack::sil {

namespace {

std::optional<double> mean_square(const TrajectoryErrors& e) {
    return e.rpe_trans_rms_m ? std::optional<double>(*e.rpe_trans_rms_m * *e.rpe_trans_rms_m) : std::nullopt;
}

}  // namespace

Agreement compare_with_others(const Trajectory& result, const std::vector<Trajectory>& others) {
    Agreement out;
    for (const Trajectory& other : others) {
        out.with.push_back(compare_trajectories(result, other));
    }
    if (others.size() != 2U) {
        return out;
    }
    const std::optional<double> ab = mean_square(out.with[0]);
    const std::optional<double> ac = mean_square(out.with[1]);
    const std::optional<double> bc = mean_square(compare_trajectories(others[0], others[1]));
    if (ab && ac && bc && *ab + *ac >= *bc) {
        out.own_error_rms_m = std::sqrt(0.5 * (*ab + *ac - *bc));
    }
    return out;
}

}  // namespace semtrack::sil
