// An 8-bit grey image that somebody else owns.
#ifndef SEMTRACK_IMAGE_VIEW_HPP
#define SEMTRACK_IMAGE_VIEW_HPP

#include <cstdint>

namespace semtrack {

/// Row-major, `stride` bytes from row to row. data == nullptr: there is no image.
struct ImageView {
    const std::uint8_t* data{nullptr};
    int width{0};
    int height{0};
    int stride{0};

    [[nodiscard]] bool empty() const { return data == nullptr; }
    [[nodiscard]] const std::uint8_t* row(int y) const { return data + static_cast<std::int64_t>(y) * stride; }
    [[nodiscard]] std::uint8_t at(int x, int y) const { return row(y)[x]; }
};

}  // namespace semtrack

#endif
