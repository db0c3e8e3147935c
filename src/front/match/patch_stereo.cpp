// Stereo matches of the patch matcher: along the row, coarse to fine, unique, checked from right to left, refined along
// the row only.
#include <cmath>

#include "front/match/patch_matcher.hpp"
#include "math/camera.hpp"

namespace semtrack {

namespace {

constexpr int kRowReach = 1;        // half-size rows: +-2 px about the calibrated offset
constexpr int kPredictedReach = 4;  // half-size px about a predicted disparity
constexpr int kMaxDistance = kCoarse * kCoarse * 28;
constexpr int kUniqueNumerator = 23;  // second best must be 15 % worse
constexpr int kUniqueDenominator = 20;
constexpr int kUniqueApart = 2;  // half-size px: nearer is the same minimum
constexpr float kMaxShift_px = 3.0F;
constexpr float kMinCorrelation = 0.80F;
constexpr float kNoise_grey = 4.0F;  // of a pixel's difference between the two cameras
constexpr float kMinSigma_px = 0.30F;
constexpr float kMaxSigma_px = 2.0F;

}  // namespace

bool PatchMatcher::search_row(const CoarsePatch& coarse, int y, int from, int to, bool unique, int& best_x,
                              float& offset) const {
    const CoarseTemplate patch(coarse);
    int best = kMaxDistance;
    int best_row = y;
    int second = 1 << 30;
    bool any = false;
    int previous_best_x = -1000;
    for (int row = y - kRowReach; row <= y + kRowReach; ++row) {
        for (int x = from; x <= to; ++x) {
            if (!coarse_inside(right_half_, x, row)) {
                continue;
            }
            const int d = patch.distance(right_half_, x, row);
            if (d < best) {
                if (x - previous_best_x > kUniqueApart || previous_best_x - x > kUniqueApart) {
                    second = best;
                }
                best = d;
                best_x = x;
                best_row = row;
                previous_best_x = x;
                any = true;
            } else if (d < second && (x - best_x > kUniqueApart || best_x - x > kUniqueApart)) {
                second = d;
            }
        }
    }
    if (any && unique && second < kMaxDistance * 2 && second * kUniqueDenominator < best * kUniqueNumerator) {
        return false;
    }
    if (!any) {
        return false;
    }
    const auto beside = [&](int dx) {
        return coarse_inside(right_half_, best_x + dx, best_row)
                   ? patch.distance(right_half_, best_x + dx, best_row)
                   : best;
    };
    offset = parabola_offset(beside(-1), best, beside(1));
    return true;
}

// The match of the match is where it started.
bool PatchMatcher::search_back(int x_right, int y, int from, int to, int x_left) const {
    CoarsePatch coarse;
    if (!coarse_inside(right_half_, x_right, y)) {
        return false;
    }
    copy_coarse(right_half_, x_right, y, coarse);
    const CoarseTemplate patch(coarse);
    int best = 1 << 30;
    int best_x = -1000;
    for (int x = from; x <= to; ++x) {
        if (!coarse_inside(left_half_, x, y)) {
            continue;
        }
        const int d = patch.distance(left_half_, x, y);
        if (d < best) {
            best = d;
            best_x = x;
        }
    }
    return best_x - x_left <= 1 && x_left - best_x <= 1;
}

bool PatchMatcher::match_stereo(const MatcherInput& in, int owner, FeatureSlot& slot, const Appearance& a,
                                float predicted_disparity, float& sigma_px) {
    if (in.right.empty()) {
        return false;
    }
    const Calibration& c = *in.calibration;
    const OwnerPrior& prior = (*in.priors)[static_cast<std::size_t>(owner)];
    const int x_left = coarse_corner(slot.u);
    const int y_left = coarse_corner(slot.v);
    if (!coarse_inside(left_half_, x_left, y_left)) {
        return false;
    }
    CoarsePatch patch;
    copy_coarse(left_half_, x_left, y_left, patch);
    const double fb = c.left.fx * c.baseline_m;
    const double shift = c.left.cx - c.right.cx;  // columns that belong to no disparity
    const bool predicted = predicted_disparity >= 0.0F;
    const double d_low =
        predicted ? static_cast<double>(predicted_disparity) - 2.0 * kPredictedReach : fb / prior.max_depth_m;
    const double d_high =
        predicted ? static_cast<double>(predicted_disparity) + 2.0 * kPredictedReach : fb / prior.min_depth_m;
    const int from = x_left - static_cast<int>(0.5 * (d_high + shift)) - 1;
    const int to = x_left - static_cast<int>(0.5 * (d_low + shift)) + 1;
    int x_right = 0;
    float offset = 0.0F;
    if (!search_row(patch, y_left, from, to, !predicted, x_right, offset)) {
        return false;
    }
    if (!predicted && !search_back(x_right, y_left, x_right + (x_left - to), x_right + (x_left - from), x_left)) {
        return false;
    }
    float u_right = slot.u + 2.0F * (static_cast<float>(x_right - x_left) + offset);
    const double v = static_cast<double>(slot.v);
    const double d_coarse = disparity(c, static_cast<double>(slot.u), static_cast<double>(u_right));
    const double v_centred = v - c.left.cy;
    const auto v_expected = static_cast<float>(right_row(c, v, d_coarse) + row_.at(v_centred));
    if (a.age != 0 || !template_.build(a.reference, 1.0F)) {
        ReferencePatch here;
        if (!take_reference(in.left, slot.u, slot.v, here) || !template_.build(here, 1.0F)) {
            return false;
        }
    }
    // Two-dimensional alignment only measures the row offset; the disparity comes from the row.
    float u_free = u_right;
    float v_free = v_expected;
    float ncc = 0.0F;
    if (template_.align(in.right, kMaxShift_px, u_free, v_free, ncc) && ncc > kMinCorrelation) {
        row_.add(v_centred, static_cast<double>(v_free - v_expected));
        u_right = u_free;
    }
    if (!template_.align_row(in.right, kMaxShift_px, u_right, v_expected, ncc) || ncc < kMinCorrelation) {
        return false;
    }
    const double d = disparity(c, static_cast<double>(slot.u), static_cast<double>(u_right));
    if (!(d > 0.25) || d > fb / 0.5) {
        return false;
    }
    slot.u_right = u_right;
    slot.v_right = v_expected;
    const float sigma = kNoise_grey / std::sqrt(template_.texture_u());
    sigma_px = sigma < kMinSigma_px ? kMinSigma_px : sigma > kMaxSigma_px ? kMaxSigma_px : sigma;
    return true;
}

}  // namespace semtrack
