#include "front/feature/orb_extractor.hpp"

#include "math/sort.hpp"

namespace semtrack {

namespace {

constexpr int kLargestThreshold = 200;

constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

constexpr int level_weight(int level) {  // (5/6)^level, scaled to integers
    int weight = 1;
    for (int k = 0; k < kMaxPyramidLevels - 1; ++k) {
        weight *= k < level ? 5 : 6;
    }
    return weight;
}

}  // namespace

bool OrbExtractor::acceptable(const ImageView& image, const OwnerMaskView& mask) const {
    const bool sizes = !image.empty() && image.width > 0 && image.height > 0 && image.width <= kMaxImageWidth &&
                       image.height <= kMaxImageHeight && image.stride >= image.width;
    const bool masked = mask.data != nullptr && mask.width == image.width && mask.height == image.height;
    return sizes && masked && options_.levels >= 1 && options_.levels <= kMaxPyramidLevels && options_.threshold >= 1 &&
           options_.threshold <= kLargestThreshold;
}

// In proportion to the level's side length, of what the finer levels have left over.
FeatureBudget OrbExtractor::share_of_level(int level, int levels) const {
    int total = 0;
    for (int l = level; l < levels; ++l) {
        total += level_weight(l);
    }
    FeatureBudget share{};
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        const int left = left_over_[at(owner)];
        const std::int64_t part = (static_cast<std::int64_t>(left) * level_weight(level) + total - 1) / total;
        share[at(owner)] = static_cast<std::int16_t>(part);
    }
    return share;
}

// The owner of a level's pixel is that of the full-resolution pixel its centre falls into. Only corners are asked for:
// the rest of the level's mask is never written.
OwnerMaskView OrbExtractor::owners_of_level(const ImageView& image, const OwnerMaskView& mask, int level) {
    if (level == 0) {
        return mask;
    }
    for (int cell = 0; cell < corners_.cells(); ++cell) {
        for (int i = 0; i < corners_.count(cell); ++i) {
            const Corner& c = corners_.corner(cell, i);
            const int x = full_position_64(c.x, full_width_, image.width) >> 6;
            const int y = full_position_64(c.y, full_height_, image.height) >> 6;
            coarse_mask_[at(c.y * image.width + c.x)] = mask.at(x, y);
        }
    }
    return {coarse_mask_.data(), image.width, image.height};
}

void OrbExtractor::extract_level(const ImageView& image, const OwnerMaskView& mask, int level, int levels) {
    if (fast_.detect(image, options_.threshold, kMargin_px, corners_) != Status::kOk) {
        return;
    }
    const OwnerMaskView owners = owners_of_level(image, mask, level);
    if (options_.spread) {
        selector_.begin(image.width, image.height);
        selector_.select(corners_, owners, share_of_level(level, levels), selected_);
    } else {
        strongest_.select(corners_, owners, share_of_level(level, levels), selected_);
    }
    for (const SelectedCorner& s : selected_) {
        const int u64 = full_position_64(s.corner.x, full_width_, image.width) - 32;
        const int v64 = full_position_64(s.corner.y, full_height_, image.height) - 32;
        Keypoint k;
        k.u = static_cast<float>(u64) / 64.0F;
        k.v = static_cast<float>(v64) / 64.0F;
        k.owner = s.owner;
        k.level = static_cast<std::uint8_t>(level);
        k.score = s.corner.score;
        const int direction = options_.upright ? 0 : patch_direction(image, s.corner.x, s.corner.y);
        patch_.smooth(image, s.corner.x, s.corner.y);
        patch_.describe(direction, k.descriptor);
        if (!found_.try_push_back(k)) {
            return;
        }
        --left_over_[at(s.owner)];
        order_[at(found_.size() - 1)] =
            (static_cast<std::uint64_t>(s.owner) << 48U) | (static_cast<std::uint64_t>(v64 + 32) << 32U) |
            (static_cast<std::uint64_t>(u64 + 32) << 13U) | static_cast<std::uint64_t>(found_.size() - 1);
    }
}

void OrbExtractor::write_sorted(Keypoints& out) {
    static_assert(kMaxFeatures <= (1 << 13), "the index has 13 bits of the key");
    static_assert(64 * kMaxImageWidth < (1 << 19) && 64 * kMaxImageHeight < (1 << 16), "u has 19 bits, v 16");
    heap_sort(order_.data(), found_.size());
    for (int i = 0; i < found_.size(); ++i) {
        const auto index = static_cast<int>(order_[at(i)] & 0x1FFFU);
        if (!out.try_push_back(found_[index])) {
            return;
        }
    }
}

Status OrbExtractor::extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                             Keypoints& out) noexcept {
    out.clear();
    if (!acceptable(image, mask)) {
        return Status::kInvalidArgument;
    }
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        const int slots = owner == 0 ? kMaxBackgroundFeatures : kMaxObjectFeatures;
        const int wanted = budget[at(owner)];
        left_over_[at(owner)] = static_cast<std::int16_t>(wanted < 0 ? 0 : wanted < slots ? wanted : slots);
    }
    found_.clear();
    full_width_ = image.width;
    full_height_ = image.height;
    int levels = 0;
    for (int l = 0; l < options_.levels; ++l) {
        const int smaller = image.width < image.height ? image.width : image.height;
        levels += level_size(smaller, l) > 2 * kMargin_px ? 1 : 0;
    }
    ImageView current = image;
    for (int level = 0; level < levels; ++level) {
        if (level > 0) {
            const int width = level_size(image.width, level);
            const int height = level_size(image.height, level);
            std::uint8_t* to = level % 2 == 1 ? odd_level_.data() : even_level_.data();
            resizer_.resize(current, width, height, to);
            current = {to, width, height, width};
        }
        extract_level(current, mask, level, levels);
    }
    write_sorted(out);
    return Status::kOk;
}

}  // namespace semtrack
