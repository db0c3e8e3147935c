// Numbers as text, without the locale: 17 significant digits, so equal bytes mean equal bits.
#ifndef SEMTRACK_SIL_METRICS_NUMBER_TEXT_HPP
#define SEMTRACK_SIL_METRICS_NUMBER_TEXT_HPP

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace semtrack::sil {

/// %.17g of a finite value; anything else becomes nothing (an empty field).
inline void append_number(std::string& text, double value) {
    if (!std::isfinite(value)) {
        return;
    }
    std::array<char, 40> buffer{};
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 17);
    if (error == std::errc{}) {
        text.append(buffer.data(), end);
    }
}

[[nodiscard]] inline std::string number_text(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

/// The shortest text that reads back as the same value, for people.
[[nodiscard]] inline std::string short_text(double value) {
    std::array<char, 40> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return error == std::errc{} ? std::string(buffer.data(), end) : std::string("?");
}

/// %.Nf for people.
[[nodiscard]] inline std::string fixed_text(double value, int digits) {
    std::array<char, 400> buffer{};
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, digits);
    return error == std::errc{} ? std::string(buffer.data(), end) : std::string("?");
}

}  // namespace semtrack::sil

#endif
