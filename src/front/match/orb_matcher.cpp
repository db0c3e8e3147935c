#include "front/match/orb_matcher.hpp"

#include <cmath>

#include "front/feature/brief.hpp"
#include "front/match/orb_refine.hpp"
#include "math/camera.hpp"

namespace semtrack {

namespace {

constexpr int kMaxDistance = 64;   // of 256 bits
constexpr int kRatioPercent = 85;  // best of second best
constexpr double kRowTolerance_px = 1.5;
constexpr double kSameCorner_px = 3.0;  // seen again on another level: no rival
constexpr float kMaxResidual = 18.0F;   // grey levels, after the refinement along the row
constexpr double kReach_px = 20.0;      // around the predicted position
constexpr double kWideReach_px = 80.0;  // where the owner's motion is not known yet
constexpr double kMonoFactor = 1.5;
constexpr int kKnownMotionPercent = 30;  // of live features found again
constexpr float kSigma_px = 0.6F;        // a corner at full resolution
constexpr float kSigmaRight_px = 0.5F;   // of u_right: refined at full resolution whatever the level
constexpr std::array<float, 8> kLevelScale{1.0F, 1.2F, 1.44F, 1.728F, 2.0736F, 2.48832F, 2.985984F, 3.5831808F};
constexpr double kFarthest_px = 1e5;

constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

double level_scale(int level) {
    return static_cast<double>(kLevelScale[at(level < 8 ? level : 7)]);
}

bool near_levels(int a, int b) {
    return a - b <= 1 && b - a <= 1;
}

bool fits(const ImageView& image, const OwnerMask* mask) {
    return mask != nullptr && image.width == mask->width && image.height == mask->height && image.width > 0 &&
           image.width <= kMaxImageWidth && image.height > 0 && image.height <= kMaxImageHeight &&
           image.stride >= image.width;
}

// An extractor from outside (hardware, another library) is not believed blindly.
bool keeps_contract(const Keypoints& points, const ImageView& image) {
    for (int i = 0; i < points.size(); ++i) {
        const Keypoint& k = points[i];
        const bool in_image = k.u > -0.5F && k.v > -0.5F && k.u < static_cast<float>(image.width) - 0.5F &&
                              k.v < static_cast<float>(image.height) - 0.5F;
        const bool in_order =
            i == 0 || points[i - 1].owner < k.owner || (points[i - 1].owner == k.owner && !(k.v < points[i - 1].v));
        if (!in_image || !in_order || k.owner >= kMaxOwners) {
            return false;
        }
    }
    return true;
}

bool convincing(int distance, int second) {
    return distance <= kMaxDistance && 100 * distance < kRatioPercent * second;
}

}  // namespace

void OrbMatcher::reset() {
    table_ = FeatureTable{};
    row_.reset();
    left_.clear();
    right_.clear();
}

Status OrbMatcher::extract(const MatcherInput& in) {
    FeatureBudget budget{};
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        const OwnerPrior& prior = (*in.priors)[at(owner)];
        const int slots = feature_slots(owner);
        const int wanted = prior.active && prior.budget > 0 ? prior.budget : 0;
        budget[at(owner)] = static_cast<std::int16_t>(wanted < slots ? wanted : slots);
    }
    right_.clear();
    Status status = extractor_->extract(in.left, in.mask_left->view(), budget, left_);
    if (status == Status::kOk && !in.right.empty()) {
        status = extractor_->extract(in.right, in.mask_right->view(), budget, right_);
    }
    if (status != Status::kOk) {
        return status;
    }
    const bool usable = keeps_contract(left_, in.left) && keeps_contract(right_, in.right);
    return usable ? Status::kOk : Status::kInvalidArgument;
}

// The right keypoint that fits best along the epipolar line, and the distance of its best rival elsewhere.
OrbMatcher::Candidate OrbMatcher::find_right(const MatcherInput& in, const Keypoint& k, double d_min,
                                             double d_max) const {
    const Calibration& c = *in.calibration;
    const auto u = static_cast<double>(k.u);
    const auto v = static_cast<double>(k.v);
    const double shift = row_.at(v - c.left.cy);
    const double near_row = right_row(c, v, d_max) + shift;
    const double far_row = right_row(c, v, d_min) + shift;
    const double widest = kRowTolerance_px * level_scale(k.level + 1);
    const double top = (near_row < far_row ? near_row : far_row) - widest;
    const double bottom = (near_row < far_row ? far_row : near_row) + widest;
    const KeypointRange band = rows_.band(top, bottom);
    Candidate best;
    for (int i = band.begin; i < band.end; ++i) {
        const Keypoint& r = right_[i];
        const double d = disparity(c, u, static_cast<double>(r.u));
        if (d < d_min || d > d_max || !near_levels(k.level, r.level)) {
            continue;
        }
        const double off = static_cast<double>(r.v) - right_row(c, v, d) - shift;
        if (std::fabs(off) > kRowTolerance_px * level_scale(k.level > r.level ? k.level : r.level)) {
            continue;
        }
        const int distance = hamming(k.descriptor, r.descriptor);
        const bool same =
            best.index >= 0 && std::fabs(static_cast<double>(r.u - right_[best.index].u)) < kSameCorner_px;
        if (distance < best.distance) {
            best.second = same ? best.second : best.distance;
            best.distance = distance;
            best.index = i;
        } else if (!same && distance < best.second) {
            best.second = distance;
        }
    }
    return best;
}

void OrbMatcher::refine_stereo(const MatcherInput& in, int left, int right) {
    const Calibration& c = *in.calibration;
    const Keypoint& k = left_[left];
    const Keypoint& r = right_[right];
    const auto v = static_cast<double>(k.v);
    const double d = disparity(c, static_cast<double>(k.u), static_cast<double>(r.u));
    const double row = right_row(c, v, d) + row_.at(v - c.left.cy);
    const int x_left = static_cast<int>(k.u + 0.5F);
    const int y_left = static_cast<int>(k.v + 0.5F);
    const double within = static_cast<double>(k.u) - x_left;  // of the pixel: both patches are cut at whole pixels
    const int x_right = static_cast<int>(std::floor(static_cast<double>(r.u) - within + 0.5));
    const int y_right = static_cast<int>(std::floor(row + (y_left - v) + 0.5));
    RowMatch found;
    if (!refine_along_row(in.left, x_left, y_left, in.right, x_right, y_right, 2 + k.level, found) ||
        found.residual > kMaxResidual) {
        return;
    }
    u_right_[at(left)] = found.x + static_cast<float>(within);
    v_right_[at(left)] = static_cast<float>(row);
    if (k.level == 0 && r.level == 0) {
        row_.add(v - c.left.cy, static_cast<double>(r.v) - row);
    }
}

void OrbMatcher::match_stereo(const MatcherInput& in, int owner) {
    const KeypointRange left = left_blocks_.of(owner);
    const KeypointRange right = right_blocks_.of(owner);
    const OwnerPrior& prior = (*in.priors)[at(owner)];
    const double fb = in.calibration->left.fx * in.calibration->baseline_m;
    const double d_min = fb / prior.max_depth_m;
    const double d_max = fb / prior.min_depth_m;
    if (right.begin == right.end || !(prior.min_depth_m > 0.0) || !(d_min <= d_max) || !(d_max < kFarthest_px)) {
        return;
    }
    rows_.build(right_, right, in.right.height);
    for (int i = right.begin; i < right.end; ++i) {
        claims_[at(i)] = Claim{};
    }
    for (int i = left.begin; i < left.end; ++i) {
        const Candidate best = find_right(in, left_[i], d_min, d_max);
        partner_[at(i)] = -1;
        if (best.index < 0 || !convincing(best.distance, best.second)) {
            continue;
        }
        partner_[at(i)] = static_cast<std::int16_t>(best.index);
        Claim& claim = claims_[at(best.index)];
        if (best.distance < claim.distance) {
            claim = {static_cast<std::int16_t>(i), static_cast<std::int16_t>(best.distance)};
        }
    }
    for (int i = left.begin; i < left.end; ++i) {
        if (partner_[at(i)] >= 0 && claims_[at(partner_[at(i)])].by == i) {
            refine_stereo(in, i, partner_[at(i)]);
        }
    }
}

// Mean inverse depth of the owner's features; without any, the middle of its range.
double OrbMatcher::owner_depth(const MatcherInput& in, int owner) {
    const Calibration& c = *in.calibration;
    const double fb = c.left.fx * c.baseline_m;
    double sum = 0.0;
    int count = 0;
    for (int s = 0; s < feature_slots(owner); ++s) {
        const FeatureSlot& slot = table_.at(owner, s);
        if (slot.live && slot.stereo) {
            sum += disparity(c, static_cast<double>(slot.u), static_cast<double>(slot.u_right));
            ++count;
        }
    }
    if (count > 0 && sum > 0.0) {
        return fb * count / sum;
    }
    const OwnerPrior& prior = (*in.priors)[at(owner)];
    const double inverse = 0.5 * (1.0 / prior.min_depth_m + 1.0 / prior.max_depth_m);
    return inverse > 0.0 ? 1.0 / inverse : 10.0;
}

bool OrbMatcher::predict(const MatcherInput& in, int owner, const FeatureSlot& slot, double fallback_depth_m,
                         Window& window) const {
    const Calibration& c = *in.calibration;
    const auto u = static_cast<double>(slot.u);
    double depth = fallback_depth_m;
    if (slot.stereo) {
        const double d = disparity(c, u, static_cast<double>(slot.u_right));
        depth = d > 0.1 ? depth_from_disparity(c, d) : 1000.0;
    }
    const Vec3 before = bearing(c.left, u, static_cast<double>(slot.v)) * depth;
    const Vec3 now = (*in.priors)[at(owner)].T_cur_prev * before;
    if (!(now(2) > kMinDepth_m)) {
        return false;
    }
    const Vec2 pixel = project(c.left, now);
    window.u = pixel(0);
    window.v = pixel(1);
    return std::fabs(window.u) < kFarthest_px && std::fabs(window.v) < kFarthest_px;
}

OrbMatcher::Candidate OrbMatcher::find_left(const Window& window, const Look& look) const {
    const KeypointRange band = rows_.band(window.v - window.half_height, window.v + window.half_height);
    Candidate best;
    for (int i = band.begin; i < band.end; ++i) {
        const Keypoint& k = left_[i];
        if (std::fabs(static_cast<double>(k.u) - window.u) > window.half_width ||
            std::fabs(static_cast<double>(k.v) - window.v) > window.half_height || !near_levels(k.level, look.level)) {
            continue;
        }
        const int distance = hamming(k.descriptor, look.descriptor);
        const bool same = best.index >= 0 &&
                          std::fabs(static_cast<double>(k.u - left_[best.index].u)) < kSameCorner_px &&
                          std::fabs(static_cast<double>(k.v - left_[best.index].v)) < kSameCorner_px;
        if (distance < best.distance) {
            best.second = same ? best.second : best.distance;
            best.distance = distance;
            best.index = i;
        } else if (!same && distance < best.second) {
            best.second = distance;
        }
    }
    return best;
}

// Returns how many live features were found; match_ and claims_ are written anew.
int OrbMatcher::follow(const MatcherInput& in, int owner, double reach_px) {
    const KeypointRange block = left_blocks_.of(owner);
    const int first = first_feature_slot(owner);
    const double fallback = owner_depth(in, owner);
    for (int i = block.begin; i < block.end; ++i) {
        claims_[at(i)] = Claim{};
    }
    for (int s = 0; s < feature_slots(owner); ++s) {
        const FeatureSlot& slot = table_.at(owner, s);
        match_[at(first + s)] = -1;
        Window window{};
        if (!slot.live || !predict(in, owner, slot, fallback, window)) {
            continue;
        }
        window.half_width = slot.stereo ? reach_px : kMonoFactor * reach_px;
        window.half_height = window.half_width;
        const Candidate best = find_left(window, looks_[at(first + s)]);
        if (best.index < 0 || !convincing(best.distance, best.second)) {
            continue;
        }
        match_[at(first + s)] = static_cast<std::int16_t>(best.index);
        Claim& claim = claims_[at(best.index)];
        if (best.distance < claim.distance) {
            claim = {static_cast<std::int16_t>(s), static_cast<std::int16_t>(best.distance)};
        }
    }
    int found = 0;
    for (int s = 0; s < feature_slots(owner); ++s) {
        std::int16_t& match = match_[at(first + s)];
        if (match >= 0 && claims_[at(match)].by != s) {
            match = -1;
        }
        found += match >= 0 ? 1 : 0;
    }
    return found;
}

void OrbMatcher::match_in_time(const MatcherInput& in, int owner) {
    int live = 0;
    for (int s = 0; s < feature_slots(owner); ++s) {
        live += table_.at(owner, s).live ? 1 : 0;
    }
    rows_.build(left_, left_blocks_.of(owner), in.left.height);
    if (100 * follow(in, owner, kReach_px) < kKnownMotionPercent * live) {
        (void)follow(in, owner, kWideReach_px);
    }
}

// Features that were not found lose their slot; keypoints that continue none get a free one.
void OrbMatcher::assign_slots(int owner) {
    const KeypointRange block = left_blocks_.of(owner);
    const int first = first_feature_slot(owner);
    for (int i = block.begin; i < block.end; ++i) {
        slot_of_[at(i)] = -1;
    }
    for (int s = 0; s < feature_slots(owner); ++s) {
        const int match = match_[at(first + s)];
        table_.at(owner, s).live = match >= 0;
        if (match >= 0) {
            slot_of_[at(match)] = static_cast<std::int16_t>(s);
        }
    }
    int free = table_.free_slot(owner);
    for (int i = block.begin; i < block.end && free >= 0; ++i) {
        if (slot_of_[at(i)] >= 0) {
            continue;
        }
        FeatureSlot& slot = table_.at(owner, free);
        slot = FeatureSlot{};
        slot.live = true;
        slot.id = table_.next_id++;
        match_[at(first + free)] = static_cast<std::int16_t>(i);
        slot_of_[at(i)] = static_cast<std::int16_t>(free);
        free = table_.free_slot(owner, free + 1);
    }
}

void OrbMatcher::emit(int owner, FrameFeatures& out) {
    const int first = first_feature_slot(owner);
    for (int s = 0; s < feature_slots(owner); ++s) {
        FeatureSlot& slot = table_.at(owner, s);
        if (!slot.live) {
            continue;
        }
        const int i = match_[at(first + s)];
        const Keypoint& k = left_[i];
        const float scale = kLevelScale[at(k.level < 8 ? k.level : 7)];
        FeatureMeasurement m = continued(slot, owner, s);
        m.u = k.u;
        m.v = k.v;
        m.stereo = u_right_[at(i)] >= 0.0F;
        m.u_right = m.stereo ? u_right_[at(i)] : 0.0F;
        m.v_right = m.stereo ? v_right_[at(i)] : 0.0F;
        m.sigma_px = kSigma_px * scale;
        m.sigma_right_px = kSigmaRight_px;
        store(m, slot);
        looks_[at(first + s)] = {k.descriptor, k.level};
        if (!out.try_push_back(m)) {
            return;
        }
    }
}

Status OrbMatcher::process(const MatcherInput& in, FrameFeatures& out) {
    if (extractor_ == nullptr || in.priors == nullptr || in.calibration == nullptr || in.left.empty() ||
        !fits(in.left, in.mask_left) || (!in.right.empty() && !fits(in.right, in.mask_right))) {
        return Status::kInvalidArgument;
    }
    if (in.observer != nullptr) {
        in.observer->begin(Stage::kExtract);
    }
    const Status status = extract(in);
    if (in.observer != nullptr) {
        in.observer->end(Stage::kExtract);
    }
    if (status != Status::kOk) {
        return status;
    }
    if (in.observer != nullptr) {
        in.observer->begin(Stage::kMatch);
    }
    out.clear();
    left_blocks_.build(left_);
    right_blocks_.build(right_);
    u_right_.fill(-1.0F);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        if (!(*in.priors)[at(owner)].active) {
            table_.clear_owner(owner);
            continue;
        }
        match_in_time(in, owner);
        assign_slots(owner);
        match_stereo(in, owner);
        emit(owner, out);
    }
    row_.update();
    if (in.observer != nullptr) {
        in.observer->end(Stage::kMatch);
    }
    return Status::kOk;
}

}  // namespace semtrack
