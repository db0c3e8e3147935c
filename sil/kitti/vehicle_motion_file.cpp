#include "sil/kitti/vehicle_motion_file.hpp"

#include <charconv>

#include "sil/kitti/text_file.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

constexpr std::size_t kPlain = 3;
constexpr std::size_t kWithSigmas = 5;

/// Whole: a double would round what lies beyond 2^53.
std::int64_t time_of(const TextFile& file, const TextRow& row) {
    const std::string_view word = row.words[0];
    std::int64_t time_us = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), time_us);
    if (error != std::errc{} || end != word.data() + word.size()) {
        file.refuse(row, quoted_word(word) + " is not a whole number of microseconds");
    }
    return time_us;
}

}  // namespace

std::map<std::int64_t, VehicleMotion> read_vehicle_motion(const std::filesystem::path& path) {
    const TextFile file(path, false);
    std::map<std::int64_t, VehicleMotion> out;
    for (const TextRow& row : file.rows()) {
        if (row.words.size() != kPlain && row.words.size() != kWithSigmas) {
            file.refuse(row, "has " + std::to_string(row.words.size()) + " values instead of 3 or 5");
        }
        VehicleMotion m;
        m.time_us = time_of(file, row);
        m.speed = file.number(row, 1);
        m.yaw_rate = file.number(row, 2);
        if (row.words.size() == kWithSigmas) {
            m.sigma_speed = file.number(row, 3);
            m.sigma_yaw_rate = file.number(row, 4);
        }
        if (!(m.sigma_speed > 0.0 && m.sigma_yaw_rate > 0.0)) {
            file.refuse(row, "a sigma is not positive");
        }
        if (!out.empty() && m.time_us <= out.rbegin()->first) {
            file.refuse(row, "the time is not later than the last");
        }
        out[m.time_us] = m;
    }
    if (out.empty()) {
        throw InputError(path.string() + ": has no rows");
    }
    return out;
}

}  // namespace semtrack::sil
