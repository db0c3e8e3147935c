// Stereo matches of the patch matcher: along the row, coarse to fine, unique, checked from right to left, refined along
// the row only. Patches of the background are tried upright and as road; the better correlation decides.
#include <cmath>

#include "front/match/patch_matcher.hpp"
#include "math/camera.hpp"

namespace semtrack {

namespace {

constexpr int kRowReach = 1;           // half-size rows: +-2 px about the calibrated offset
constexpr double kPredictedReach = 8;  // px about a predicted disparity
constexpr int kMaxDistance = kCoarse * kCoarse * 28;
constexpr int kUniqueNumerator = 23;  // second best must be 15 % worse
constexpr int kUniqueDenominator = 20;
constexpr int kUniqueApart = 2;  // half-size px: nearer is the same minimum
constexpr float kMaxShift_px = 3.0F;
constexpr float kMinCorrelation = 0.80F;
constexpr float kMinRoadCorrelation = 0.85F;
constexpr double kRoadReach_px = 4.0;  // of the road's disparity: a pitch of 1 deg moves the horizon by 12 rows
constexpr double kRoadReach = 0.15;    // ... and slopes
constexpr float kNoise_grey = 4.0F;    // of a pixel's difference between the two cameras
constexpr float kMinSigma_px = 0.30F;
constexpr float kMaxSigma_px = 2.0F;
constexpr double kNearest_m = 0.5;

}  // namespace

bool PatchMatcher::search_row(const CoarsePatch& coarse, const CoarseRows& rows, int y, RowRange range, bool unique,
                              int& best_x, float& offset) const {
    const CoarseTemplate patch(coarse);
    int best = kMaxDistance;
    int best_row = y;
    int second = 1 << 30;
    bool any = false;
    for (int row = y - kRowReach; row <= y + kRowReach; ++row) {
        if (row < 0 || row + kCoarse > right_half_.height()) {
            continue;
        }
        const int first = range.from > rows.margin() ? range.from : rows.margin();
        const int limit = right_half_.width() - kCoarse - rows.margin();
        const int last = range.to < limit ? range.to : limit;
        for (int x = first; x <= last; ++x) {
            const int d = patch.distance(right_half_, x, row, rows);
            const bool apart = x - best_x > kUniqueApart || best_x - x > kUniqueApart;
            if (d < best) {
                second = any && apart ? best : second;
                best = d;
                best_x = x;
                best_row = row;
                any = true;
            } else if (d < second && apart) {
                second = d;
            }
        }
    }
    if (!any || (unique && second < kMaxDistance * 2 && second * kUniqueDenominator < best * kUniqueNumerator)) {
        return false;
    }
    const auto beside = [&](int dx) {
        return rows.inside(right_half_, best_x + dx, best_row)
                   ? patch.distance(right_half_, best_x + dx, best_row, rows)
                   : best;
    };
    offset = parabola_offset(beside(-1), best, beside(1));
    return true;
}

// The match of the match is where it started.
bool PatchMatcher::search_back(const CoarseRows& rows, int x_right, int y, RowRange range, int x_left) const {
    CoarsePatch coarse;
    if (!rows.inside(right_half_, x_right, y)) {
        return false;
    }
    copy_coarse(right_half_, x_right, y, rows, coarse);
    const CoarseTemplate patch(coarse);
    int best = 1 << 30;
    int best_x = -1000;
    const int first = range.from > 0 ? range.from : 0;
    const int limit = left_half_.width() - kCoarse;
    const int last = range.to < limit ? range.to : limit;
    for (int x = first; x <= last; ++x) {
        const int d = patch.distance(left_half_, x, y, upright_rows_);
        if (d < best) {
            best = d;
            best_x = x;
        }
    }
    return best_x - x_left <= 1 && x_left - best_x <= 1;
}

// From a place that is right to a few px to a sub-pixel one.
bool PatchMatcher::refine(const MatcherInput& in, const FeatureSlot& slot, RowMatch& match) {
    const Calibration& c = *in.calibration;
    const double u = static_cast<double>(slot.u);
    const double v = static_cast<double>(slot.v);
    const double d_coarse = disparity(c, u, static_cast<double>(match.u_right));
    match.v_right = static_cast<float>(right_row(c, v, d_coarse) + row_.at(v - c.left.cy));
    if (!template_.build_at(in.left, slot.u, slot.v, match.road ? road_.slope() : 0.0F) ||
        !template_.align_row(in.right, kMaxShift_px, match.u_right, match.v_right, match.ncc) ||
        match.ncc < (match.road ? kMinRoadCorrelation : kMinCorrelation)) {
        return false;
    }
    const double d = disparity(c, u, static_cast<double>(match.u_right));
    if (!(d > 0.25) || d > c.left.fx * c.baseline_m / kNearest_m) {
        return false;
    }
    const float sigma = kNoise_grey / std::sqrt(template_.texture_u());
    match.sigma_px = sigma < kMinSigma_px ? kMinSigma_px : sigma > kMaxSigma_px ? kMaxSigma_px : sigma;
    return true;
}

// Two-dimensional alignment of the template that refine() made; it only measures the row offset.
void PatchMatcher::measure_row_offset(const MatcherInput& in, const FeatureSlot& slot, const RowMatch& match) {
    float u = match.u_right;
    float v = match.v_right;
    float ncc = 0.0F;
    if (template_.align(in.right, kMaxShift_px, u, v, ncc) && ncc > kMinCorrelation) {
        row_.add(static_cast<double>(slot.v) - in.calibration->left.cy, static_cast<double>(v - match.v_right));
    }
}

bool PatchMatcher::match_between(const MatcherInput& in, const FeatureSlot& slot, bool road, double d_low,
                                 double d_high, bool unique, RowMatch& out) {
    const int x_left = coarse_corner(slot.u);
    const int y = coarse_corner(slot.v);
    if (!coarse_inside(left_half_, x_left, y)) {
        return false;
    }
    CoarsePatch coarse;
    copy_coarse(left_half_, x_left, y, upright_rows_, coarse);
    const double shift = in.calibration->left.cx - in.calibration->right.cx;  // columns that belong to no disparity
    const RowRange range{x_left - static_cast<int>(0.5 * (d_high + shift)) - 1,
                         x_left - static_cast<int>(0.5 * (d_low + shift)) + 1};
    const CoarseRows& rows = road ? road_rows_ : upright_rows_;
    int x_right = 0;
    float offset = 0.0F;
    if (!search_row(coarse, rows, y, range, unique, x_right, offset)) {
        return false;
    }
    const RowRange back{x_right + (x_left - range.to), x_right + (x_left - range.from)};
    if (unique && !search_back(rows, x_right, y, back, x_left)) {
        return false;
    }
    out.road = road;
    out.u_right = slot.u + 2.0F * (static_cast<float>(x_right - x_left) + offset);
    return refine(in, slot, out);
}

bool PatchMatcher::match_again(const MatcherInput& in, const FeatureSlot& slot, bool road, float disparity_px,
                               bool measure_rows, RowMatch& out) {
    const double d = static_cast<double>(disparity_px);
    if (in.right.empty() || !match_between(in, slot, road, d - kPredictedReach, d + kPredictedReach, false, out)) {
        return false;
    }
    if (measure_rows) {
        measure_row_offset(in, slot, out);
    }
    return true;
}

bool PatchMatcher::match_new(const MatcherInput& in, int owner, const FeatureSlot& slot, RowMatch& out) {
    if (in.right.empty()) {
        return false;
    }
    const OwnerPrior& prior = (*in.priors)[static_cast<std::size_t>(owner)];
    const double fb = in.calibration->left.fx * in.calibration->baseline_m;
    const double d_low = fb / prior.max_depth_m;
    const double d_high = fb / prior.min_depth_m;
    bool found = match_between(in, slot, false, d_low, d_high, true, out);
    if (found) {
        measure_row_offset(in, slot, out);
    }
    if (owner == kBackground && road_.may_show(slot.v)) {
        const double d = static_cast<double>(road_.disparity(slot.v));
        const double reach = kRoadReach_px + kRoadReach * d;
        RowMatch other;
        if (match_between(in, slot, true, d - reach > d_low ? d - reach : d_low,
                          d + reach < d_high ? d + reach : d_high, true, other) &&
            (!found || other.ncc > out.ncc)) {
            out = other;
            found = true;
        }
    }
    return found;
}

}  // namespace semtrack
