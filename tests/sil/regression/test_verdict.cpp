#include "sil/regression/verdict.hpp"

#include <gtest/gtest.h>

namespace semtrack::sil {
namespace {

using Json = nlohmann::ordered_json;

const Json kMetrics = Json::parse(R"({"ate": 0.5, "none": null, "tracking": {"mota": 0.25}})");

TEST(Bounds, HoldAtTheirLimitsAndBreakBeyond) {
    EXPECT_TRUE(broken_bounds(kMetrics, {{"/ate", 0.5, 0.5}, {"/tracking/mota", 0.2, {}}}).empty());
    const auto broken = broken_bounds(kMetrics, {{"/ate", {}, 0.49}, {"/tracking/mota", 0.26, {}}});
    ASSERT_EQ(broken.size(), 2U);
    EXPECT_NE(broken[0].find("/ate"), std::string::npos);
    EXPECT_NE(broken[0].find(" 0.5 "), std::string::npos);
}

TEST(Bounds, AMetricThatIsNullOrNotThereBreaksThem) {
    EXPECT_EQ(broken_bounds(kMetrics, {{"/none", {}, 1.0}, {"/gone", {}, 1.0}, {"no pointer", 0.0, {}}}).size(), 3U);
    EXPECT_EQ(broken_bounds(Json(), {{"/ate", {}, 1.0}}).size(), 1U);
}

TEST(Shortfalls, SayTodaysFigureAndWhenTheyAreMet) {
    const auto lines = shortfall_lines(kMetrics, {{{"/ate", {}, 0.1}, "why"}, {{"/ate", {}, 1.0}, "why"}});
    EXPECT_EQ(lines[0].rfind("short: /ate 0.5, wanted at most 0.1", 0), 0U) << lines[0];
    EXPECT_EQ(lines[1].rfind("no longer short", 0), 0U) << lines[1];
}

TEST(Junit, CountsEscapesAndNames) {
    CaseResult failed;
    failed.name = "b";
    failed.status = CaseStatus::kFailed;
    failed.failures = {"1 < 2 & \"x\""};
    CaseResult skipped;
    skipped.name = "c";
    skipped.status = CaseStatus::kSkipped;
    skipped.skipped = "no data";
    CaseResult passed;
    passed.name = "a";
    const std::string xml = junit_xml("s", {passed, failed, skipped});
    EXPECT_NE(xml.find(R"(tests="3" failures="1" errors="0" skipped="1")"), std::string::npos);
    EXPECT_NE(xml.find("1 &lt; 2 &amp; &quot;x&quot;"), std::string::npos);
    EXPECT_NE(xml.find(R"(<skipped message="no data"/>)"), std::string::npos);
}

TEST(Table, HasARowAGroupAndTheReferencesBelow) {
    TableSpec spec;
    spec.title = "T";
    spec.note = "simulated";
    spec.columns = {{"ate", "/ate", 2}, {"none", "/none", 1}};
    spec.references = {{"peer", {0.25, std::nullopt}}};
    const std::string text = table_text(spec, {{"ours", kMetrics}});
    EXPECT_NE(text.find("simulated"), std::string::npos);
    EXPECT_NE(text.find("ours      0.50         -"), std::string::npos) << text;
    EXPECT_LT(text.find("ours"), text.find("peer"));
    EXPECT_EQ(table_text(spec, {}), "");
}

}  // namespace
}  // namespace semtrack::sil
