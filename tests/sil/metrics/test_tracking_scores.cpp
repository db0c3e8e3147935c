#include "sil/metrics/tracking_scores.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rng.hpp"
#include "rows.hpp"
#include "sil/metrics/assignment.hpp"

namespace semtrack::sil {
namespace {

using test::car;
using test::truth_of;

const Vec3 kPlace(0.0, 1.6, 20.0);

TrackingScores judged(const std::vector<ObjectRow>& results, const std::vector<ObjectRow>& labels,
                      const std::vector<int>& frames) {
    TrackingEvaluation evaluation;
    evaluation.add(results, frames, truth_of(labels, frames));
    return evaluation.scores();
}

std::vector<ObjectRow> track(int id, double left, int frames) {
    std::vector<ObjectRow> out;
    for (int f = 0; f < frames; ++f) {
        out.push_back(car(f, id, left, kPlace));
    }
    return out;
}

TEST(Assignment, TakesTheBestSumOfAllPermutations) {
    Rng rng(3U);
    for (int k = 0; k < 200; ++k) {
        std::vector<double> v(12);
        for (double& x : v) {
            x = rng.uniform();
        }
        const std::vector<std::size_t> taken = best_assignment(v, 3, 4);
        double got = 0.0;
        for (std::size_t r = 0; r < 3; ++r) {
            ASSERT_LT(taken[r], 4U);
            got += v[r * 4 + taken[r]];
        }
        double best = 0.0;
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = 0; b < 4; ++b) {
                for (std::size_t c = 0; c < 4; ++c) {
                    if (a != b && b != c && a != c) {
                        best = std::max(best, v[a] + v[4 + b] + v[8 + c]);
                    }
                }
            }
        }
        EXPECT_NEAR(got, best, 1e-12);
    }
}

TEST(Assignment, MoreRowsThanColumnsLeavesSomeWithout) {
    const std::vector<std::size_t> taken = best_assignment({0.1, 0.9, 0.5}, 3, 1);
    EXPECT_EQ(taken[0], kNotAssigned);
    EXPECT_EQ(taken[1], 0U);
    EXPECT_EQ(taken[2], kNotAssigned);
    EXPECT_EQ(best_assignment({}, 2, 0)[1], kNotAssigned);
    EXPECT_TRUE(best_assignment({}, 0, 5).empty());
}

TEST(TrackingScores, ResultsEqualToTheLabelsArePerfect) {
    const TrackingScores s = judged(track(7, 100, 4), track(1, 100, 4), {0, 1, 2, 3});
    EXPECT_EQ(*s.mota, 1.0);
    EXPECT_EQ(*s.motp, 1.0);
    EXPECT_NEAR(*s.hota, 1.0, 1e-12);
    EXPECT_EQ(s.id_switches + s.fragmentations, 0);
}

TEST(TrackingScores, EmptyResultsAreZeroAndWithoutMotpAndEmptyLabelsNothing) {
    const TrackingScores s = judged({}, track(1, 100, 3), {0, 1, 2});
    EXPECT_EQ(*s.mota, 0.0);
    EXPECT_EQ(*s.hota, 0.0);
    EXPECT_FALSE(s.motp.has_value());
    EXPECT_FALSE(judged(track(1, 100, 3), {}, {0, 1, 2}).mota.has_value());
    EXPECT_FALSE(judged(track(1, 100, 3), {}, {0, 1, 2}).hota.has_value());
}

TEST(TrackingScores, AnIdThatChangesHalfWayHalvesTheAssociation) {
    std::vector<ObjectRow> results = track(7, 100, 4);
    results[2].id = results[3].id = 8;
    const TrackingScores s = judged(results, track(1, 100, 4), {0, 1, 2, 3});
    EXPECT_EQ(s.id_switches, 1);
    EXPECT_NEAR(*s.mota, 0.75, 1e-12);
    EXPECT_NEAR(*s.deta, 1.0, 1e-12);
    EXPECT_NEAR(*s.assa, 0.5, 1e-12);  // each half: 2 common frames of 4
    EXPECT_NEAR(*s.hota, std::sqrt(0.5), 1e-12);
}

TEST(TrackingScores, AMatchLostAndRegainedWhileAnotherIsNearerIsOneSwitch) {
    std::vector<ObjectRow> results = track(7, 105, 3);
    results.erase(results.begin() + 1);         // lost in frame 1
    results.push_back(car(2, 8, 100, kPlace));  // nearer than 7 when that is back
    const TrackingScores s = judged(results, track(1, 100, 3), {0, 1, 2});
    EXPECT_EQ(s.id_switches, 1);
    EXPECT_EQ(s.fragmentations, 1);
    EXPECT_EQ(s.misses, 1);
    EXPECT_EQ(s.false_alarms, 1);
}

TEST(TrackingScores, APairIsKeptWhileAnotherIsNearer) {
    std::vector<ObjectRow> results = track(7, 105, 3);
    results.push_back(car(1, 8, 100, kPlace));
    const TrackingScores s = judged(results, track(1, 100, 3), {0, 1, 2});
    EXPECT_EQ(s.id_switches, 0);
    EXPECT_EQ(s.false_alarms, 1);
    EXPECT_NEAR(*s.motp, 45.0 / 55.0, 1e-12);
}

TEST(TrackingScores, MotpIsTheMeanOverlapAndHotaCountsOverlapsItReaches) {
    // 40 of 60 px in common: 2/3, reached by the 13 thresholds 0.05 .. 0.65 of 19.
    const TrackingScores s = judged(track(7, 110, 2), track(1, 100, 2), {0, 1});
    EXPECT_NEAR(*s.motp, 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(*s.hota, 13.0 / 19.0, 1e-12);
}

TEST(TrackingScores, ResultsOnVansSmallOrInDontCareAreasDoNotCount) {
    std::vector<ObjectRow> labels{car(0, 1, 100, kPlace), car(0, 2, 300, kPlace), car(0, -1, 500, kPlace)};
    labels[1].type = "Van";
    labels[2].type = "DontCare";
    std::vector<ObjectRow> results{car(0, 7, 100, kPlace), car(0, 8, 300, kPlace), car(0, 9, 505, kPlace),
                                   car(0, 10, 900, kPlace)};
    results[3].box.bottom = results[3].box.top + 25.0;
    const TrackingScores s = judged(results, labels, {0});
    EXPECT_EQ(s.labels, 1);
    EXPECT_EQ(s.false_alarms, 0);
    EXPECT_EQ(*s.mota, 1.0);
}

}  // namespace
}  // namespace semtrack::sil
