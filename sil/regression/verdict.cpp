#include "sil/regression/verdict.hpp"

#include <algorithm>

#include "sil/metrics/number_text.hpp"
#include "sil/regression/json.hpp"

namespace semtrack::sil {

namespace {

std::optional<double> value_of(const Json& metrics, const std::string& metric) {
    try {
        const Json::json_pointer pointer(metric);
        if (metrics.is_object() && metrics.contains(pointer) && metrics[pointer].is_number()) {
            return metrics[pointer].get<double>();
        }
    } catch (const Json::exception&) {
    }
    return std::nullopt;
}

std::string limits_text(const Bound& b) {
    std::string text;
    if (b.least) {
        text += "at least " + short_text(*b.least);
    }
    if (b.most) {
        text += (text.empty() ? "at most " : " and at most ") + short_text(*b.most);
    }
    return text;
}

bool holds(const std::optional<double>& value, const Bound& b) {
    return value && (!b.least || *value >= *b.least) && (!b.most || *value <= *b.most);
}

std::string short_number(const std::optional<double>& value) {
    return value ? short_text(*value) : std::string("unknown");
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c < ' ' ? ' ' : c;
        }
    }
    return out;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) {
        out += (out.empty() ? "" : "; ") + line;
    }
    return out;
}

std::ptrdiff_t count(const std::vector<CaseResult>& results, CaseStatus status) {
    return std::count_if(results.begin(), results.end(), [&](const CaseResult& r) { return r.status == status; });
}

const char* status_text(CaseStatus status) {
    return status == CaseStatus::kPassed ? "passed" : status == CaseStatus::kFailed ? "FAILED" : "skipped";
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string right_aligned(const std::string& text, std::size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0U, ' ') + text;
}

}  // namespace

std::vector<std::string> broken_bounds(const Json& metrics, const std::vector<Bound>& bounds) {
    std::vector<std::string> out;
    for (const Bound& b : bounds) {
        const std::optional<double> value = value_of(metrics, b.metric);
        if (!holds(value, b)) {
            out.push_back("bound " + b.metric + ": " + short_number(value) + " is not " + limits_text(b));
        }
    }
    return out;
}

std::vector<std::string> shortfall_lines(const Json& metrics, const std::vector<Shortfall>& shortfalls) {
    std::vector<std::string> out;
    for (const Shortfall& s : shortfalls) {
        const std::optional<double> value = value_of(metrics, s.wanted.metric);
        out.push_back((holds(value, s.wanted) ? "no longer short: " : "short: ") + s.wanted.metric + " " +
                      short_number(value) + ", wanted " + limits_text(s.wanted) + ": " + s.why);
    }
    return out;
}

std::string junit_xml(const std::string& suite, const std::vector<CaseResult>& results) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"" +
                       escaped(suite) + "\" tests=\"" + std::to_string(results.size()) + "\" failures=\"" +
                       std::to_string(count(results, CaseStatus::kFailed)) + "\" errors=\"0\" skipped=\"" +
                       std::to_string(count(results, CaseStatus::kSkipped)) + "\">\n";
    for (const CaseResult& r : results) {
        text += "    <testcase classname=\"" + escaped(suite) + "\" name=\"" + escaped(r.name) + "\" time=\"" +
                fixed_text(r.seconds, 2) + "\"";
        if (r.status == CaseStatus::kFailed) {
            text += "><failure message=\"" + escaped(joined(r.failures)) + "\"/></testcase>\n";
        } else if (r.status == CaseStatus::kSkipped) {
            text += "><skipped message=\"" + escaped(r.skipped) + "\"/></testcase>\n";
        } else {
            text += "/>\n";
        }
    }
    return text + "  </testsuite>\n</testsuites>\n";
}

std::string results_json(const std::vector<CaseResult>& results) {
    Json json = Json::object();
    for (const CaseResult& r : results) {
        Json entry = Json::object();
        entry["status"] = r.status == CaseStatus::kFailed ? "failed" : status_text(r.status);
        entry["failures"] = r.failures;
        entry["short"] = r.shorts;
        if (!r.skipped.empty()) {
            entry["missing"] = true;
        }
        entry["metrics"] = r.metrics;
        json[r.name] = entry;
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string results_text(const std::vector<CaseResult>& results) {
    std::size_t width = 0;
    for (const CaseResult& r : results) {
        width = std::max(width, r.name.size());
    }
    std::string text;
    std::ptrdiff_t shorts = 0;
    for (const CaseResult& r : results) {
        text += padded(r.name, width) + "  " + status_text(r.status);
        text += r.status == CaseStatus::kSkipped ? " (" + r.skipped + ")\n" : "\n";
        for (const std::string& line : r.failures) {
            text += "    " + line + "\n";
        }
        for (const std::string& line : r.shorts) {
            text += "    " + line + "\n";
        }
        shorts += r.shorts.empty() ? 0 : 1;
    }
    return text + std::to_string(count(results, CaseStatus::kPassed)) + " passed (" + std::to_string(shorts) +
           " of all cases short of what users want), " + std::to_string(count(results, CaseStatus::kFailed)) +
           " failed, " + std::to_string(count(results, CaseStatus::kSkipped)) + " skipped\n";
}

std::string table_text(const TableSpec& table, const GroupMetrics& groups) {
    if (table.columns.empty() || groups.empty()) {
        return "";
    }
    struct Row {
        std::string name;
        std::vector<std::optional<double>> values;
    };
    std::vector<Row> rows;
    for (const auto& [name, metrics] : groups) {
        Row row{name, {}};
        for (const TableColumn& c : table.columns) {
            row.values.push_back(value_of(metrics, c.metric));
        }
        rows.push_back(row);
    }
    for (const TableReference& r : table.references) {
        rows.push_back({r.name, r.values});
    }
    std::size_t name_width = 0;
    for (const Row& row : rows) {
        name_width = std::max(name_width, row.name.size());
    }
    std::string text = table.title + "\n" + (table.note.empty() ? "" : table.note + "\n") + padded("", name_width);
    std::vector<std::size_t> widths;
    for (const TableColumn& c : table.columns) {
        widths.push_back(std::max<std::size_t>(c.name.size() + 2U, 10U));
        text += right_aligned(c.name, widths.back());
    }
    text += "\n";
    for (const Row& row : rows) {
        text += padded(row.name, name_width);
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            const bool known = i < row.values.size() && row.values[i];
            text += right_aligned(known ? fixed_text(*row.values[i], table.columns[i].digits) : "-", widths[i]);
        }
        text += "\n";
    }
    return text;
}

}  // namespace semtrack::sil
