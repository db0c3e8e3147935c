#include "sil/regression/baseline.hpp"

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class Baselines : public TempFiles {
protected:
    void results(const std::string& object, const std::string& ate, const std::string& can = "1122") const {
        (void)write("r/frames.txt", "4\n5\n");
        (void)write("r/ego.txt", "1 0 0 0\n1 0 0 1\n");
        (void)write("r/ego.csv", "frame,time_us\n4,100\n5,200\n");
        (void)write("r/objects.txt", "4 1 Car 0.5\n5 1 Car " + object + "\n5 2 Car 3\n");
        (void)write("r/states.csv", "frame,time_us,id\n4,100,1\n");
        (void)write("r/list.csv", "frame,time_us,object\n4,100,\n4,100,0\n");
        (void)write("r/can.log", "(0.1) can0 201#11\n(0.2) can0 201#" + can + "\n");
        (void)write("r/metrics.json", "{\"ate\": " + ate + ", \"run\": {\"lists\": 2}}");
    }
    [[nodiscard]] std::vector<std::string> compare(Golden golden = Golden::kRows,
                                                   const std::vector<Tolerance>& tolerances = {}) const {
        return compare_with_baseline(at("r"), at("b"), golden, tolerances);
    }
};

TEST_F(Baselines, TheSameRunHasNoComplaint) {
    results("0.6", "0.25");
    write_baseline(at("r"), at("b"));
    EXPECT_TRUE(compare().empty());
}

TEST_F(Baselines, TheFirstRowThatDiffersIsNamedByFrameAndObject) {
    results("0.6", "0.25");
    write_baseline(at("r"), at("b"));
    results("0.60000000000000009", "0.25", "1123");
    const auto lines = compare();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NE(lines[0].find("objects.txt: frame 5, object 1"), std::string::npos) << lines[0];
}

TEST_F(Baselines, ACanFrameThatDiffersIsFoundByItsFrame) {
    results("0.6", "0.25");
    write_baseline(at("r"), at("b"));
    results("0.6", "0.25", "1123");
    EXPECT_NE(compare().at(0).find("can.log: frame 5"), std::string::npos);
}

TEST_F(Baselines, RowsThatAreNewOrGoneAreSaid) {
    results("0.6", "0.25");
    write_baseline(at("r"), at("b"));
    (void)write("r/objects.txt", "4 1 Car 0.5\n5 1 Car 0.6\n");
    EXPECT_NE(compare().at(0).find("frame 5, object 2 (the row is gone)"), std::string::npos) << compare()[0];
    (void)write("r/objects.txt", "4 1 Car 0.5\n4 3 Car 1\n5 1 Car 0.6\n5 2 Car 3\n");
    EXPECT_NE(compare().at(0).find("frame 4, object 3 (a new row)"), std::string::npos) << compare()[0];
}

TEST_F(Baselines, MetricsMayMoveWithinTheirTolerance) {
    results("0.6", "0.25");
    write_baseline(at("r"), at("b"));
    results("0.7", "0.26");
    EXPECT_TRUE(compare(Golden::kMetrics, {{"/ate", 0.02}}).empty());
    EXPECT_EQ(compare(Golden::kMetrics, {{"/ate", 0.005}}).size(), 1U);
    EXPECT_EQ(compare(Golden::kMetrics).size(), 1U);
}

TEST_F(Baselines, WithoutABaselineThereIsOneComplaint) {
    results("0.6", "0.25");
    EXPECT_NE(compare().at(0).find("no baseline"), std::string::npos);
}

}  // namespace
}  // namespace semtrack::sil
