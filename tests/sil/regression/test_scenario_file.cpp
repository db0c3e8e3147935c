#include "sil/regression/scenario_file.hpp"

#include <cstdlib>

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class ScenarioFiles : public TempFiles {
protected:
    [[nodiscard]] ScenarioFile read(const std::string& text) const { return read_scenario_file(write("s.json", text)); }
    [[nodiscard]] static std::string one(const std::string& more) {
        return R"({"cases": [{"name": "a", "replay": {"layout": "world", "sequence": "empty"})" + more + "}]}";
    }
};

TEST_F(ScenarioFiles, ACaseBecomesTheReplaysCommandLine) {
    const ScenarioFile file = read(
        R"({"defaults": {"replay": {"layout": "world", "detections": "labels"}},
            "cases": [{"name": "a", "replay": {"sequence": "street", "last": 7, "points": true, "realtime": false}}]})");
    ASSERT_EQ(file.cases.size(), 1U);
    const std::vector<std::string> want{"--no-progress", "--layout", "world", "--detections", "labels", "--sequence",
                                        "street",        "--last",   "7",     "--points"};
    EXPECT_EQ(file.cases[0].arguments, want);
    EXPECT_EQ(file.cases[0].group, "a");
    EXPECT_TRUE(file.cases[0].missing.empty());
}

TEST_F(ScenarioFiles, BoundsShortfallsAndTolerancesAreRead) {
    const ScenarioFile file = read(one(
        R"(, "bounds": {"/ate_rmse_m": {"max": 0.5}, "/car_recall": {"min": 0.8, "max": 1}},
            "short": [{"metric": "/id_switches", "max": 0, "why": "coasting ends too early"}],
            "tolerance": {"/ate_rmse_m": 0.01}, "golden": "rows")"));
    const ScenarioCase& c = file.cases[0];
    ASSERT_EQ(c.bounds.size(), 2U);
    EXPECT_FALSE(c.bounds[0].least.has_value());
    EXPECT_EQ(*c.bounds[1].least, 0.8);
    ASSERT_EQ(c.shortfalls.size(), 1U);
    EXPECT_EQ(c.shortfalls[0].why, "coasting ends too early");
    EXPECT_EQ(c.tolerances[0].most, 0.01);
    EXPECT_EQ(c.golden, Golden::kRows);
}

TEST_F(ScenarioFiles, EachMakesACaseOfEveryValue) {
    const ScenarioFile file = read(
        R"({"cases": [{"name": "x-{s}", "group": "g", "each": {"s": ["empty", "street"]},
                       "replay": {"layout": "world", "sequence": "{s}"}}]})");
    ASSERT_EQ(file.cases.size(), 2U);
    EXPECT_EQ(file.cases[1].name, "x-street");
    EXPECT_EQ(file.cases[1].drive.sequence, "street");
    EXPECT_EQ(file.cases[1].group, "g");
}

TEST_F(ScenarioFiles, DataThatIsNotThereSkipsTheCaseByName) {
    ::unsetenv("SEMTRACK_TEST_NOWHERE");
    const ScenarioFile file = read(
        R"({"cases": [{"name": "a", "replay": {"layout": "raw", "root": "$SEMTRACK_TEST_NOWHERE/raw", "sequence": "x"}},
                      {"name": "b", "replay": {"layout": "odometry", "root": "nothing", "sequence": "06"}}]})");
    EXPECT_NE(file.cases[0].missing.find("SEMTRACK_TEST_NOWHERE"), std::string::npos);
    EXPECT_NE(file.cases[1].missing.find("nothing"), std::string::npos);
}

TEST_F(ScenarioFiles, RelativePathsStartAtTheFile) {
    (void)write("drives/sequences/06/calib.txt", "");
    (void)write("dets.txt", "");
    const ScenarioFile file = read(
        R"({"cases": [{"name": "a", "replay": {"layout": "odometry", "root": "drives", "sequence": "06",
                                              "detections": "dets.txt"}}]})");
    EXPECT_EQ(file.cases[0].drive.root, at("drives"));
    EXPECT_NE(std::find(file.cases[0].arguments.begin(), file.cases[0].arguments.end(), at("dets.txt").string()),
              file.cases[0].arguments.end());
}

TEST_F(ScenarioFiles, WhatCannotBeMeantIsRefusedByFileAndCase) {
    EXPECT_REFUSED(read("{"), "s.json");
    EXPECT_REFUSED(read(R"({"cases": []})"), "no cases");
    EXPECT_REFUSED(read(R"({"casez": []})"), "casez");
    EXPECT_REFUSED(read(one(R"(, "bound": {})")), "unknown key 'bound'");
    EXPECT_REFUSED(read(one(R"(, "bounds": {"ate": {"max": 1}})")), "case a");
    EXPECT_REFUSED(read(one(R"(, "bounds": {"/ate": {}})")), "case a");
    EXPECT_REFUSED(read(one(R"(, "golden": "yes")")), "golden");
    EXPECT_REFUSED(read(R"({"cases": [{"name": "../a", "replay": {}}]})"), "name");
    EXPECT_REFUSED(
        read(R"({"cases": [{"name": "a", "replay": {"layout": "world", "sequence": "street", "lost": 3}}]})"),
        "case a");
    EXPECT_REFUSED(read(R"({"cases": [{"name": "a", "replay": {"layout": "world", "sequence": "empty"}},
                                      {"name": "a", "replay": {"layout": "world", "sequence": "empty"}}]})"),
                   "twice");
    EXPECT_REFUSED(read_scenario_file(at("nowhere.json")), "nowhere.json");
}

}  // namespace
}  // namespace semtrack::sil
