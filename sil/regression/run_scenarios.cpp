#include "sil/regression/run_scenarios.hpp"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

#include "sil/evaluation.hpp"
#include "sil/kitti/convert_detections.hpp"
#include "sil/open_drive.hpp"
#include "sil/regression/baseline.hpp"
#include "sil/regression/child_process.hpp"
#include "sil/regression/frame_times.hpp"
#include "sil/regression/json.hpp"
#include "sil/regression/match_means.hpp"
#include "sil/regression/verdict.hpp"
#include "sil/report/progress.hpp"
#include "sil/report/text_output.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

Json read_metrics(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return Json::parse(in, nullptr, false);
}

/// Last line of a log: what the replay complained of.
std::string last_line(const fs::path& log) {
    std::ifstream in(log);
    std::string line;
    std::string last;
    while (std::getline(in, line)) {
        last = line.empty() ? last : line;
    }
    return last;
}

class Runner {
public:
    Runner(const RunOptions& options, const ScenarioFile& file)
        : o_(options), cases_(file.cases), runs_(file.cases.size()), times_(file.cases.size()) {
        for (const ScenarioCase& c : cases_) {
            CaseResult result;
            result.name = c.name;
            result.group = c.group;
            result.skipped = c.missing;
            result.status = c.missing.empty() ? CaseStatus::kPassed : CaseStatus::kSkipped;
            results_.push_back(std::move(result));
        }
    }
    ~Runner() {
        std::vector<int> left;
        for (const auto& [process, entry] : running_) {
            left.push_back(process);
        }
        stop_children(left);
    }
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    std::vector<CaseResult> run() {
        Progress progress(o_.progress, static_cast<int>(cases_.size()), "case");
        int done = 0;
        for (std::size_t i = 0; i < cases_.size(); ++i) {
            if (results_[i].status == CaseStatus::kSkipped) {
                ++done;
                progress.show(done, done);
                continue;
            }
            while (running_.size() >= static_cast<std::size_t>(o_.jobs)) {
                done += finish_one() ? 1 : 0;
                progress.show(done, done);
            }
            start(i);
        }
        while (!running_.empty()) {
            done += finish_one() ? 1 : 0;
            progress.show(done, done);
        }
        return std::move(results_);
    }

    /// Of every case, after run().
    [[nodiscard]] const std::vector<FrameTimes>& times() const { return times_; }

private:
    struct Running {
        std::size_t index;
        Clock::time_point begin;
    };

    [[nodiscard]] fs::path log_of(const ScenarioCase& c) const { return o_.out / "logs" / (c.name + ".txt"); }

    void start(std::size_t index) {
        const ScenarioCase& c = cases_[index];
        std::vector<std::string> arguments{"replay", "--out", (o_.out / c.name).string()};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        if (!c.convert.format.empty()) {
            arguments.push_back("--detections");
            arguments.push_back(convert(c).string());
        }
        running_[start_child(arguments, log_of(c))] = {index, Clock::now()};
    }

    [[nodiscard]] fs::path convert(const ScenarioCase& c) const {
        ConvertOptions options;
        options.format = c.convert.format;
        options.in = c.convert.file;
        if (!c.convert.object_class.empty()) {
            options.object_class = c.convert.object_class;
        }
        if (!c.convert.viewpoints.empty()) {
            options.labels_viewpoints = c.convert.viewpoints;
            options.labels = c.drive.root / "training" / "label_02" / (c.drive.sequence + ".txt");
        }
        const fs::path path = o_.out / "detections" / (c.name + ".txt");
        write_file(path, converted_detections(options));
        return path;
    }

    /// Waits for a replay. false: it is no case's last.
    bool finish_one() {
        const ChildEnd end = wait_for_child();
        const auto entry = running_.find(end.process);
        if (entry == running_.end()) {
            return false;
        }
        const Running running = entry->second;
        running_.erase(entry);
        CaseResult& result = results_[running.index];
        result.seconds += std::chrono::duration<double>(Clock::now() - running.begin).count();
        if (end.status == 0) {
            times_[running.index].add(o_.out / cases_[running.index].name / "timing.csv");
            if (++runs_[running.index] < cases_[running.index].repeat) {
                start(running.index);
                return false;
            }
        }
        judge(cases_[running.index], end.status, result);
        result.status = result.failures.empty() ? CaseStatus::kPassed : CaseStatus::kFailed;
        return true;
    }

    void judge(const ScenarioCase& c, int status, CaseResult& result) const {
        const fs::path dir = o_.out / c.name;
        if (status != 0) {
            result.failures.push_back("replay ended with status " + std::to_string(status) + ": " +
                                      last_line(log_of(c)));
            return;
        }
        result.metrics = read_metrics(dir / "metrics.json");
        result.failures = broken_bounds(result.metrics, c.bounds);
        result.shorts = shortfall_lines(result.metrics, c.shortfalls);
        if (o_.baseline.empty() || c.golden == Golden::kNone) {
            return;
        }
        if (o_.update_baseline) {
            write_baseline(dir, o_.baseline / c.name);
            return;
        }
        for (const std::string& line : compare_with_baseline(dir, o_.baseline / c.name, c.golden, c.tolerances)) {
            result.failures.push_back(line);
        }
    }

    const RunOptions& o_;
    const std::vector<ScenarioCase>& cases_;
    std::vector<CaseResult> results_;
    std::vector<int> runs_;          // ended well, by case
    std::vector<FrameTimes> times_;  // by case
    std::map<int, Running> running_;
};

/// Rows of the table: a group of one case has its metrics, a larger one those of its drives' objects together.
GroupMetrics pooled(const RunOptions& o, const ScenarioFile& file, const std::vector<CaseResult>& results,
                    const std::vector<FrameTimes>& times) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (!results[i].metrics.is_object()) {
            continue;
        }
        if (members.count(results[i].group) == 0U) {
            order.push_back(results[i].group);
        }
        members[results[i].group].push_back(i);
    }
    GroupMetrics out;
    for (const std::string& group : order) {
        const std::vector<std::size_t>& cases = members[group];
        Json metrics = results[cases.front()].metrics;
        if (cases.size() > 1U) {
            Metrics all;
            all.object_scores.emplace();
            for (const std::size_t i : cases) {
                const ResultFiles rows = read_results(o.out / file.cases[i].name);
                all.object_scores->add(rows.objects, rows.frames, read_truth(file.cases[i].drive).objects);
            }
            metrics = Json::parse(to_json(all));
        } else {
            metrics["timing"] = times[cases.front()].metrics();
            metrics["matches"] = match_means(o.out / file.cases[cases.front()].name / "ego.csv");
        }
        out.emplace_back(group, metrics);
    }
    return out;
}

}  // namespace

bool run_scenarios(const RunOptions& options) {
    const ScenarioFile file = read_scenario_file(options.scenarios);
    const fs::path junit = options.junit.empty() ? options.out / "junit.xml" : options.junit;
    try {
        for (const char* folder : {"logs", "detections"}) {
            fs::create_directories(options.out / folder);
        }
        write_file(junit, "");
    } catch (const std::exception& error) {
        throw InputError(options.out.string() + ": cannot be written (" + error.what() + ")");
    }
    Runner runner(options, file);
    const std::vector<CaseResult> results = runner.run();
    const std::string table = table_text(file.table, pooled(options, file, results, runner.times()));
    write_file(junit, junit_xml("semtrack-sil " + options.scenarios.stem().string(), results));
    write_file(options.out / "metrics.json", results_json(results));
    write_file(options.out / "table.txt", table);
    (void)std::fputs((results_text(results) + (table.empty() ? "" : "\n" + table)).c_str(), stdout);
    for (const CaseResult& r : results) {
        if (r.status == CaseStatus::kFailed) {
            return false;
        }
    }
    return true;
}

}  // namespace semtrack::sil
