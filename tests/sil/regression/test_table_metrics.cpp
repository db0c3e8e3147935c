#include "sil/regression/table_metrics.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace semtrack::sil {
namespace {

class TableMetrics : public testing::Test {
protected:
    std::filesystem::path file(const std::string& text) {
        const std::filesystem::path path = testing::TempDir() + "semtrack_table_metrics.csv";
        std::ofstream(path) << text;
        return path;
    }
    nlohmann::ordered_json metrics_ = nlohmann::ordered_json::object();
};

TEST_F(TableMetrics, TimesAreMedianAndMaximumInMilliseconds) {
    add_timing(file("frame,total_us,ego_us,features\n0,3000,100,5\n1,1000,300,5\n2,2000,200,5\n"), metrics_);
    EXPECT_DOUBLE_EQ(metrics_["timing"]["total_ms"].get<double>(), 2.0);
    EXPECT_DOUBLE_EQ(metrics_["timing"]["total_max_ms"].get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(metrics_["timing"]["ego_ms"].get<double>(), 0.2);
    EXPECT_FALSE(metrics_["timing"].contains("features_ms"));
}

TEST_F(TableMetrics, MatchesAreMeansOverAllFramesButTheFirst) {
    add_matches(file("frame,speed,features,inliers\n0,,0,0\n1,2.5,100,80\n2,2.5,300,220\n"), metrics_);
    EXPECT_DOUBLE_EQ(metrics_["matches"]["features_mean"].get<double>(), 200.0);
    EXPECT_DOUBLE_EQ(metrics_["matches"]["inliers_mean"].get<double>(), 150.0);
    EXPECT_DOUBLE_EQ(metrics_["matches"]["inlier_share"].get<double>(), 0.75);
}

TEST_F(TableMetrics, GivenOneFrameOrNoFeaturesMatchesAreNotKnown) {
    for (const char* const text : {"frame,features,inliers\n0,0,0\n", "frame,features,inliers\n0,0,0\n1,0,0\n"}) {
        add_matches(file(text), metrics_);
        EXPECT_TRUE(metrics_["matches"]["features_mean"].is_null());
        EXPECT_TRUE(metrics_["matches"]["inlier_share"].is_null());
    }
}

}  // namespace
}  // namespace semtrack::sil
