#include "sil/regression/baseline.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>

#include "sil/kitti/drive_files.hpp"
#include "sil/metrics/number_text.hpp"
#include "sil/regression/json.hpp"
#include "sil/report/text_output.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRows = "rows.txt";
constexpr const char* kMetrics = "metrics.json";

/// file (by its place in kFiles), frame, object.
struct Key {
    std::size_t file;
    int frame;
    int object;
    bool operator<(const Key& o) const {
        return frame != o.frame ? frame < o.frame : file != o.file ? file < o.file : object < o.object;
    }
};
using Hashes = std::map<Key, std::uint64_t>;

/// How a file's rows name their frame and object.
struct FileKind {
    const char* name;
    char separator;  // '\0': blanks
    int header_rows;
    int object_word;  // -1: none
};
constexpr std::array<FileKind, 5> kFiles{{
    {"ego.csv", ',', 1, -1},
    {"objects.txt", '\0', 0, 1},
    {"states.csv", ',', 1, 2},
    {"list.csv", ',', 1, 2},
    {"ego.txt", '\0', 0, -1},
}};
constexpr std::size_t kEgoFile = 4;
constexpr std::size_t kCanFile = kFiles.size();

const char* file_name(std::size_t file) {
    return file == kCanFile ? "can.log" : kFiles[file].name;
}

std::uint64_t fnv1a(std::uint64_t hash, std::string_view text) {
    for (const char c : text) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 1099511628211ULL;
    }
    return hash;
}

void add(Hashes& hashes, const Key& key, const TextRow& row) {
    std::uint64_t& hash = hashes.try_emplace(key, 14695981039346656037ULL).first->second;
    for (const std::string_view word : row.words) {
        hash = fnv1a(fnv1a(hash, word), " ");
    }
}

/// can.log has times; its n-th different time is the n-th frame.
void add_can_log(const fs::path& dir, const std::vector<int>& frames, Hashes& hashes) {
    const TextFile file(dir / "can.log", false);
    std::size_t index = 0;
    std::string_view time;
    for (const TextRow& row : file.rows()) {
        if (row.words[0] != time) {
            index += time.empty() ? 0U : 1U;
            time = row.words[0];
        }
        add(hashes, {kCanFile, index < frames.size() ? frames[index] : -1, -1}, row);
    }
}

Hashes hashes_of(const fs::path& dir) {
    Hashes hashes;
    const std::vector<int> frames = read_frame_list(dir / "frames.txt");
    for (std::size_t f = 0; f < kFiles.size(); ++f) {
        const FileKind& kind = kFiles[f];
        const TextFile file(dir / kind.name, false, kind.separator);
        for (std::size_t i = static_cast<std::size_t>(kind.header_rows); i < file.rows().size(); ++i) {
            const TextRow& row = file.rows()[i];
            if (f == kEgoFile) {
                add(hashes, {f, frames.at(i), -1}, row);
                continue;
            }
            const bool object = kind.object_word >= 0 && !row.words[static_cast<std::size_t>(kind.object_word)].empty();
            add(hashes,
                {f, file.integer(row, 0), object ? file.integer(row, static_cast<std::size_t>(kind.object_word)) : -1},
                row);
        }
    }
    add_can_log(dir, frames, hashes);
    return hashes;
}

Hashes read_hashes(const fs::path& path) {
    const TextFile file(path, false);
    Hashes hashes;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 4, 4);
        std::size_t f = 0;
        while (f <= kCanFile && row.words[0] != file_name(f)) {
            ++f;
        }
        std::uint64_t hash = 0;
        const std::string_view w = row.words[3];
        if (f > kCanFile || std::from_chars(w.data(), w.data() + w.size(), hash, 16).ptr != w.data() + w.size()) {
            file.refuse(row, "not a row of a baseline");
        }
        hashes[{f, file.integer(row, 1), file.integer(row, 2)}] = hash;
    }
    return hashes;
}

std::string place(const Key& key) {
    return std::string(file_name(key.file)) + ": frame " + std::to_string(key.frame) +
           (key.object >= 0 ? ", object " + std::to_string(key.object) : std::string());
}

void compare_rows(const Hashes& now, const Hashes& before, std::vector<std::string>& out) {
    auto a = now.begin();
    auto b = before.begin();
    while (a != now.end() || b != before.end()) {
        const bool extra = b == before.end() || (a != now.end() && a->first < b->first);
        const bool lacking = !extra && (a == now.end() || b->first < a->first);
        if (extra || lacking || a->second != b->second) {
            const Key& key = lacking ? b->first : a->first;
            out.push_back("first difference from the baseline: " + place(key) +
                          (extra     ? " (a new row)"
                           : lacking ? " (the row is gone)"
                                     : ""));
            return;
        }
        ++a;
        ++b;
    }
}

Json read_json(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    Json json = Json::parse(in, nullptr, false);
    return json.is_object() ? json.flatten() : Json::object();
}

std::string value_text(const Json& value) {
    return value.is_number() ? number_text(value.get<double>()) : value.dump();
}

void compare_metrics(const Json& now, const Json& before, const std::vector<Tolerance>& tolerances,
                     std::vector<std::string>& out) {
    constexpr int kMostLines = 8;  // one change of the estimate moves a hundred metrics
    int moved = 0;
    for (const auto& [metric, old_value] : before.items()) {
        const auto found = now.find(metric);
        const Json value = found == now.end() ? Json() : *found;
        if (value == old_value) {
            continue;
        }
        double allowed = 0.0;
        for (const Tolerance& t : tolerances) {
            allowed = t.metric == metric ? t.most : allowed;
        }
        const bool near = value.is_number() && old_value.is_number() &&
                          std::fabs(value.get<double>() - old_value.get<double>()) <= allowed;
        moved += near ? 0 : 1;
        if (!near && moved <= kMostLines) {
            out.push_back("metric " + metric + ": " + value_text(value) + ", baseline " + value_text(old_value) +
                          (allowed > 0.0 ? ", tolerance " + number_text(allowed) : std::string()));
        }
    }
    if (moved > kMostLines) {
        out.push_back("and " + std::to_string(moved - kMostLines) + " more metrics");
    }
}

}  // namespace

void write_baseline(const fs::path& results, const fs::path& baseline) {
    fs::create_directories(baseline);
    std::string text;
    for (const auto& [key, hash] : hashes_of(results)) {
        std::array<char, 17> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16);
        text += std::string(file_name(key.file)) + " " + std::to_string(key.frame) + " " + std::to_string(key.object) +
                " " + std::string(digits.data(), end.ptr) + "\n";
    }
    write_file(baseline / kRows, text);
    fs::copy_file(results / kMetrics, baseline / kMetrics, fs::copy_options::overwrite_existing);
}

std::vector<std::string> compare_with_baseline(const fs::path& results, const fs::path& baseline, Golden golden,
                                               const std::vector<Tolerance>& tolerances) {
    std::vector<std::string> out;
    if (!fs::exists(baseline / kMetrics)) {
        out.push_back("no baseline in " + baseline.string());
        return out;
    }
    if (golden == Golden::kRows) {
        compare_rows(hashes_of(results), read_hashes(baseline / kRows), out);
    }
    compare_metrics(read_json(results / kMetrics), read_json(baseline / kMetrics), tolerances, out);
    return out;
}

}  // namespace semtrack::sil
