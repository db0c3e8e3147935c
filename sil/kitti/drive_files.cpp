#include "sil/kitti/drive_files.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

/// Days since 1970-01-01 of a date of the Gregorian calendar.
std::int64_t days_from_civil(std::int64_t y, std::int64_t m, std::int64_t d) {
    y -= m <= 2 ? 1 : 0;
    const std::int64_t era = (y >= 0 ? y : y - 399) / 400;
    const std::int64_t year_of_era = y - era * 400;
    const std::int64_t day_of_year = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
    const std::int64_t day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
    return era * 146097 + day_of_era - 719468;
}

std::int64_t days_in_month(std::int64_t y, std::int64_t m) {
    const std::int64_t next = m == 12 ? days_from_civil(y + 1, 1, 1) : days_from_civil(y, m + 1, 1);
    return next - days_from_civil(y, m, 1);
}

bool digits(std::string_view s, std::size_t from, std::size_t count, std::int64_t& out) {
    out = 0;
    if (from + count > s.size()) {
        return false;
    }
    for (std::size_t i = from; i < from + count; ++i) {
        if (s[i] < '0' || s[i] > '9') {
            return false;
        }
        out = out * 10 + (s[i] - '0');
    }
    return true;
}

/// Rows of unit length, right-handed; files are printed with few digits.
bool is_rotation(const std::array<double, 9>& R) {
    constexpr double kTolerance = 1e-2;
    for (std::size_t r = 0; r < 9; r += 3) {
        if (std::fabs(R[r] * R[r] + R[r + 1] * R[r + 1] + R[r + 2] * R[r + 2] - 1.0) > kTolerance) {
            return false;
        }
    }
    const double det =
        R[0] * (R[4] * R[8] - R[5] * R[7]) - R[1] * (R[3] * R[8] - R[5] * R[6]) + R[2] * (R[3] * R[7] - R[4] * R[6]);
    return std::fabs(det - 1.0) <= kTolerance;
}

bool parse_stamp(std::string_view date, std::string_view clock, std::int64_t& time_us) {
    std::int64_t y = 0;
    std::int64_t mo = 0;
    std::int64_t d = 0;
    std::int64_t h = 0;
    std::int64_t mi = 0;
    std::int64_t s = 0;
    if (date.size() != 10 || date[4] != '-' || date[7] != '-' || !digits(date, 0, 4, y) || !digits(date, 5, 2, mo) ||
        !digits(date, 8, 2, d) || clock.size() < 8 || clock[2] != ':' || clock[5] != ':' || !digits(clock, 0, 2, h) ||
        !digits(clock, 3, 2, mi) || !digits(clock, 6, 2, s)) {
        return false;
    }
    if (mo < 1 || mo > 12 || d < 1 || d > days_in_month(y, mo) || h > 23 || mi > 59 || s > 60) {
        return false;
    }
    std::int64_t fraction_us = 0;
    if (clock.size() > 8) {
        const std::size_t count = clock.size() - 9;
        std::int64_t ignored = 0;
        if (clock[8] != '.' || count > 9 || !digits(clock, 9, count, ignored)) {
            return false;
        }
        for (std::size_t i = 0; i < 6; ++i) {
            fraction_us = fraction_us * 10 + (i < count ? clock[9 + i] - '0' : 0);
        }
    }
    time_us = ((days_from_civil(y, mo, d) * 24 + h) * 60 + mi) * 60 + s;
    time_us = time_us * 1000000 + fraction_us;
    return true;
}

/// A decimal number of seconds as microseconds, rounded half up, exact: as a double, 2^33 s are known to 2 us only.
/// `text` is a number that TextFile::number has accepted; below 9e12 s.
std::int64_t microseconds(std::string_view text) {
    constexpr std::int64_t kMostDigits = 1000000000000000000;  // 18 digits: further ones are below a microsecond
    const bool negative = text.front() == '-';
    std::int64_t digits = 0;
    int exponent = 6;
    bool fraction = false;
    for (std::size_t i = negative ? 1 : 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '.') {
            fraction = true;
        } else if (c == 'e' || c == 'E') {
            int power = 0;
            const char* const first = text.data() + i + (text[i + 1] == '+' ? 2 : 1);
            (void)std::from_chars(first, text.data() + text.size(), power);
            exponent += power;
            break;
        } else if (digits < kMostDigits / 10) {
            digits = 10 * digits + (c - '0');
            exponent -= fraction ? 1 : 0;
        } else {
            exponent += fraction ? 0 : 1;
        }
    }
    digits = negative ? -digits : digits;
    for (; exponent > 0 && digits != 0; --exponent) {
        digits *= 10;
    }
    std::int64_t divisor = 1;
    for (; exponent < 0 && divisor < kMostDigits; ++exponent) {
        divisor *= 10;
    }
    const std::int64_t whole = digits / divisor - (digits % divisor < 0 ? 1 : 0);
    return whole + (2 * (digits - whole * divisor) >= divisor ? 1 : 0);
}

}  // namespace

std::vector<std::int64_t> read_timestamps(const std::filesystem::path& path) {
    const TextFile file(path, true);
    std::vector<std::int64_t> times;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 2, 2);
        std::int64_t time_us = 0;
        if (!parse_stamp(row.words[0], row.words[1], time_us)) {
            file.refuse(row, "not a time stamp");
        }
        if (!times.empty() && time_us <= times.back()) {
            file.refuse(row, "time does not go forward");
        }
        times.push_back(time_us);
    }
    return times;
}

std::vector<std::int64_t> read_times(const std::filesystem::path& path) {
    const TextFile file(path, true);
    std::vector<std::int64_t> times;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 1, 1);
        const double seconds = file.number(row, 0);
        if (std::fabs(seconds) > 9e12) {
            file.refuse(row, "not a time in seconds");
        }
        const std::int64_t time_us = microseconds(row.words[0]);
        if (!times.empty() && time_us <= times.back()) {
            file.refuse(row, "time does not go forward");
        }
        times.push_back(time_us);
    }
    return times;
}

std::vector<int> read_frame_list(const std::filesystem::path& path) {
    const TextFile file(path, true);
    std::vector<int> frames;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 1, 1);
        const int n = file.integer(row, 0);
        if (n < 0) {
            file.refuse(row, "a frame number is not negative");
        }
        if (!frames.empty() && n <= frames.back()) {
            file.refuse(row, "frame numbers must grow");
        }
        frames.push_back(n);
    }
    return frames;
}

std::map<int, RigidTransform> read_poses(const std::filesystem::path& path, const std::vector<int>& numbers) {
    const TextFile file(path, true);
    std::map<int, RigidTransform> poses;
    std::size_t i = 0;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 12, 12);
        RigidTransform T;
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) {
                T.R[3 * r + c] = file.number(row, 4 * r + c);
            }
            T.t[r] = file.number(row, 4 * r + 3);
        }
        if (!is_rotation(T.R)) {
            file.refuse(row, "the first three columns are no rotation");
        }
        if (!numbers.empty() && i >= numbers.size()) {
            file.refuse(row, "more poses than frames");
        }
        poses[numbers.empty() ? static_cast<int>(i) : numbers[i]] = T;
        ++i;
    }
    return poses;
}

namespace {

using ObjectKey = std::pair<int, int>;  // frame, track id

std::map<ObjectKey, Viewpoint> read_viewpoints(const std::filesystem::path& path) {
    std::map<ObjectKey, Viewpoint> views;
    if (path.empty() || !std::filesystem::exists(path)) {
        return views;
    }
    const TextFile file(path, false);
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 4, 4);
        views[{file.integer(row, 0), file.integer(row, 1)}] = parse_viewpoint(file, row, 2);
    }
    return views;
}

Label parse_label(const TextFile& file, const TextRow& row) {
    file.require_words(row, 17, 18);
    Label l;
    l.frame = file.integer(row, 0);
    l.id = file.integer(row, 1);
    l.type = std::string(row.words[2]);
    l.truncated = file.number(row, 3);
    l.occluded = file.integer(row, 4);
    l.alpha = file.number(row, 5);
    l.box = {file.number(row, 6), file.number(row, 7), file.number(row, 8), file.number(row, 9)};
    l.height = file.number(row, 10);
    l.width = file.number(row, 11);
    l.length = file.number(row, 12);
    l.x = file.number(row, 13);
    l.y = file.number(row, 14);
    l.z = file.number(row, 15);
    l.rotation_y = file.number(row, 16);
    if (row.words.size() > 17) {
        (void)file.number(row, 17);
    }
    if (l.type != "DontCare" && !(l.height > 0.0 && l.width > 0.0 && l.length > 0.0)) {
        file.refuse(row, "a box needs positive sizes");
    }
    return l;
}

}  // namespace

Viewpoint parse_viewpoint(const TextFile& file, const TextRow& row, std::size_t word) {
    const int h = file.integer(row, word);
    const int v = file.integer(row, word + 1);
    if (h < -1 || h > 7 || v < -1 || v > 1 || ((h < 0) != (v < 0))) {
        file.refuse(row, "viewpoints are 0..7 and 0..1, or -1 -1");
    }
    return {static_cast<std::int8_t>(h), static_cast<std::int8_t>(v)};
}

std::vector<Label> read_labels(const std::filesystem::path& path, const std::filesystem::path& viewpoints) {
    const std::map<ObjectKey, Viewpoint> views = read_viewpoints(viewpoints);
    const TextFile file(path, false);
    std::vector<Label> labels;
    std::set<ObjectKey> seen;
    for (const TextRow& row : file.rows()) {
        Label l = parse_label(file, row);
        if (l.type != "DontCare" && l.id >= 0 && !seen.insert({l.frame, l.id}).second) {
            file.refuse(row, "the same frame and id twice");
        }
        const auto view = views.find({l.frame, l.id});
        if (view != views.end()) {
            l.viewpoint = view->second;
        }
        labels.push_back(std::move(l));
    }
    return labels;
}

}  // namespace semtrack::sil
