// The score that ranks objects.
#include "pipeline/ranking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace semtrack {
namespace {

/// Mean of the overlap over a normal distribution, by many points.
double by_many_points(double l, double w, double c, double s, double sigma) {
    double sum = 0.0;
    double weight = 0.0;
    for (int k = -4000; k <= 4000; ++k) {
        const double x = 0.001 * k;
        const double p = std::exp(-0.5 * x * x);
        const double a = std::max(0.0, l - std::fabs(x * sigma * c)) * std::max(0.0, w - std::fabs(x * sigma * s));
        sum += p * a / (2.0 * l * w - a);
        weight += p;
    }
    return sum / weight;
}

TEST(Ranking, ExpectedOverlapIsTheMeanOverTheDepthsErrorWithin2Percent) {
    for (const double sigma : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0}) {
        for (const double a : {0.0, 0.3, 1.0, 1.5708}) {
            EXPECT_NEAR(expected_overlap(3.9, 1.6, std::cos(a), std::sin(a), sigma),
                        by_many_points(3.9, 1.6, std::cos(a), std::sin(a), sigma), sigma > 2.0 ? 0.04 : 0.02)
                << sigma << " " << a;
        }
    }
    EXPECT_NEAR(expected_overlap(3.9, 1.6, 1.0, 0.0, 0.0), 1.0, 1e-3);
}

class RankingTest : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(track_->window.frames.try_push_back(ObjectFrame{}));
        ObjectFrame& frame = track_->window.newest();
        frame.state.p = Vec3(20.0, 0.0, 0.0);
        track_->window.size_m = Vec3(3.9, 1.6, 1.5);
        track_->window.covariance = 0.25 * Mat6::Identity();
        track_->existence = 0.99;
        track_->detector_score = 0.9;
        track_->hits = 20;
    }
    std::unique_ptr<Track> track_ = std::make_unique<Track>();
};

TEST_F(RankingTest, WhatSpeaksAgainstABoxLowersItsScore) {
    const double score = ranking_score(*track_);
    EXPECT_GT(score, 0.2);
    EXPECT_LE(score, 1.0);
    const auto with = [&](auto change) {
        Track track = *track_;
        change(track);
        return ranking_score(track);
    };
    EXPECT_LT(with([](Track& t) { t.window.covariance *= 4.0; }), score);
    EXPECT_LT(with([](Track& t) { t.frames_unseen = 1; }), 0.5 * score);
    EXPECT_LT(with([](Track& t) { t.truncation = 0.5; }), 0.6 * score);
    EXPECT_LT(with([](Track& t) { t.hits = 1; }), 0.5 * score);
    EXPECT_LT(with([](Track& t) { t.detector_score = 0.4; }), 0.5 * score);
    EXPECT_EQ(with([](Track& t) { t.existence = 0.0; }), 0.0);
}

TEST_F(RankingTest, OnlyTheErrorAlongTheLineOfSightCounts) {
    const double score = ranking_score(*track_);
    track_->window.covariance(1, 1) = 100.0;
    EXPECT_NEAR(ranking_score(*track_), score, 1e-12);
}

}  // namespace
}  // namespace semtrack
