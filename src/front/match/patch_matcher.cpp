// Following features in time, and bookkeeping. Stereo is in patch_stereo.cpp, jumps of the image in patch_jump.cpp.
#include "front/match/patch_matcher.hpp"

#include "math/camera.hpp"

namespace semtrack {

namespace {

constexpr int kFastThreshold = 10;
constexpr int kBorder_px = 14;
constexpr int kWideRadius = 10;             // half-size px: motion or depth are not known yet
constexpr std::uint8_t kMaxMissed = 2;      // frames that a feature is waited for
constexpr std::uint16_t kMinAgeToWait = 2;  // frames seen: younger ones were often no good
constexpr int kCandidates = 2;              // corners tried per missing feature of the background
constexpr std::uint32_t kRowsEvery = 4;     // a feature in four measures the row offset
constexpr int kMaxCoarseDistance = kCoarse * kCoarse * 26;
constexpr float kMaxShift_px = 3.0F;  // of the refinement: the coarse search is right to a pixel
constexpr float kMinCorrelation = 0.75F;
constexpr float kRenewCorrelation = 0.85F;
constexpr std::uint16_t kRenewAge = 6;  // frames: never renewing loses features, every frame makes them drift
constexpr float kRenewGrowth = 1.15F;
constexpr float kMinGrowth = 0.75F;
constexpr float kMaxGrowth = 1.3F;
constexpr double kFallbackDepth_m = 20.0;
constexpr float kSigma_px = 0.25F;

}  // namespace

void PatchMatcher::reset() {
    for (FeatureSlot& slot : table_.slots) {
        slot.live = false;
    }
    table_.next_id = 1;
    row_.reset();
    frames_ = 0;
}

float PatchMatcher::depth_of(const MatcherInput& in, const FeatureSlot& slot) const {
    if (!slot.stereo) {
        return 0.0F;
    }
    const double d = disparity(*in.calibration, static_cast<double>(slot.u), static_cast<double>(slot.u_right));
    return d > 0.5 ? static_cast<float>(depth_from_disparity(*in.calibration, d)) : 0.0F;
}

bool PatchMatcher::allowed(const MatcherInput& in, int owner, float u, float v) const {
    const int x = static_cast<int>(u + 0.5F);
    const int y = static_cast<int>(v + 0.5F);
    if (x < kBorder_px || y < kBorder_px || x >= in.left.width - kBorder_px || y >= in.left.height - kBorder_px) {
        return false;
    }
    const std::uint8_t here = in.mask_left->at(x, y);
    return owner == kBackground ? here == kBackground : here == owner || here == kNoOwner || here == kBackground;
}

// Median depth of an owner's features: for those without a stereo match.
double PatchMatcher::owner_depth(const MatcherInput& in, int owner) {
    int n = 0;
    for (int s = 0; s < feature_slots(owner); ++s) {
        const FeatureSlot& slot = table_.at(owner, s);
        const float z = slot.live ? depth_of(in, slot) : 0.0F;
        if (!(z > 0.0F)) {
            continue;
        }
        int k = n++;  // insertion keeps the list sorted; at most kMaxBackgroundFeatures
        for (; k > 0 && depths_[static_cast<std::size_t>(k - 1)] > z; --k) {
            depths_[static_cast<std::size_t>(k)] = depths_[static_cast<std::size_t>(k - 1)];
        }
        depths_[static_cast<std::size_t>(k)] = z;
    }
    return n > 0 ? static_cast<double>(depths_[static_cast<std::size_t>(n / 2)]) : kFallbackDepth_m;
}

bool PatchMatcher::search(const Appearance& a, float u, float v, int radius, Found& found) const {
    const CoarseTemplate patch(a.coarse);
    const int x0 = static_cast<int>((u - a.coarse_du) * 0.5F + 0.5F);
    const int y0 = static_cast<int>((v - a.coarse_dv) * 0.5F + 0.5F);
    int best = kMaxCoarseDistance;
    int best_x = 0;
    int best_y = 0;
    bool any = false;
    const int first = x0 > radius ? x0 - radius : 0;
    const int limit = left_half_.width() - kCoarse;
    const int last = x0 + radius < limit ? x0 + radius : limit;
    for (int y = y0 - radius; y <= y0 + radius; ++y) {
        if (y < 0 || y + kCoarse > left_half_.height()) {
            continue;
        }
        for (int x = first; x <= last; ++x) {
            const int d = patch.distance(left_half_, x, y, upright_rows_);
            if (d < best) {
                best = d;
                best_x = x;
                best_y = y;
                any = true;
            }
        }
    }
    if (!any) {
        return false;
    }
    const auto around = [&](int dx, int dy) {
        return coarse_inside(left_half_, best_x + dx, best_y + dy)
                   ? patch.distance(left_half_, best_x + dx, best_y + dy, upright_rows_)
                   : best;
    };
    found.u = 2.0F * (static_cast<float>(best_x) + parabola_offset(around(-1, 0), best, around(1, 0))) + a.coarse_du;
    found.v = 2.0F * (static_cast<float>(best_y) + parabola_offset(around(0, -1), best, around(0, 1))) + a.coarse_dv;
    return true;
}

bool PatchMatcher::predict(const MatcherInput& in, int owner, const FeatureSlot& slot, double fallback_depth_m,
                           Prediction& out) const {
    const Pose& T = (*in.priors)[static_cast<std::size_t>(owner)].T_cur_prev;
    const float depth = depth_of(in, slot);
    out.measured = depth > 0.0F;
    const Vec3 x_before = bearing(in.calibration->left, static_cast<double>(slot.u), static_cast<double>(slot.v)) *
                          (out.measured ? static_cast<double>(depth) : fallback_depth_m);
    const Vec3 x_now = is_finite(T) ? T * x_before : x_before;
    if (!(x_now(2) > kMinDepth_m)) {
        return false;
    }
    const Vec2 at = project(in.calibration->left, x_now);
    out.u = static_cast<float>(at(0)) + jump_u_;
    out.v = static_cast<float>(at(1)) + jump_v_;
    out.depth_m = static_cast<float>(x_now(2));
    return out.u > 0.0F && out.v > 0.0F && out.u < static_cast<float>(in.left.width) &&
           out.v < static_cast<float>(in.left.height);
}

bool PatchMatcher::locate(const MatcherInput& in, const Appearance& a, const Prediction& at, int radius, Found& found) {
    if (!search(a, at.u, at.v, radius, found)) {
        return false;
    }
    const float growth = a.reference_depth_m > 0.0F && at.measured ? a.reference_depth_m / at.depth_m : 1.0F;
    found.growth = growth < kMinGrowth ? kMinGrowth : growth > kMaxGrowth ? kMaxGrowth : growth;
    found.road = a.road && road_.may_show(found.v);
    const float inverse = 1.0F / found.growth;
    const PatchWarp warp = found.road ? road_.warp(found.u, found.v, found.growth) : PatchWarp{inverse, 0.0F, inverse};
    return template_.build(a.reference, warp) && template_.align(in.left, kMaxShift_px, found.u, found.v, found.ncc) &&
           found.ncc >= kMinCorrelation;
}

bool PatchMatcher::follow_one(const MatcherInput& in, int owner, int s, double fallback_depth_m) {
    FeatureSlot& slot = table_.at(owner, s);
    Appearance& a = looks_[static_cast<std::size_t>(first_feature_slot(owner) + s)];
    Prediction at;
    if (!predict(in, owner, slot, fallback_depth_m, at)) {
        return false;
    }
    const bool sure = owner == kBackground ? frames_ >= kStartFrames && at.measured : slot.age > 0;
    Found found;
    if (!locate(in, a, at, sure ? kRadius : kWideRadius, found) || !allowed(in, owner, found.u, found.v)) {
        return false;
    }
    FeatureMeasurement& m = now_[static_cast<std::size_t>(first_feature_slot(owner) + s)];
    m = FeatureMeasurement{};
    m.tracked = slot.missed == 0;
    slot.missed = 0;
    m.previous_u = slot.u;
    m.previous_v = slot.v;
    m.previous_u_right = slot.u_right;
    m.previous_stereo = slot.stereo;
    m.sigma_px = kSigma_px;
    m.correlation = found.ncc;
    slot.u = found.u;
    slot.v = found.v;
    slot.age = static_cast<std::uint16_t>(slot.age < 65535 ? slot.age + 1 : slot.age);
    ++a.age;
    remember_coarse(slot, a);
    const double d = in.calibration->left.fx * in.calibration->baseline_m / static_cast<double>(at.depth_m);
    RowMatch match;
    slot.stereo = at.measured
                      ? match_again(in, slot, found.road, static_cast<float>(d), slot.id % kRowsEvery == 0U, match)
                      : match_new(in, owner, slot, match);  // the depth was only a guess
    set_stereo(match, slot, m);
    const bool keep_scale = found.growth < kRenewGrowth && found.growth > 1.0F / kRenewGrowth;
    if (a.age >= kRenewAge || found.ncc < kRenewCorrelation || !keep_scale) {
        a.road = slot.stereo ? match.road : found.road;
        remember(in, slot, a, slot.stereo ? depth_of(in, slot) : at.measured ? at.depth_m : 0.0F);
    }
    return true;
}

// A feature of the background with a depth that was not found is looked for again where the motion takes it. Objects'
// motion is not known well enough: features that waited on a car passing by gave it a speed that was off by 3 m/s.
bool PatchMatcher::wait(const MatcherInput& in, int owner, FeatureSlot& slot, double fallback_depth_m) const {
    Prediction at;
    if (owner != kBackground || slot.missed >= kMaxMissed || slot.age < kMinAgeToWait ||
        !predict(in, owner, slot, fallback_depth_m, at) || !at.measured || !allowed(in, owner, at.u, at.v)) {
        return false;
    }
    ++slot.missed;
    slot.u = at.u;
    slot.v = at.v;
    slot.u_right =
        static_cast<float>(right_column(*in.calibration, static_cast<double>(at.u), static_cast<double>(at.depth_m)));
    return true;
}

void PatchMatcher::set_stereo(const RowMatch& match, FeatureSlot& slot, FeatureMeasurement& m) {
    m.stereo = slot.stereo;
    if (slot.stereo) {
        slot.u_right = match.u_right;
        slot.v_right = match.v_right;
        m.sigma_right_px = match.sigma_px;
    }
}

void PatchMatcher::remember(const MatcherInput& in, const FeatureSlot& slot, Appearance& a, float depth_m) const {
    if (!take_reference(in.left, slot.u, slot.v, a.reference)) {
        return;
    }
    a.reference_depth_m = depth_m;
    a.age = 0;
}

// The coarse patch is the newest one: it only has to be right to a pixel, so it may drift, and it follows the change of
// scale.
void PatchMatcher::remember_coarse(const FeatureSlot& slot, Appearance& a) const {
    const int x = coarse_corner(slot.u);
    const int y = coarse_corner(slot.v);
    if (!coarse_inside(left_half_, x, y)) {
        return;
    }
    copy_coarse(left_half_, x, y, upright_rows_, a.coarse);
    a.coarse_du = slot.u - 2.0F * static_cast<float>(x);
    a.coarse_dv = slot.v - 2.0F * static_cast<float>(y);
}

void PatchMatcher::follow(const MatcherInput& in, int owner) {
    const double fallback = owner_depth(in, owner);
    for (int s = 0; s < feature_slots(owner); ++s) {
        FeatureSlot& slot = table_.at(owner, s);
        if (!slot.live) {
            continue;
        }
        if (!follow_one(in, owner, s, fallback)) {
            slot.live = wait(in, owner, slot, fallback);
            if (!slot.live) {
                continue;
            }
        }
        selector_.occupy(owner, slot.u, slot.v);
    }
}

void PatchMatcher::add_new(const MatcherInput& in) {
    FeatureBudget budget{};
    std::array<int, static_cast<std::size_t>(kMaxOwners)> missing{};
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        const OwnerPrior& prior = (*in.priors)[static_cast<std::size_t>(owner)];
        int alive = 0;
        for (int s = 0; s < feature_slots(owner); ++s) {
            alive += table_.at(owner, s).live && table_.at(owner, s).missed == 0 ? 1 : 0;
        }
        const int wanted = prior.budget < feature_slots(owner) ? prior.budget : feature_slots(owner);
        const auto o = static_cast<std::size_t>(owner);
        missing[o] = prior.active && wanted > alive ? wanted - alive : 0;
        budget[o] = static_cast<std::int16_t>(missing[o] * (owner == kBackground ? kCandidates : 1));
    }
    if (fast_.detect(in.left, kFastThreshold, kBorder_px, corners_) != Status::kOk) {
        return;
    }
    selector_.select(corners_, in.mask_left->view(), budget, selected_);
    int owner = -1;
    int next = 0;
    for (const SelectedCorner& c : selected_) {
        const auto o = static_cast<std::size_t>(c.owner);
        if (c.owner != owner) {
            next = 0;
        }
        owner = c.owner;
        const int s = missing[o] > 0 ? table_.free_slot(owner, next) : -1;
        if (s < 0) {
            continue;
        }
        next = s;
        if (start(in, c, s)) {
            --missing[o];
        }
    }
}

bool PatchMatcher::start(const MatcherInput& in, const SelectedCorner& c, int s) {
    FeatureSlot& slot = table_.at(c.owner, s);
    Appearance& a = looks_[static_cast<std::size_t>(first_feature_slot(c.owner) + s)];
    slot.u = static_cast<float>(c.corner.x);
    slot.v = static_cast<float>(c.corner.y);
    RowMatch match;
    slot.stereo = match_new(in, c.owner, slot, match);
    FeatureMeasurement& m = now_[static_cast<std::size_t>(first_feature_slot(c.owner) + s)];
    m = FeatureMeasurement{};
    m.sigma_px = kSigma_px;
    set_stereo(match, slot, m);
    if (!in.right.empty() && c.owner == kBackground && (!slot.stereo || leaves(in, slot))) {
        return false;
    }
    slot.age = 0;
    slot.missed = 0;
    a.road = match.road;
    remember(in, slot, a, depth_of(in, slot));
    remember_coarse(slot, a);
    if (!slot.stereo && !template_.build(a.reference, PatchWarp{})) {
        return false;
    }
    slot.live = true;
    slot.id = table_.next_id++;
    return true;
}

// Whether the last motion, made once more, takes it out of the image.
bool PatchMatcher::leaves(const MatcherInput& in, const FeatureSlot& slot) const {
    const Pose& T = (*in.priors)[static_cast<std::size_t>(kBackground)].T_cur_prev;
    const float z = depth_of(in, slot);
    if (!is_finite(T) || !(z > 0.0F)) {
        return false;
    }
    const Vec3 x_next = T * (bearing(in.calibration->left, static_cast<double>(slot.u), static_cast<double>(slot.v)) *
                             static_cast<double>(z));
    if (!(x_next(2) > kMinDepth_m)) {
        return true;
    }
    const Vec2 at = project(in.calibration->left, x_next);
    return !(at(0) > kBorder_px) || !(at(1) > kBorder_px) || !(at(0) < in.left.width - kBorder_px) ||
           !(at(1) < in.left.height - kBorder_px);
}

void PatchMatcher::emit(int owner, int s, FrameFeatures& out) {
    const FeatureSlot& slot = table_.at(owner, s);
    FeatureMeasurement m = now_[static_cast<std::size_t>(first_feature_slot(owner) + s)];
    m.id = slot.id;
    m.slot = static_cast<std::int16_t>(s);
    m.owner = static_cast<std::uint8_t>(owner);
    m.age = slot.age;
    m.u = slot.u;
    m.v = slot.v;
    m.u_right = slot.u_right;
    m.v_right = slot.v_right;
    (void)out.try_push_back(m);
}

Status PatchMatcher::process(const MatcherInput& in, FrameFeatures& out) {
    out.clear();
    if (in.left.empty() || in.mask_left == nullptr || in.priors == nullptr || in.calibration == nullptr ||
        in.left.width > kMaxImageWidth || in.left.height > kMaxImageHeight || in.left.width < PatchImage::kMinSide_px ||
        in.left.height < PatchImage::kMinSide_px || in.mask_left->width != in.left.width ||
        in.mask_left->height != in.left.height ||
        (!in.right.empty() && (in.right.width != in.left.width || in.right.height != in.left.height))) {
        return Status::kInvalidArgument;
    }
    if (in.observer != nullptr) {
        in.observer->begin(Stage::kMatch);
    }
    road_ = RoadPlane(*in.calibration, in.camera_height_m);
    road_rows_ = CoarseRows(-road_.slope());
    left_half_.build(in.left);
    if (!in.right.empty()) {
        right_half_.build(in.right);
    }
    find_jump(in);
    selector_.begin(in.left.width, in.left.height);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        if ((*in.priors)[static_cast<std::size_t>(owner)].active) {
            follow(in, owner);
        } else {
            table_.clear_owner(owner);
        }
    }
    if (in.observer != nullptr) {
        in.observer->end(Stage::kMatch);
        in.observer->begin(Stage::kExtract);
    }
    add_new(in);
    row_.update();
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        for (int s = 0; s < feature_slots(owner); ++s) {
            if (table_.at(owner, s).live && table_.at(owner, s).missed == 0) {
                emit(owner, s, out);
            }
        }
    }
    if (in.observer != nullptr) {
        in.observer->end(Stage::kExtract);
    }
    frames_ += frames_ < kStartFrames ? 1 : 0;
    return Status::kOk;
}

}  // namespace semtrack
