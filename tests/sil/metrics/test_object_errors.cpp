#include "sil/metrics/object_errors.hpp"

#include <gtest/gtest.h>

#include "math/trig.hpp"
#include "rows.hpp"

namespace semtrack::sil {
namespace {

using test::truth_of;

ObjectRow car(int frame, int id, double left, const Vec3& bottom) {
    ObjectRow o;
    o.frame = frame;
    o.id = id;
    o.type = "Car";
    o.box = {left, 100.0, left + 50.0, 140.0};
    o.size_m = Vec3(3.9, 1.6, 1.5);
    o.bottom_c0 = bottom;
    return o;
}

TEST(ObjectErrors, ResultsEqualToTheLabelsHaveFullRecallAndNoError) {
    const std::vector<ObjectRow> rows{car(0, 1, 100.0, {1, 2, 10}), car(0, 2, 300.0, {3, 2, 20})};
    const ObjectErrors e = compare_objects(rows, {0}, truth_of(rows, {0}));
    EXPECT_EQ(*e.recall, 1.0);
    EXPECT_EQ(*e.position_mean_percent, 0.0);
    EXPECT_EQ(*e.heading_mean_deg, 0.0);
    EXPECT_EQ(e.unmatched_rows, 0);
    EXPECT_EQ(e.id_switches, 0);
}

TEST(ObjectErrors, PositionIsTheDistanceOfTheBottomsOverTheLabelsDistance) {
    const ObjectErrors e =
        compare_objects({car(0, 1, 100.0, {0, 3, 4.5})}, {0}, truth_of({car(0, 1, 100.0, {0, 3, 4})}, {0}));
    EXPECT_NEAR(*e.position_mean_percent, 10.0, 1e-12);
    EXPECT_NEAR(*e.position_median_m, 0.5, 1e-12);
}

TEST(ObjectErrors, EmptyResultsHaveRecallZeroAndEmptyLabelsNone) {
    EXPECT_EQ(*compare_objects({}, {0}, truth_of({car(0, 1, 100.0, {1, 2, 10})}, {0})).recall, 0.0);
    const ObjectErrors e = compare_objects({car(0, 1, 100.0, {1, 2, 10})}, {0}, truth_of({}, {0}));
    EXPECT_FALSE(e.recall.has_value());
    EXPECT_EQ(e.unmatched_rows, 1);
}

TEST(ObjectErrors, FarCarsAreJudgedApartWhateverTheirHeight) {
    std::vector<ObjectRow> labels{car(0, 1, 100.0, {0, 2, 60}), car(0, 2, 300.0, {0, 2, 80}),
                                  car(0, 3, 500.0, {0, 2, 40})};
    for (ObjectRow& label : labels) {
        label.box.bottom = label.box.top + 12.0;
    }
    ObjectRow result = labels[0];
    result.bottom_c0(2) += 6.0;
    const ObjectErrors e = compare_objects({result}, {0}, truth_of(labels, {0}));
    EXPECT_EQ(e.labelled_cars, 0);
    EXPECT_EQ(e.far_cars, 2);
    EXPECT_EQ(*e.far_recall, 0.5);
    EXPECT_NEAR(*e.far_position_mean_percent, 100.0 * 6.0 / labels[0].bottom_c0.norm(), 1e-12);
}

// A car that drives along x at 5 m/s and turns by 0.02 rad a frame (0.1 s) to the left.
std::vector<ObjectRow> turning_car() {
    std::vector<ObjectRow> out;
    for (int n = 0; n < 5; ++n) {
        out.push_back(car(n, 1, 100.0, {0.5 * n, 2, 20}));
        out.back().rotation_y = -0.02 * n;
    }
    return out;
}

ObjectTruthSet standing_camera(const std::vector<ObjectRow>& labels) {
    ObjectTruthSet truth = truth_of(labels, {0, 1, 2, 3, 4});
    for (const int n : truth.frames) {
        truth.T_f_c0[n] = Pose{};
        truth.time_us[n] = 100000 * n;
    }
    return truth;
}

TEST(ObjectErrors, PublishedYawRatesOfMovingCarsMeetTheTurnOfTheLabels) {
    const std::vector<ObjectRow> labels = turning_car();
    std::vector<ObjectRow> results = labels;
    results[1].yaw_rate = 0.2;
    results[2].yaw_rate = 0.23;
    results[3].yaw_rate = -0.2;
    const ObjectErrors e = compare_objects(results, {0, 1, 2, 3, 4}, standing_camera(labels));
    EXPECT_EQ(e.yaw_rates, 3);
    EXPECT_NEAR(*e.yaw_rate_median_radps, 0.03, 1e-9);
    EXPECT_NEAR(*e.yaw_rate_mean_radps, (0.0 + 0.03 + 0.4) / 3.0, 1e-9);
}

TEST(ObjectErrors, RowsWithoutAPublishedYawRateSayNothingOfIt) {
    const std::vector<ObjectRow> labels = turning_car();
    const ObjectErrors e = compare_objects(labels, {0, 1, 2, 3, 4}, standing_camera(labels));
    EXPECT_EQ(e.yaw_rates, 0);
    EXPECT_FALSE(e.yaw_rate_median_radps.has_value());
}

TEST(ObjectErrors, TheLongestTrackIsTheLongestPathThatACarKeptItsIdOver) {
    const std::vector<ObjectRow> labels = turning_car();  // 0.5 m a frame, 2 m in all
    const ObjectTruthSet truth = standing_camera(labels);
    const std::map<int, Pose>& ego = truth.T_f_c0;
    EXPECT_NEAR(*compare_objects(labels, truth.frames, truth, ego).longest_track_m, 2.0, 1e-9);
    std::vector<ObjectRow> results = labels;
    results[3].id = results[4].id = 9;
    EXPECT_NEAR(*compare_objects(results, truth.frames, truth, ego).longest_track_m, 1.0, 1e-9);
    results[1].id = 8;
    EXPECT_NEAR(*compare_objects(results, truth.frames, truth, ego).longest_track_m, 0.5, 1e-9);
    EXPECT_FALSE(compare_objects({}, truth.frames, truth, ego).longest_track_m.has_value());
}

TEST(ObjectErrors, FramesThatAreNotLabelledSayNothing) {
    const ObjectErrors e =
        compare_objects({car(1, 1, 100.0, {1, 2, 10})}, {0, 1}, truth_of({car(0, 1, 100.0, {1, 2, 10})}, {0}));
    EXPECT_EQ(e.frames_compared, 1);
    EXPECT_EQ(e.unmatched_rows, 0);
    EXPECT_EQ(e.matched_cars, 0);
}

TEST(ObjectErrors, LabelledFramesThatWereNotProcessedSayNothing) {
    const ObjectErrors e = compare_objects({}, {1}, truth_of({car(0, 1, 100.0, {1, 2, 10})}, {0}));
    EXPECT_EQ(e.labelled_cars, 0);
    EXPECT_FALSE(e.recall.has_value());
}

TEST(ObjectErrors, ACarFoundAsVanMeetsAndAPedestrianDoesNot) {
    ObjectRow van = car(0, 5, 100.0, {1, 2, 10});
    van.type = "Van";
    const ObjectTruthSet truth = truth_of({car(0, 1, 100.0, {1, 2, 10})}, {0});
    EXPECT_EQ(compare_objects({van}, {0}, truth).matched_cars, 1);
    van.type = "Pedestrian";
    EXPECT_EQ(compare_objects({van}, {0}, truth).matched_cars, 0);
}

TEST(ObjectErrors, SmallHiddenAndCutCarsAndVansDoNotCountButMayBeMet) {
    std::vector<ObjectRow> labels;
    for (int k = 0; k < 4; ++k) {
        labels.push_back(car(0, k, 100.0 * k, {1, 2, 10}));
    }
    labels[0].box.bottom = labels[0].box.top + 24.0;
    labels[1].occluded = 3;
    labels[2].truncated = 0.6;
    labels[3].type = "Van";
    const ObjectErrors e = compare_objects(labels, {0}, truth_of(labels, {0}));
    EXPECT_EQ(e.labelled_cars, 0);
    EXPECT_EQ(e.unmatched_rows, 0);
    EXPECT_FALSE(e.position_mean_percent.has_value());
}

TEST(ObjectErrors, OneResultInADontCareAreaIsIgnoredAndOneOutsideIsCounted) {
    ObjectRow area = car(0, -1, 90.0, {-1000, -1000, -1000});
    area.type = "DontCare";
    area.box.right = 200.0;
    const ObjectErrors e =
        compare_objects({car(0, 1, 100.0, {1, 2, 10}), car(0, 2, 400.0, {1, 2, 10})}, {0}, truth_of({area}, {0}));
    EXPECT_EQ(e.unmatched_rows, 1);
}

TEST(ObjectErrors, TheBetterOverlapWins) {
    std::vector<ObjectRow> results{car(0, 1, 108.0, {1, 2, 12}), car(0, 2, 101.0, {1, 2, 10})};
    const ObjectErrors e = compare_objects(results, {0}, truth_of({car(0, 7, 100.0, {1, 2, 10})}, {0}));
    EXPECT_EQ(*e.position_median_m, 0.0);
    EXPECT_EQ(e.unmatched_rows, 1);
}

TEST(ObjectErrors, APairStaysWhileItMeetsEvenWhenAnotherIsNearer) {
    const std::vector<ObjectRow> results{car(0, 1, 100.0, {1, 2, 10}), car(1, 1, 108.0, {1, 2, 10}),
                                         car(1, 2, 101.0, {1, 2, 10})};
    const ObjectTruthSet truth = truth_of({car(0, 7, 100.0, {1, 2, 10}), car(1, 7, 100.0, {1, 2, 10})}, {0, 1});
    EXPECT_EQ(compare_objects(results, {0, 1}, truth).id_switches, 0);
}

TEST(ObjectErrors, AMatchLostAndRegainedByAnotherIsOneIdSwitch) {
    const std::vector<ObjectRow> results{car(0, 1, 100.0, {1, 2, 10}), car(2, 1, 108.0, {1, 2, 10}),
                                         car(2, 2, 101.0, {1, 2, 10})};
    const ObjectTruthSet truth =
        truth_of({car(0, 7, 100.0, {1, 2, 10}), car(1, 7, 100.0, {1, 2, 10}), car(2, 7, 100.0, {1, 2, 10})}, {0, 1, 2});
    EXPECT_EQ(compare_objects(results, {0, 1, 2}, truth).id_switches, 1);
}

TEST(ObjectErrors, HeadingsAreComparedAcrossTheBorderOfPiAndFlipsAreCounted) {
    ObjectRow label = car(0, 1, 100.0, {1, 2, 10});
    ObjectRow result = label;
    label.rotation_y = kPi - 0.01;
    result.rotation_y = -kPi + 0.01;
    ObjectErrors e = compare_objects({result}, {0}, truth_of({label}, {0}));
    EXPECT_NEAR(*e.heading_mean_deg, 0.02 * 180.0 / kPi, 1e-9);
    EXPECT_EQ(*e.heading_flip_share, 0.0);
    result.rotation_y = -0.01;
    e = compare_objects({result}, {0}, truth_of({label}, {0}));
    EXPECT_NEAR(*e.heading_mean_deg, 180.0, 1e-9);
    EXPECT_EQ(*e.heading_flip_share, 1.0);
}

/// Ego drives forward 1 m a frame of 0.1 s; a car ahead keeps its distance (10 m/s), another is parked.
ObjectTruthSet drive(int frames) {
    ObjectTruthSet t;
    for (int n = 0; n < frames; ++n) {
        t.frames.push_back(n);
        t.T_f_c0[n] = {Mat3::Identity(), Vec3(0.0, 0.0, 1.0 * n)};
        t.time_us[n] = 1700000000000000 + 100000 * n;
        ObjectRow ahead = car(n, 1, 100.0, {0.0, 1.65, 20.0});
        ahead.rotation_y = -0.5 * kPi;  // heading along +z
        ObjectRow parked = car(n, 2, 400.0, {4.0, 1.65, 40.0 - n});
        parked.rotation_y = 0.5 * kPi;
        t.labels.push_back(ahead);
        t.labels.push_back(parked);
    }
    return t;
}

TEST(ObjectErrors, TheTruthsSpeedComesFromTheLabelsInTheWorld) {
    const std::vector<std::optional<TruthMotion>> speeds = truth_motions(drive(15));
    EXPECT_FALSE(speeds[0].has_value());
    EXPECT_NEAR(speeds[2]->speed, 10.0, 1e-9);
    EXPECT_NEAR(speeds[3]->speed, 0.0, 1e-9);
    EXPECT_FALSE(speeds[28].has_value());
}

TEST(ObjectErrors, ACarComingTowardsUsBackwardsIsReversing) {
    ObjectTruthSet t = drive(3);
    for (ObjectRow& label : t.labels) {
        label.rotation_y = 0.5 * kPi;
    }
    EXPECT_NEAR(truth_motions(t)[2]->speed, -10.0, 1e-9);
}

TEST(ObjectErrors, SpeedsOfMovingAndParkedCarsAreJudgedApart) {
    const ObjectTruthSet truth = drive(15);
    std::vector<ObjectRow> results = truth.labels;
    std::vector<int> frames = truth.frames;
    for (ObjectRow& r : results) {
        r.speed = r.id == 1 ? 9.5 : -0.2;
    }
    const ObjectErrors e = compare_objects(results, frames, truth);
    EXPECT_NEAR(*e.speed_mean_mps, 0.5, 1e-9);
    EXPECT_NEAR(*e.speed_median_mps, 0.5, 1e-9);
    EXPECT_NEAR(*e.parked_speed_median_mps, 0.2, 1e-12);
    EXPECT_NEAR(*e.parked_speed_p95_mps, 0.2, 1e-12);
}

TEST(ObjectErrors, WithoutEgoTruthThereAreNoSpeeds) {
    ObjectTruthSet truth = drive(15);
    truth.T_f_c0.clear();
    const ObjectErrors e = compare_objects(truth.labels, truth.frames, truth);
    EXPECT_EQ(*e.recall, 1.0);
    EXPECT_FALSE(e.speed_mean_mps.has_value());
    EXPECT_FALSE(e.parked_speed_median_mps.has_value());
}

TEST(Quantile, MedianAndRanksAreThoseOfTheSortedValues) {
    EXPECT_FALSE(median({}).has_value());
    EXPECT_EQ(*median({3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(*median({4.0, 1.0, 2.0, 3.0}), 2.5);
    EXPECT_EQ(*quantile({1.0, 2.0, 3.0, 4.0}, 0.5), 2.0);
    EXPECT_EQ(*quantile({5.0}, 0.95), 5.0);
}

}  // namespace
}  // namespace semtrack::sil
