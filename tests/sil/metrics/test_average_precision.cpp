#include "sil/metrics/average_precision.hpp"

#include <gtest/gtest.h>

#include "rows.hpp"
#include "sil/metrics/position_curve.hpp"

namespace semtrack::sil {
namespace {

using test::car;
using test::truth_of;

constexpr std::size_t kKitti = 0;
constexpr std::size_t kPaper = 1;
constexpr std::size_t kBirdsEye = 0;
constexpr std::size_t k3d = 1;
constexpr std::size_t kHalf = 1;  // overlap 0.5
constexpr std::size_t kEasy = 0;
constexpr std::size_t kHard = 2;

Vec3 place(double x) {
    return {x, 1.6, 20.0};
}

std::vector<ObjectRow> four_cars() {
    return {car(0, 1, 100, place(-15)), car(0, 2, 300, place(-5)), car(0, 3, 500, place(5)), car(0, 4, 700, place(15))};
}

AveragePrecision judged(const std::vector<ObjectRow>& results, const std::vector<ObjectRow>& labels) {
    AveragePrecision out;
    out.add(results, {0}, truth_of(labels, {0}));
    return out;
}

TEST(AveragePrecision, ResultsEqualToTheLabelsScoreAHundredInEveryTable) {
    const AveragePrecision ap = judged(four_cars(), four_cars());
    for (std::size_t r = 0; r < 2; ++r) {
        for (std::size_t o = 0; o < 2; ++o) {
            for (std::size_t t = 0; t < 3; ++t) {
                for (std::size_t d = 0; d < 3; ++d) {
                    EXPECT_EQ(*ap.curve(r, o, t, d).ap11(), 100.0);
                    EXPECT_EQ(*ap.curve(r, o, t, d).ap40(), 100.0);
                }
            }
        }
    }
}

TEST(AveragePrecision, OneOfFourWithoutFalseAlarm) {
    const AveragePrecision ap = judged({four_cars()[1]}, four_cars());
    EXPECT_NEAR(*ap.curve(kKitti, kBirdsEye, kHalf, kEasy).ap11(), 300.0 / 11.0, 1e-12);
    EXPECT_NEAR(*ap.curve(kKitti, k3d, kHalf, kEasy).ap40(), 25.0, 1e-12);
}

TEST(AveragePrecision, PrecisionIsTheBestAtThatOrHigherRecall) {
    // Scores 0.9 false alarm, 0.8 hit, 0.7 hit, of two labels: precision 0, 1/2, 2/3.
    std::vector<ObjectRow> results{car(0, 9, 900, place(30)), car(0, 1, 100, place(-15)), car(0, 2, 300, place(-5))};
    results[0].score = 0.9;
    results[1].score = 0.8;
    results[2].score = 0.7;
    const AveragePrecision ap = judged(results, {four_cars()[0], four_cars()[1]});
    EXPECT_NEAR(*ap.curve(kKitti, kBirdsEye, kHalf, kEasy).ap11(), 200.0 / 3.0, 1e-12);
    EXPECT_NEAR(*ap.curve(kKitti, kBirdsEye, kHalf, kEasy).ap40(), 200.0 / 3.0, 1e-12);
}

TEST(AveragePrecision, EqualScoresStandTogetherWhateverTheirOrder) {
    const ObjectRow hit = car(0, 1, 100, place(-15));
    for (const int id : {0, 2}) {  // sorted before and after the hit
        const AveragePrecision ap = judged({hit, car(0, id, 900, place(30))}, {four_cars()[0]});
        EXPECT_NEAR(*ap.curve(kKitti, kBirdsEye, kHalf, kEasy).ap11(), 50.0, 1e-12);
    }
}

TEST(AveragePrecision, EmptyResultsAreZeroAndEmptyLabelsNothing) {
    EXPECT_EQ(*judged({}, four_cars()).curve(kKitti, k3d, kHalf, kEasy).ap11(), 0.0);
    EXPECT_FALSE(judged(four_cars(), {}).curve(kKitti, k3d, kHalf, kEasy).ap11().has_value());
    EXPECT_FALSE(judged({}, {}).curve(kKitti, k3d, kHalf, kEasy).ap40().has_value());
}

TEST(AveragePrecision, AResultInADontCareAreaIsNoFalseAlarmAndOneOutsideIs) {
    std::vector<ObjectRow> labels = four_cars();
    labels.push_back(car(0, -1, 900, Vec3(-1000, -1000, -1000)));
    labels.back().type = "DontCare";
    std::vector<ObjectRow> results = four_cars();
    results.push_back(car(0, 8, 910, place(40)));
    results.push_back(car(0, 9, 1100, place(60)));
    for (const std::size_t o : {kBirdsEye, k3d}) {
        EXPECT_EQ(judged(results, labels).curve(kKitti, o, kHalf, kEasy).false_alarms(), 1);
    }
}

TEST(AveragePrecision, AVanFoundAsCarIsNeitherHitNorFalseAlarm) {
    std::vector<ObjectRow> labels = four_cars();
    labels[0].type = "Van";
    const AveragePrecision ap = judged(four_cars(), labels);
    EXPECT_EQ(ap.curve(kKitti, kBirdsEye, kHalf, kEasy).labels, 3);
    EXPECT_EQ(ap.curve(kKitti, kBirdsEye, kHalf, kEasy).hits(), 3);
    EXPECT_EQ(ap.curve(kKitti, kBirdsEye, kHalf, kEasy).false_alarms(), 0);
}

TEST(AveragePrecision, ASecondResultOnALabelIsAFalseAlarm) {
    std::vector<ObjectRow> results = four_cars();
    results.push_back(car(0, 9, 100, place(-15.2)));
    EXPECT_EQ(judged(results, four_cars()).curve(kKitti, kBirdsEye, kHalf, kEasy).false_alarms(), 1);
}

TEST(AveragePrecision, DifficultiesGoByHeightHidingAndCut) {
    std::vector<ObjectRow> labels = four_cars();
    labels[0].box.bottom = labels[0].box.top + 39.0;
    labels[1].occluded = 2;
    labels[2].truncated = 0.4;
    const AveragePrecision ap = judged({}, labels);
    const auto count = [&ap](std::size_t rules, std::size_t difficulty) {
        return ap.curve(rules, kBirdsEye, kHalf, difficulty).labels;
    };
    EXPECT_EQ(count(kKitti, 0), 1);
    EXPECT_EQ(count(kKitti, 1), 2);
    EXPECT_EQ(count(kKitti, kHard), 4);
    EXPECT_EQ(count(kPaper, 0), 2);  // without truncation
    EXPECT_EQ(count(kPaper, 1), 3);
    EXPECT_EQ(count(kPaper, kHard), 4);
}

TEST(AveragePrecision, MovedAlongByHalfItsLengthItIsFoundAtAQuarterAndNotAtAHalf) {
    const AveragePrecision ap = judged({car(0, 1, 100, place(-13))}, {four_cars()[0]});
    EXPECT_EQ(*ap.curve(kKitti, kBirdsEye, 0, kEasy).ap11(), 100.0);
    EXPECT_EQ(*ap.curve(kKitti, kBirdsEye, kHalf, kEasy).ap11(), 0.0);
}

TEST(AveragePrecision, FramesThatAreNotLabelledOrNotProcessedSayNothing) {
    AveragePrecision ap;
    std::vector<ObjectRow> results{car(0, 1, 100, place(0)), car(1, 1, 100, place(0))};
    ap.add(results, {0, 1}, truth_of({car(0, 1, 100, place(0)), car(2, 1, 100, place(0))}, {0, 2}));
    EXPECT_EQ(ap.curve(kKitti, k3d, kHalf, kEasy).labels, 1);
    EXPECT_EQ(*ap.curve(kKitti, k3d, kHalf, kEasy).ap11(), 100.0);
}

TEST(PositionCurve, ErrorsOfPairsByTheirOverlapSeenFromAbove) {
    PositionEvaluation position;
    const std::vector<ObjectRow> labels{car(0, 1, 100, Vec3(0, 0, 10)), car(0, 2, 300, Vec3(0, 0, 20))};
    // 1 m along of 4 x 2 m: overlap 3/5, 10 %; 2 m along: 1/3, 10 %.
    std::vector<ObjectRow> results{car(0, 1, 100, Vec3(1, 0, 10)), car(0, 2, 300, Vec3(2, 0, 20))};
    position.add(results, {0}, truth_of(labels, {0}));
    const PositionCurve curve = position.curve(kEasy);
    EXPECT_EQ(curve.labels, 2);
    EXPECT_NEAR(*curve.points[0].rate, 1.0, 1e-12);
    EXPECT_NEAR(*curve.points[0].error_percent, 10.0, 1e-12);
    EXPECT_NEAR(*curve.points[20].rate, 0.5, 1e-12);
    EXPECT_EQ(*curve.points[30].rate, 0.0);
    EXPECT_FALSE(curve.points[30].error_percent.has_value());
}

}  // namespace
}  // namespace semtrack::sil
