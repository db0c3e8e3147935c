// A bump, or a turn that nobody announced, moves the whole image farther than the search in time reaches, and every
// feature would be lost. A sample of the background notices it and says by how much: the camera's rotation moves near
// and far points alike.
#include "front/match/patch_matcher.hpp"

namespace semtrack {

namespace {

constexpr int kEvery = 7;        // slots; 73 of 512
constexpr int kMinSample = 16;   // fewer say nothing
constexpr int kJumpRadius = 24;  // half-size px: 48 px are 3.8 deg at KITTI's focal length
constexpr float kAgree_px = 6.0F;
constexpr int kMaxSample = kMaxBackgroundFeatures / kEvery + 1;

/// Middle of the values; sorts them.
float middle(std::array<float, static_cast<std::size_t>(kMaxSample)>& values, int n) {
    for (int i = 1; i < n; ++i) {
        const float x = values[static_cast<std::size_t>(i)];
        int k = i;
        for (; k > 0 && values[static_cast<std::size_t>(k - 1)] > x; --k) {
            values[static_cast<std::size_t>(k)] = values[static_cast<std::size_t>(k - 1)];
        }
        values[static_cast<std::size_t>(k)] = x;
    }
    return values[static_cast<std::size_t>(n / 2)];
}

}  // namespace

void PatchMatcher::find_jump(const MatcherInput& in) {
    jump_u_ = jump_v_ = 0.0F;
    if (frames_ < kStartFrames || !(*in.priors)[static_cast<std::size_t>(kBackground)].active) {
        return;
    }
    std::array<float, static_cast<std::size_t>(kMaxSample)> du{};
    std::array<float, static_cast<std::size_t>(kMaxSample)> dv{};
    for (const int radius : {kRadius, kJumpRadius}) {
        int tried = 0;
        int found = 0;
        for (int s = 0; s < kMaxBackgroundFeatures; s += kEvery) {
            const FeatureSlot& slot = table_.at(kBackground, s);
            Prediction at;
            if (!slot.live || !predict(in, kBackground, slot, 0.0, at) || !at.measured) {
                continue;
            }
            ++tried;
            Found there;
            if (locate(in, looks_[static_cast<std::size_t>(s)], at, radius, there)) {
                du[static_cast<std::size_t>(found)] = there.u - at.u;
                dv[static_cast<std::size_t>(found)] = there.v - at.v;
                ++found;
            }
        }
        if (tried < kMinSample || (radius == kRadius && 2 * found >= tried)) {
            return;
        }
        if (radius == kRadius || 3 * found < tried) {
            continue;
        }
        auto sorted_u = du;
        auto sorted_v = dv;
        const float u = middle(sorted_u, found);
        const float v = middle(sorted_v, found);
        int agree = 0;
        for (int i = 0; i < found; ++i) {
            const float eu = du[static_cast<std::size_t>(i)] - u;
            const float ev = dv[static_cast<std::size_t>(i)] - v;
            agree += eu * eu + ev * ev < kAgree_px * kAgree_px ? 1 : 0;
        }
        if (3 * agree >= tried) {
            jump_u_ = u;
            jump_v_ = v;
        }
    }
}

}  // namespace semtrack
