// The owner of every pixel of an image.
#ifndef SEMTRACK_MODEL_OWNER_MASK_HPP
#define SEMTRACK_MODEL_OWNER_MASK_HPP

#include <array>
#include <cstdint>

#include "semtrack/capacity.hpp"
#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

inline constexpr std::uint8_t kBackgroundOwner = 0;

/// Row-major, stride = width. Values: 0 background, slot + 1 an object, kNoOwner nobody's.
struct OwnerMask {
    int width{0};
    int height{0};
    std::array<std::uint8_t, static_cast<std::size_t>(kMaxImageWidth) * kMaxImageHeight> data{};

    [[nodiscard]] std::uint8_t* row(int y) { return data.data() + static_cast<std::int64_t>(y) * width; }
    [[nodiscard]] const std::uint8_t* row(int y) const { return data.data() + static_cast<std::int64_t>(y) * width; }
    [[nodiscard]] std::uint8_t at(int x, int y) const { return row(y)[x]; }
    [[nodiscard]] OwnerMaskView view() const { return {data.data(), width, height}; }
};

}  // namespace semtrack

#endif
