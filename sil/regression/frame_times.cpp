#include "sil/regression/frame_times.hpp"

#include <algorithm>
#include <array>

#include "sil/kitti/text_file.hpp"
#include "sil/metrics/object_rows.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {
constexpr std::array<const char*, 6> kFrontEnd{"infer", "associate", "mask", "extract", "match", "reject"};
}

void FrameTimes::add(const std::filesystem::path& timing_csv) {
    const TextFile file(timing_csv, false, ',');
    std::vector<Column> run;
    for (std::size_t column = 1; !file.rows().empty() && column < file.rows()[0].words.size(); ++column) {
        const std::string name(file.rows()[0].words[column]);
        if (name.size() < 4U || name.substr(name.size() - 3U) != "_us") {
            continue;
        }
        run.push_back({name.substr(0, name.size() - 3U), {}});
        for (std::size_t i = 1; i < file.rows().size(); ++i) {
            run.back().ms.push_back(1e-3 * file.number(file.rows()[i], column));
        }
    }
    if (columns_.empty()) {
        columns_ = std::move(run);
        return;
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (c >= run.size() || run[c].ms.size() != columns_[c].ms.size()) {
            throw InputError(timing_csv.string() + ": another number of frames than in the run before");
        }
        for (std::size_t i = 0; i < run[c].ms.size(); ++i) {
            columns_[c].ms[i] = std::min(columns_[c].ms[i], run[c].ms[i]);
        }
    }
}

nlohmann::ordered_json FrameTimes::metrics() const {
    nlohmann::ordered_json out = nlohmann::ordered_json::object();
    Column front{"front_end", {}};
    const auto put = [&out](const Column& c) {
        out[c.name + "_ms"] = median(c.ms).value_or(0.0);
        out[c.name + "_max_ms"] = quantile(c.ms, 1.0).value_or(0.0);
    };
    for (const Column& c : columns_) {
        put(c);
        if (std::find(kFrontEnd.begin(), kFrontEnd.end(), c.name) == kFrontEnd.end()) {
            continue;
        }
        front.ms.resize(c.ms.size(), 0.0);
        for (std::size_t i = 0; i < c.ms.size(); ++i) {
            front.ms[i] += c.ms[i];
        }
    }
    put(front);
    return out;
}

}  // namespace semtrack::sil
