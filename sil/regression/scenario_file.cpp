#include "sil/regression/scenario_file.hpp"

#include <cstdlib>
#include <fstream>
#include <set>

#include "sil/kitti/drive_paths.hpp"
#include "sil/regression/json.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

/// One file's reader: every complaint names the file and the place.
constexpr int kMaxRepeat = 100;

class Reader {
public:
    explicit Reader(const fs::path& path) : path_(path) {
        std::ifstream in(path, std::ios::binary);
        if (!in || fs::is_directory(path)) {
            throw InputError(path.string() + ": cannot be read");
        }
        try {
            json_ = Json::parse(in);
        } catch (const Json::parse_error& error) {
            throw InputError(path.string() + ": " + error.what());
        }
    }

    ScenarioFile read() {
        ScenarioFile out;
        try {
            require_keys(json_, {"about", "defaults", "cases", "table"}, "file");
            defaults_ = json_.value("defaults", Json::object());
            for (const Json& c : json_.at("cases")) {
                for (const Json& one : expanded(c)) {
                    add_case(one, out);
                }
            }
            if (json_.contains("table")) {
                read_table(json_["table"], out.table);
            }
        } catch (const Json::exception& error) {
            throw InputError(path_.string() + ": " + (case_.empty() ? "" : "case " + case_ + ": ") + error.what());
        }
        if (out.cases.empty()) {
            refuse("holds no cases");
        }
        return out;
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(path_.string() + ": " + (case_.empty() ? "" : "case " + case_ + ": ") + what);
    }

    void require_keys(const Json& object, const std::set<std::string>& known, const std::string& where) const {
        for (const auto& [key, value] : object.items()) {
            if (known.count(key) == 0U) {
                refuse(where + ": unknown key '" + key + "'");
            }
        }
    }

    /// Empty result: a variable that is not set; `missing` then names it.
    [[nodiscard]] fs::path resolve(const std::string& text, std::string& missing) const {
        fs::path path = text;
        if (!text.empty() && text[0] == '$') {
            const std::string name = text.substr(1, text.find('/') - 1U);
            const char* const value = std::getenv(name.c_str());
            if (value == nullptr || *value == '\0') {
                missing = "$" + name + " is not set";
                return {};
            }
            path = value + text.substr(name.size() + 1U);
        }
        return path.is_absolute() ? path : path_.parent_path() / path;
    }

    /// "each": {"word": ["a", "b"]} makes a case of each value, with "{word}" replaced in all of its texts.
    [[nodiscard]] std::vector<Json> expanded(const Json& json) const {
        Json merged = defaults_;
        merged.merge_patch(json);
        if (!merged.contains("each")) {
            return {merged};
        }
        const Json each = merged["each"];
        merged.erase("each");
        if (each.size() != 1U) {
            refuse("each: has one word");
        }
        const std::string word = "{" + each.begin().key() + "}";
        std::vector<Json> out;
        for (const Json& value : each.begin().value()) {
            std::string text = merged.dump();
            const std::string with = value.get<std::string>();
            for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + with.size())) {
                text.replace(at, word.size(), with);
            }
            out.push_back(Json::parse(text));
        }
        return out;
    }

    void add_case(const Json& merged, ScenarioFile& out) {
        ScenarioCase c;
        c.name = merged.at("name").get<std::string>();
        case_ = c.name;
        if (c.name.empty() ||
            c.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_-+.") != std::string::npos ||
            c.name[0] == '.') {
            refuse("a name has letters, digits and _-+. only");
        }
        if (!names_.insert(c.name).second) {
            refuse("the name is taken twice");
        }
        require_keys(
            merged, {"name", "about", "group", "replay", "convert", "bounds", "short", "tolerance", "golden", "repeat"},
            "case");
        c.repeat = merged.value("repeat", 1);
        if (c.repeat < 1 || c.repeat > kMaxRepeat) {
            refuse("repeat is 1 to " + std::to_string(kMaxRepeat));
        }
        c.group = merged.value("group", c.name);
        read_replay(merged, c);
        read_bounds(merged.value("bounds", Json::object()), c.bounds);
        for (const Json& s : merged.value("short", Json::array())) {
            require_keys(s, {"metric", "min", "max", "why"}, "short");
            c.shortfalls.push_back({bound_of(s.at("metric").get<std::string>(), s), s.at("why").get<std::string>()});
        }
        const Json tolerances = merged.value("tolerance", Json::object());
        for (const auto& [metric, most] : tolerances.items()) {
            c.tolerances.push_back({metric, most.get<double>()});
        }
        const std::string golden = merged.value("golden", "none");
        if (golden != "none" && golden != "rows" && golden != "metrics") {
            refuse("golden is none, rows or metrics");
        }
        c.golden = golden == "rows" ? Golden::kRows : golden == "metrics" ? Golden::kMetrics : Golden::kNone;
        out.cases.push_back(std::move(c));
        case_.clear();
    }

    [[nodiscard]] Bound bound_of(const std::string& metric, const Json& json) const {
        Bound b;
        b.metric = metric;
        if (json.contains("min")) {
            b.least = json["min"].get<double>();
        }
        if (json.contains("max")) {
            b.most = json["max"].get<double>();
        }
        if (metric.empty() || metric[0] != '/' || (!b.least && !b.most)) {
            refuse("bound '" + metric + "': needs a metric like /ate_rmse_m, and min or max");
        }
        return b;
    }

    void read_bounds(const Json& json, std::vector<Bound>& out) const {
        for (const auto& [metric, limits] : json.items()) {
            require_keys(limits, {"min", "max"}, "bounds");
            out.push_back(bound_of(metric, limits));
        }
    }

    void read_replay(const Json& merged, ScenarioCase& c) const {
        const Json& replay = merged.at("replay");
        if (merged.contains("convert")) {
            const Json& convert = merged["convert"];
            require_keys(convert, {"format", "file", "viewpoints", "class"}, "convert");
            c.convert.format = convert.at("format").get<std::string>();
            c.convert.file = existing(convert.at("file").get<std::string>(), c.missing);
            if (convert.contains("class")) {
                c.convert.object_class = convert["class"].get<std::string>();
            }
            if (convert.contains("viewpoints")) {
                c.convert.viewpoints = existing(convert["viewpoints"].get<std::string>(), c.missing);
            }
        }
        c.arguments = {"--no-progress"};
        for (const auto& [key, value] : replay.items()) {
            if (value.is_boolean()) {
                if (value.get<bool>()) {
                    c.arguments.push_back("--" + key);
                }
                continue;
            }
            for (const Json& one : value.is_array() ? value : Json::array({value})) {  // an option given several times
                c.arguments.push_back("--" + key);
                c.arguments.push_back(argument(key, one.is_string() ? one.get<std::string>() : one.dump(), c));
            }
        }
        if (c.missing.empty()) {
            check(c);
        }
    }

    [[nodiscard]] std::string argument(const std::string& key, const std::string& value, ScenarioCase& c) const {
        const bool is_path = key == "root" || key == "calib" || key == "mount" || key == "other" ||
                             (key == "detections" && value != "none" && value != "labels") ||
                             (key == "ego" && value != "estimate");
        return is_path ? existing(value, c.missing) : value;
    }

    [[nodiscard]] std::string existing(const std::string& text, std::string& missing) const {
        const fs::path path = resolve(text, missing);
        if (missing.empty() && !fs::exists(path)) {
            missing = path.string() + " is not there";
        }
        return path.string();
    }

    /// As replay itself will see it.
    void check(ScenarioCase& c) const {
        std::vector<std::string> words{"semtrack-sil", "replay", "--out", "."};
        words.insert(words.end(), c.arguments.begin(), c.arguments.end());
        std::vector<const char*> argv;
        for (const std::string& w : words) {
            argv.push_back(w.c_str());
        }
        try {
            c.drive = parse_command_line(static_cast<int>(argv.size()), argv.data()).replay.drive;
        } catch (const InputError& error) {
            refuse(error.what());
        }
        if (c.drive.layout == "world") {
            return;
        }
        try {
            const DrivePaths paths = drive_paths(c.drive.layout, c.drive.root, c.drive.sequence);
            if (c.drive.images && !fs::is_directory(paths.left)) {
                c.missing = paths.left.string() + " is not there";
            }
        } catch (const InputError& error) {
            c.missing = error.what();
        }
    }

    void read_table(const Json& json, TableSpec& table) const {
        require_keys(json, {"title", "note", "columns", "references"}, "table");
        table.title = json.value("title", "");
        table.note = json.value("note", "");
        for (const Json& c : json.at("columns")) {
            require_keys(c, {"name", "metric", "digits"}, "table column");
            table.columns.push_back({c.at("name"), c.at("metric"), c.value("digits", 2)});
        }
        for (const Json& r : json.value("references", Json::array())) {
            TableReference reference;
            reference.name = r.at("name");
            for (const Json& v : r.at("values")) {
                reference.values.push_back(v.is_null() ? std::nullopt : std::optional<double>(v.get<double>()));
            }
            table.references.push_back(reference);
        }
    }

    fs::path path_;
    Json json_;
    Json defaults_;
    std::string case_;
    std::set<std::string> names_;
};

}  // namespace

ScenarioFile read_scenario_file(const fs::path& path) {
    return Reader(path).read();
}

}  // namespace semtrack::sil
