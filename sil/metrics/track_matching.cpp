#include "sil/metrics/track_matching.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "model/box_geometry.hpp"

namespace semtrack::sil {

namespace {

constexpr double kMeetingOverlap = 0.5;

const std::string& family(const std::string& type) {
    static const std::string kCar = "Car";
    return type == "Van" ? kCar : type;
}

struct FramePairs {
    std::vector<RowMatch> matches;
    std::set<std::size_t> labels;
    std::set<std::size_t> results;

    void take(std::size_t l, std::size_t r) {
        if (labels.count(l) == 0U && results.count(r) == 0U) {
            matches.push_back({l, r});
            labels.insert(l);
            results.insert(r);
        }
    }
};

}  // namespace

std::vector<std::vector<RowMatch>> match_rows(const std::vector<EvaluatedFrame>& frames,
                                              const std::vector<ObjectRow>& results,
                                              const std::vector<ObjectRow>& labels) {
    std::vector<std::vector<RowMatch>> out;
    std::map<int, int> before;  // label id -> result id, of the frame before
    for (const EvaluatedFrame& frame : frames) {
        FramePairs pairs;
        std::vector<std::tuple<double, std::size_t, std::size_t>> meeting;
        for (const std::size_t l : frame.labels) {
            for (const std::size_t r : frame.results) {
                const double overlap = box_overlap(labels[l].box, results[r].box);
                if (family(labels[l].type) != family(results[r].type) || !(overlap >= kMeetingOverlap)) {
                    continue;
                }
                meeting.emplace_back(-overlap, l, r);
                const auto last = before.find(labels[l].id);
                if (last != before.end() && last->second == results[r].id) {
                    pairs.take(l, r);
                }
            }
        }
        std::sort(meeting.begin(), meeting.end());
        for (const auto& [overlap, l, r] : meeting) {
            pairs.take(l, r);
        }
        before.clear();
        for (const RowMatch& m : pairs.matches) {
            before[labels[m.label].id] = results[m.result].id;
        }
        out.push_back(std::move(pairs.matches));
    }
    return out;
}

}  // namespace semtrack::sil
