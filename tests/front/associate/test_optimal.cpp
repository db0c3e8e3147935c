// The assignment has the largest sum of similarities above the threshold: against brute force on small problems, and by
// its own proof (no exchange along a cycle improves it) on full ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "front/associate/associate.hpp"
#include "math/so3.hpp"
#include "support/noise.hpp"

namespace semtrack {
namespace {

constexpr ObjectClass kSome[4] = {ObjectClass::kCar, ObjectClass::kVan, ObjectClass::kPedestrian,
                                  ObjectClass::kCyclist};

struct Problem {
    TrackBoxes tracks;
    DetectionList list;
};

/// Boxes crowded together, so that most tracks have several candidates.
Box2d random_box(Rng& rng, double spread_px) {
    const double w = between(rng, 30.0, 70.0);
    const double h = between(rng, 25.0, 50.0);
    const double u = between(rng, 100.0, 100.0 + spread_px);
    const double v = between(rng, 100.0, 130.0);
    return {u, v, u + w, v + h};
}

Problem random_problem(Rng& rng, int tracks, int detections, double spread_px) {
    Problem p;
    for (int i = 0; i < tracks; ++i) {
        TrackBox track{random_box(rng, spread_px), kSome[rng.below(4)]};
        if (i % 2 == 0) {  // the others' motion is not known
            track.sigma_px = {between(rng, 2.0, 20.0), 0.0, between(rng, 1.0, 4.0), between(rng, 1.0, 4.0)};
        }
        EXPECT_TRUE(p.tracks.try_push_back(track));
    }
    for (int i = 0; i < detections; ++i) {
        Detection d;
        d.box = random_box(rng, spread_px);
        d.object_class = kSome[rng.below(4)];
        EXPECT_TRUE(p.list.items.try_push_back(d));
    }
    return p;
}

/// What a pair is worth: what it has above the threshold, a fifth of it whatever the edges say; below it is not a pair.
double worth(const Problem& p, int track, int detection) {
    const double s = box_similarity(p.tracks[track], p.list.items[detection]);
    const double share = 0.2 + 0.8 * edge_agreement(p.tracks[track], p.list.items[detection]);
    return s < kLostSimilarity ? 0.0 : share * (s - kLostSimilarity);
}

double best_sum(const Problem& p, int track, unsigned used) {
    if (track == p.tracks.size()) {
        return 0.0;
    }
    double best = best_sum(p, track + 1, used);
    for (int d = 0; d < p.list.items.size(); ++d) {
        const double w = worth(p, track, d);
        if (w > 0.0 && (used & (1U << static_cast<unsigned>(d))) == 0U) {
            best = std::max(best, w + best_sum(p, track + 1, used | (1U << static_cast<unsigned>(d))));
        }
    }
    return best;
}

/// Every track in turn takes the best that is left.
double greedy_sum(const Problem& p) {
    double sum = 0.0;
    unsigned used = 0;
    for (int t = 0; t < p.tracks.size(); ++t) {
        int best = -1;
        for (int d = 0; d < p.list.items.size(); ++d) {
            const bool free = (used & (1U << static_cast<unsigned>(d))) == 0U;
            best = free && worth(p, t, d) > (best < 0 ? 0.0 : worth(p, t, best)) ? d : best;
        }
        if (best >= 0) {
            sum += worth(p, t, best);
            used |= 1U << static_cast<unsigned>(best);
        }
    }
    return sum;
}

/// Sum of the assignment; every rule of it is checked on the way.
double checked_sum(const Problem& p, const Assignment& out) {
    double sum = 0.0;
    std::vector<int> taken(static_cast<std::size_t>(kMaxDetections), 0);
    for (int t = 0; t < p.tracks.size(); ++t) {
        const int d = out.detection_of_track[static_cast<std::size_t>(t)];
        if (d < 0) {
            continue;
        }
        EXPECT_LT(d, p.list.items.size());
        EXPECT_EQ(++taken[static_cast<std::size_t>(d)], 1) << "a detection went to two tracks";
        EXPECT_TRUE(out.detection_used[static_cast<std::size_t>(d)]);
        EXPECT_GE(box_similarity(p.tracks[t], p.list.items[d]), kLostSimilarity);
        EXPECT_TRUE(may_be_one(p.tracks[t].object_class, p.list.items[d].object_class));
        sum += worth(p, t, d);
    }
    for (int d = 0; d < kMaxDetections; ++d) {
        EXPECT_EQ(out.detection_used[static_cast<std::size_t>(d)], taken[static_cast<std::size_t>(d)] == 1);
    }
    return sum;
}

TEST(AssociateOptimum, EqualsBruteForceOnSmallProblemsWhereGreedyDoesNot) {
    const auto associator = std::make_unique<Associator>();
    Rng rng(41);
    int greedy_is_worse = 0;
    int pairs_left_out = 0;
    for (int k = 0; k < 3000; ++k) {
        const Problem p = random_problem(rng, rng.below(7), rng.below(8), 120.0);
        Assignment out;
        associator->run(p.tracks, p.list, out);
        const double best = best_sum(p, 0, 0U);
        ASSERT_NEAR(checked_sum(p, out), best, 1e-9) << "problem " << k;
        greedy_is_worse += greedy_sum(p) < best - 1e-6 ? 1 : 0;
        for (int t = 0; t < p.tracks.size(); ++t) {
            pairs_left_out += out.detection_of_track[static_cast<std::size_t>(t)] < 0 ? 1 : 0;
        }
    }
    EXPECT_GT(greedy_is_worse, 200);
    EXPECT_GT(pairs_left_out, 500);
}

/// Cheapest exchange: rows are tracks, one node more stands for all that is free (a track's own "not seen" is always).
double cheapest_cycle(const Problem& p, const Assignment& out) {
    const int n = p.tracks.size();
    const auto size = static_cast<std::size_t>(n) + 1U;
    std::vector<double> d(size * size, 1e9);
    const auto value = [&](int t) {
        const int own = out.detection_of_track[static_cast<std::size_t>(t)];
        return own < 0 ? 0.0 : worth(p, t, own);
    };
    for (int t = 0; t < n; ++t) {
        const auto row = static_cast<std::size_t>(t) * size;
        double free = 0.0;
        for (int k = 0; k < p.list.items.size(); ++k) {
            free = out.detection_used[static_cast<std::size_t>(k)] ? free : std::max(free, worth(p, t, k));
        }
        d[row + static_cast<std::size_t>(n)] = value(t) - free;
        d[static_cast<std::size_t>(n) * size + static_cast<std::size_t>(t)] = 0.0;
        for (int other = 0; other < n; ++other) {
            const int there = out.detection_of_track[static_cast<std::size_t>(other)];
            if (other != t && there >= 0 && worth(p, t, there) > 0.0) {
                d[row + static_cast<std::size_t>(other)] = value(t) - worth(p, t, there);
            }
        }
    }
    for (std::size_t via = 0; via < size; ++via) {
        for (std::size_t a = 0; a < size; ++a) {
            for (std::size_t b = 0; b < size; ++b) {
                d[a * size + b] = std::min(d[a * size + b], d[a * size + via] + d[via * size + b]);
            }
        }
    }
    double cheapest = 0.0;
    for (std::size_t a = 0; a < size; ++a) {
        cheapest = std::min(cheapest, d[a * size + a]);
    }
    return cheapest;
}

TEST(AssociateOptimum, NoExchangeImprovesAFullTable) {
    const auto associator = std::make_unique<Associator>();
    Rng rng(42);
    int spoiled_found = 0;
    for (int k = 0; k < 40; ++k) {
        const Problem p = random_problem(rng, kMaxObjects, kMaxDetections, 1000.0);
        Assignment out;
        associator->run(p.tracks, p.list, out);
        (void)checked_sum(p, out);
        ASSERT_GT(cheapest_cycle(p, out), -1e-9) << "problem " << k;
        for (int& d : out.detection_of_track) {  // so that the proof can fail: one pair less
            if (d >= 0) {
                out.detection_used[static_cast<std::size_t>(d)] = false;
                d = -1;
                break;
            }
        }
        spoiled_found += cheapest_cycle(p, out) < -1e-6 ? 1 : 0;
    }
    EXPECT_EQ(spoiled_found, 40);
}

TEST(AssociateOptimum, ATrackIsLostWhenItsBestSimilarityFallsBelowTheThreshold) {
    const auto associator = std::make_unique<Associator>();
    int kept = 0;
    int lost = 0;
    for (int shift = 0; shift <= 60; ++shift) {
        Problem p;
        ASSERT_TRUE(p.tracks.try_push_back({{100, 100, 140, 130}, ObjectClass::kCar}));
        Detection d;
        d.box = {100.0 + shift, 100.0, 150.0 + shift, 140.0};
        ASSERT_TRUE(p.list.items.try_push_back(d));
        Assignment out;
        associator->run(p.tracks, p.list, out);
        const bool similar = box_similarity(p.tracks[0], d) >= kLostSimilarity;
        EXPECT_EQ(out.detection_of_track[0], similar ? 0 : -1) << shift;
        (similar ? kept : lost) += 1;
    }
    EXPECT_GT(kept, 20);
    EXPECT_GT(lost, 10);
}

TEST(AssociateOptimum, SimilarityFallsWithDistanceAndWithShape) {
    const TrackBox track{{100, 100, 160, 140}, ObjectClass::kCar};
    Detection d;
    d.box = track.box;
    EXPECT_DOUBLE_EQ(box_similarity(track, d), 1.0);
    double last = 1.0;
    for (const double shift : {5.0, 15.0, 30.0, 45.0}) {
        d.box = {100 + shift, 100, 160 + shift, 140};
        EXPECT_LT(box_similarity(track, d), last);
        last = box_similarity(track, d);
    }
    last = 1.0;
    for (const double grow : {3.0, 8.0, 15.0}) {  // the same centre
        d.box = {100 - grow, 100 - grow, 160 + grow, 140 + grow};
        EXPECT_LT(box_similarity(track, d), last);
        last = box_similarity(track, d);
    }
    d.box = {400, 100, 460, 140};
    EXPECT_EQ(box_similarity(track, d), 0.0);
}

TEST(AssociateOptimum, AChainOfPoorPairsDoesNotPushOutTheGoodOnes) {
    // Parked in a row, the first car's box missing and a new one at the end: shifting everybody by one place would make
    // one pair more.
    const auto associator = std::make_unique<Associator>();
    Problem p;
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(p.tracks.try_push_back({{100.0 + 25.0 * i, 100, 160.0 + 25.0 * i, 140}, ObjectClass::kCar}));
        Detection d;
        d.box = {125.0 + 25.0 * i, 100, 185.0 + 25.0 * i, 140};
        ASSERT_TRUE(p.list.items.try_push_back(d));
    }
    Assignment out;
    associator->run(p.tracks, p.list, out);
    EXPECT_EQ(out.detection_of_track[0], -1);
    EXPECT_EQ(out.detection_of_track[1], 0);
    EXPECT_EQ(out.detection_of_track[2], 1);
    EXPECT_FALSE(out.detection_used[2]);
}

TEST(AssociateOptimum, AWalkersSwingingWidthDoesNotLoseIt) {
    const TrackBox track{{100, 100, 120, 180}, ObjectClass::kPedestrian};
    Detection d;
    d.object_class = ObjectClass::kPedestrian;
    d.box = {112, 100, 136, 180};  // three fifths of its width further on, a stride wider
    EXPECT_GE(box_similarity(track, d), kLostSimilarity);
    d.box = {160, 100, 180, 180};
    EXPECT_LT(box_similarity(track, d), kLostSimilarity);
}

TEST(AssociateOptimum, ATurnOfTheCameraDoesNotHandBoxesToTheirNeighbours) {
    const PinholeCamera camera{720, 720, 620, 180};
    const Mat3 R_cur_prev = so3_exp(Vec3(0.01, -0.085, 0.0));  // 4.9 degrees: one place further in a row of parked cars
    const auto associator = std::make_unique<Associator>();
    Problem still;
    Problem turned;
    for (int i = 0; i < 8; ++i) {
        const Box2d before{300.0 + 60.0 * i, 170.0, 356.0 + 60.0 * i, 200.0};
        const Box2d after = rotated_box(before, R_cur_prev, camera);
        ASSERT_TRUE(still.tracks.try_push_back({before, ObjectClass::kCar}));
        ASSERT_TRUE(turned.tracks.try_push_back({after, ObjectClass::kCar}));
        Detection d;
        d.box = after;
        ASSERT_TRUE(still.list.items.try_push_back(d));
    }
    turned.list = still.list;
    Assignment without;
    Assignment with;
    associator->run(still.tracks, still.list, without);
    associator->run(turned.tracks, turned.list, with);
    int wrong = 0;
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(with.detection_of_track[static_cast<std::size_t>(i)], i);
        wrong += without.detection_of_track[static_cast<std::size_t>(i)] != i ? 1 : 0;
    }
    EXPECT_EQ(wrong, 8);  // what the compensation is for
}

}  // namespace
}  // namespace semtrack
