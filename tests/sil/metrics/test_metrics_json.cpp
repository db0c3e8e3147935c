#include "sil/metrics/metrics_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {
namespace {

TEST(MetricsJson, WhatIsNotKnownIsNull) {
    const auto json = nlohmann::json::parse(to_json(Metrics{}));
    for (const char* name : {"ate_rmse_m", "rpe_trans_mean_m", "rpe_rot_mean_deg", "segment_trans_percent",
                             "segment_rot_deg_per_100m", "car_recall", "run"}) {
        EXPECT_TRUE(json.at(name).is_null()) << name;
    }
    EXPECT_EQ(json.at("frames"), 0);
}

TEST(MetricsJson, NeitherNanNorInfinityLeaves) {
    Metrics m;
    m.ego = TrajectoryErrors{};
    m.ego->ate_rmse_m = std::numeric_limits<double>::quiet_NaN();
    m.ego->rpe_trans_mean_m = std::numeric_limits<double>::infinity();
    m.ego->rpe_rot_mean_deg = 0.1;
    const auto json = nlohmann::json::parse(to_json(m));
    EXPECT_TRUE(json.at("ate_rmse_m").is_null());
    EXPECT_TRUE(json.at("rpe_trans_mean_m").is_null());
    EXPECT_EQ(json.at("rpe_rot_mean_deg").get<double>(), 0.1);
}

TEST(MetricsJson, TheRunsCountsKeepTheirOrder) {
    Metrics m;
    m.run = {{"zulu", 3}, {"alpha", -1}};
    const std::string text = to_json(m);
    EXPECT_LT(text.find("zulu"), text.find("alpha"));
    EXPECT_EQ(nlohmann::json::parse(text).at("run").at("alpha"), -1);
}

TEST(NumberText, SeventeenDigitsBringBackTheSameBits) {
    for (const double value : {0.1, 1.0 / 3.0, -2.5e-308, 5e-324, 1.7976931348623157e308, -0.0, 123456789.0}) {
        const std::string text = number_text(value);
        double back = 1.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), back);
        EXPECT_EQ(error, std::errc{});
        EXPECT_EQ(std::signbit(back), std::signbit(value));
        EXPECT_EQ(back, value);
    }
    EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "");
    EXPECT_EQ(number_text(2.0), "2");
}

}  // namespace
}  // namespace semtrack::sil
