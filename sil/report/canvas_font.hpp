// A fixed font of 5 x 7 pixels, drawn for these pictures: printable ASCII.
#ifndef SEMTRACK_SIL_REPORT_CANVAS_FONT_HPP
#define SEMTRACK_SIL_REPORT_CANVAS_FONT_HPP

#include <array>
#include <cstdint>

namespace semtrack::sil {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

/// Rows from the top; the highest of the five low bits is the left pixel.
struct Glyph {
    std::array<std::uint8_t, static_cast<std::size_t>(kGlyphHeight)> rows;
};

/// Other characters look like '?'.
[[nodiscard]] const Glyph& glyph(char c);

}  // namespace semtrack::sil

#endif
