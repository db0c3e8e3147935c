#include <gtest/gtest.h>

#include <fstream>

#include "sil/regression/frame_times.hpp"
#include "sil/regression/match_means.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {
namespace {

class TableMetrics : public testing::Test {
protected:
    std::filesystem::path file(const std::string& text) {
        const std::filesystem::path path = testing::TempDir() + "semtrack_table_metrics.csv";
        std::ofstream(path) << text;
        return path;
    }
};

TEST_F(TableMetrics, TimesAreMedianAndMaximumInMilliseconds) {
    FrameTimes times;
    times.add(
        file("frame,total_us,match_us,reject_us,ego_us,features\n0,3000,100,10,7,5\n1,1000,300,20,8,5\n"
             "2,2000,200,60,9,5\n"));
    const auto metrics = times.metrics();
    EXPECT_DOUBLE_EQ(metrics["total_ms"].get<double>(), 2.0);
    EXPECT_DOUBLE_EQ(metrics["total_max_ms"].get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(metrics["match_ms"].get<double>(), 0.2);
    EXPECT_DOUBLE_EQ(metrics["front_end_ms"].get<double>(), 0.26);
    EXPECT_DOUBLE_EQ(metrics["front_end_max_ms"].get<double>(), 0.32);
    EXPECT_FALSE(metrics.contains("features_ms"));
}

TEST_F(TableMetrics, OfSeveralRunsEachFramesShortestTimeCounts) {
    FrameTimes times;
    times.add(file("frame,total_us,ego_us\n0,3000,100\n1,1000,300\n"));
    times.add(file("frame,total_us,ego_us\n0,1500,200\n1,9000,100\n"));
    EXPECT_DOUBLE_EQ(times.metrics()["total_max_ms"].get<double>(), 1.5);
    EXPECT_DOUBLE_EQ(times.metrics()["total_ms"].get<double>(), 1.25);
    EXPECT_DOUBLE_EQ(times.metrics()["ego_max_ms"].get<double>(), 0.1);
    EXPECT_THROW(times.add(file("frame,total_us,ego_us\n0,3000,100\n")), InputError);
}

TEST_F(TableMetrics, MatchesAreMeansOverAllFramesButTheFirst) {
    const auto matches = match_means(file("frame,speed,features,inliers\n0,,0,0\n1,2.5,100,80\n2,2.5,300,220\n"));
    EXPECT_DOUBLE_EQ(matches["features_mean"].get<double>(), 200.0);
    EXPECT_DOUBLE_EQ(matches["inliers_mean"].get<double>(), 150.0);
    EXPECT_DOUBLE_EQ(matches["inlier_share"].get<double>(), 0.75);
}

TEST_F(TableMetrics, GivenOneFrameOrNoFeaturesMatchesAreNotKnown) {
    for (const char* const text : {"frame,features,inliers\n0,0,0\n", "frame,features,inliers\n0,0,0\n1,0,0\n"}) {
        const auto matches = match_means(file(text));
        EXPECT_TRUE(matches["features_mean"].is_null());
        EXPECT_TRUE(matches["inlier_share"].is_null());
    }
}

}  // namespace
}  // namespace semtrack::sil
