// The block-wise solution is compared with a dense Cholesky of the whole system in long double.
#include "estimate/solver/normal_equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "estimate/solver/random_problem.hpp"

namespace semtrack {
namespace {

using test::DenseSystem;
using test::flat;
using test::RandomProblem;
using test::relative_difference;
using test::Shape;
using test::symmetric;

TEST(NormalEquations, EliminationOfPointsGivesTheSolutionOfTheWholeSystem) {
    int checked = 0;
    for (const Shape& shape : {Shape{1, 0, false}, Shape{1, 1, false, 1.0}, Shape{2, 5, false}, Shape{3, 20, true},
                               Shape{kPoseFrames, 40, false}, Shape{kPoseFrames, 40, true}, Shape{3, 60, true, 0.9},
                               Shape{kPoseFrames, 30, true, 1.0}}) {
        for (const double lambda : {0.0, 1e-4, 1.0}) {
            for (std::uint32_t seed = 1; seed <= 4; ++seed) {
                // Every point is seen often enough to be known: a single observation gives it three rows.
                RandomProblem problem(shape, seed);
                for (int p = 0; p < shape.points; ++p) {
                    problem.add_observation(p % shape.frames, p);
                }
                auto step = std::make_unique<SolverStep>();
                ASSERT_EQ(problem.system().solve(lambda, *step), Status::kOk);
                const std::vector<long double> x = problem.dense().solve(static_cast<long double>(lambda));
                ASSERT_FALSE(x.empty());
                EXPECT_LT(relative_difference(*step, shape, x), 1e-10) << shape.frames << " " << shape.points;
                ++checked;
            }
        }
    }
    EXPECT_EQ(checked, 8 * 3 * 4);
}

TEST(NormalEquations, AnObjectsFramesCoupleToPointsWithFourColumnsAndGiveTheSolutionOfTheWholeSystem) {
    int checked = 0;
    for (const Shape& shape :
         {Shape{1, 1, true, 1.0, Coupling::kPlanar}, Shape{2, 5, true, 0.6, Coupling::kPlanar},
          Shape{10, 40, true, 0.6, Coupling::kPlanar}, Shape{kSolverFrames, 41, true, 1.0, Coupling::kPlanar},
          Shape{kSolverFrames, 1, true, 0.6, Coupling::kPlanar}, Shape{4, 30, false, 0.6, Coupling::kPlanar}}) {
        for (const double lambda : {0.0, 1e-4, 1.0}) {
            for (std::uint32_t seed = 1; seed <= 4; ++seed) {
                RandomProblem problem(shape, seed);
                // Seen once by three random rows, a point can be so close to singular that rounding is all that
                // differs.
                for (int p = 0; p < shape.points; ++p) {
                    problem.add_observation(p % shape.frames, p);
                    problem.add_observation((p + 1) % shape.frames, p);
                }
                auto step = std::make_unique<SolverStep>();
                ASSERT_EQ(problem.system().solve(lambda, *step), Status::kOk);
                const std::vector<long double> x = problem.dense().solve(static_cast<long double>(lambda));
                ASSERT_FALSE(x.empty());
                EXPECT_LT(relative_difference(*step, shape, x), 1e-10) << shape.frames << " " << shape.points;
                Mat6 covariance;
                const int last = shape.frames - 1;
                ASSERT_EQ(problem.system().covariance(last, covariance), Status::kOk);
                const std::vector<long double> column = problem.dense().inverse_column(6 * last + 4);
                for (int r = 0; r < 6; ++r) {
                    const auto truth = static_cast<double>(column[static_cast<std::size_t>(6 * last + r)]);
                    EXPECT_NEAR(covariance(r, 4), truth, 1e-9 * (1.0 + std::fabs(truth)));
                }
                ++checked;
            }
        }
    }
    EXPECT_EQ(checked, 6 * 3 * 4);
}

TEST(NormalEquations, FullCapacityIsSolvedAsWell) {
    int checked = 0;
    for (const Shape& shape : {Shape{kPoseFrames, kSolverPoints, true, 0.3},
                               Shape{kSolverFrames, kMaxObjectFeatures, true, 1.0, Coupling::kPlanar}}) {
        RandomProblem problem(shape, 7);
        for (int p = 0; p < shape.points; ++p) {
            problem.add_observation(p % shape.frames, p);
        }
        auto step = std::make_unique<SolverStep>();
        ASSERT_EQ(problem.system().solve(1e-4, *step), Status::kOk);
        EXPECT_LT(static_cast<double>(problem.dense().residual(1e-4L, flat(*step, shape))), 1e-10);
        ++checked;
    }
    EXPECT_EQ(checked, 2);
}

TEST(NormalEquations, ASystemThatIsClearedForAnotherShapeForgetsTheFormer) {
    const Shape pose{kPoseFrames, 30, false, 0.7};
    const Shape planar{4, 20, true, 0.5, Coupling::kPlanar};
    RandomProblem fresh(planar, 9);
    RandomProblem used(pose, 8);
    auto step_fresh = std::make_unique<SolverStep>();
    auto step_used = std::make_unique<SolverStep>();
    (void)used.system().solve(1e-3, *step_used);
    RandomProblem refilled(planar, 9, used);
    ASSERT_EQ(fresh.system().solve(1e-3, *step_fresh), Status::kOk);
    ASSERT_EQ(refilled.system().solve(1e-3, *step_used), Status::kOk);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(step_fresh->frame[i], step_used->frame[i]);
    }
    EXPECT_EQ(step_fresh->point[19], step_used->point[19]);
}

TEST(NormalEquations, APointThatNobodySawKeepsItsPlaceAndChangesNothing) {
    const Shape with{3, 4, false, 0.0};
    const Shape without{3, 3, false, 0.0};
    RandomProblem a(with, 3);
    RandomProblem b(without, 3);
    for (int k = 0; k < 9; ++k) {
        a.add_observation(k % 3, k / 3);
        b.add_observation(k % 3, k / 3);
    }
    auto step_a = std::make_unique<SolverStep>();
    auto step_b = std::make_unique<SolverStep>();
    step_a->point[3] = Vec3(9.0, 9.0, 9.0);
    ASSERT_EQ(a.system().solve(1e-3, *step_a), Status::kOk);
    ASSERT_EQ(b.system().solve(1e-3, *step_b), Status::kOk);
    EXPECT_EQ(step_a->point[3], Vec3(Vec3::Zero()));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(step_a->frame[i], step_b->frame[i]);
        EXPECT_EQ(step_a->point[i], step_b->point[i]);
    }
}

TEST(NormalEquations, APointSeenOnceByOneCameraDoesNotHoldItsFrame) {
    // Two rows (u, v) for six unknowns of a frame that has a weak prior, and three of a point: the point absorbs them.
    const std::unique_ptr<NormalEquations> owner = std::make_unique<NormalEquations>();
    NormalEquations& system = *owner;
    system.clear(1, 1, false);
    const Mat6 prior = 4.0 * Mat6::Identity();
    system.add_frame(0, prior, Vec6::Zero());
    Mat3x6 Jf = Mat3x6::Zero();
    Jf(0, 0) = 500.0;
    Jf(1, 1) = 500.0;
    Mat3 Jp = Mat3::Zero();
    Jp(0, 0) = 500.0;
    Jp(0, 2) = 20.0;
    Jp(1, 1) = 500.0;
    Jp(1, 2) = -30.0;
    system.add_frame(0, Jf.transpose() * Jf, Vec6::Zero());
    system.add_point(0, Jp.transpose() * Jp, Vec3::Zero());
    system.add_frame_point(0, 0, Jf.transpose() * Jp);
    Mat6 covariance;
    ASSERT_EQ(system.covariance(0, covariance), Status::kOk);
    for (int r = 0; r < 6; ++r) {
        EXPECT_NEAR(covariance(r, r), 0.25, 0.01) << r;
    }
}

TEST(NormalEquations, CovarianceIsTheBlockOfTheDenseInverse) {
    for (const bool shared : {false, true}) {
        const Shape shape{4, 25, shared, 0.8};
        RandomProblem problem(shape, 11);
        for (int p = 0; p < shape.points; ++p) {
            problem.add_observation(p % shape.frames, p);
        }
        for (int i = 0; i < shape.frames; ++i) {
            Mat6 covariance;
            ASSERT_EQ(problem.system().covariance(i, covariance), Status::kOk);
            for (int c = 0; c < 6; ++c) {
                const std::vector<long double> x = problem.dense().inverse_column(6 * i + c);
                for (int r = 0; r < 6; ++r) {
                    EXPECT_NEAR(covariance(r, c), static_cast<double>(x[static_cast<std::size_t>(6 * i + r)]), 1e-10);
                }
            }
        }
        Mat3 size_covariance;
        ASSERT_EQ(problem.system().shared_covariance(size_covariance), shared ? Status::kOk : Status::kNotObservable);
        for (int c = 0; shared && c < 3; ++c) {
            const std::vector<long double> x = problem.dense().inverse_column(problem.at_shared() + c);
            for (int r = 0; r < 3; ++r) {
                EXPECT_NEAR(size_covariance(r, c),
                            static_cast<double>(x[static_cast<std::size_t>(problem.at_shared() + r)]), 1e-10);
            }
        }
    }
}

TEST(NormalEquations, CovarianceAfterADampedSolveIsTheUndampedOne) {
    const Shape shape{3, 10, false, 1.0};
    RandomProblem a(shape, 5);
    RandomProblem b(shape, 5);
    auto step = std::make_unique<SolverStep>();
    Mat6 first;
    Mat6 again;
    ASSERT_EQ(a.system().covariance(1, first), Status::kOk);
    ASSERT_EQ(b.system().covariance(0, again), Status::kOk);
    ASSERT_EQ(b.system().solve(10.0, *step), Status::kOk);
    ASSERT_EQ(b.system().covariance(1, again), Status::kOk);
    EXPECT_EQ(first, again);
}

TEST(NormalEquations, AMatrixThatIsNotPositiveDefiniteIsNotObservableAndLeavesTheStep) {
    const std::unique_ptr<NormalEquations> owner = std::make_unique<NormalEquations>();
    NormalEquations& system = *owner;
    auto step = std::make_unique<SolverStep>();
    step->frame[0] = Vec6::Constant(3.0);
    system.clear(1, 0, false);
    Mat6 H = Mat6::Identity();
    H(0, 1) = H(1, 0) = 2.0;
    system.add_frame(0, H, Vec6::Ones());
    EXPECT_EQ(system.solve(0.0, *step), Status::kNotObservable);
    EXPECT_EQ(step->frame[0], Vec6(Vec6::Constant(3.0)));
    Mat6 covariance;
    EXPECT_EQ(system.covariance(0, covariance), Status::kNotObservable);
    EXPECT_EQ(system.solve(2.0, *step), Status::kOk) << "enough damping makes it positive definite";
}

TEST(NormalEquations, AnEmptySystemOfFramesIsNotObservable) {
    const auto system = std::make_unique<NormalEquations>();
    auto step = std::make_unique<SolverStep>();
    system->clear(2, 3, true);
    EXPECT_EQ(system->solve(1e-4, *step), Status::kNotObservable);
}

TEST(NormalEquations, NumbersThatAreNotFiniteAreNotObservableAndLeaveTheStep) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    for (const double bad : {kNan, kInfinite}) {
        const auto system = std::make_unique<NormalEquations>();
        auto step = std::make_unique<SolverStep>();
        system->clear(1, 0, false);
        system->add_frame(0, Mat6::Identity(), Vec6::Constant(bad));
        EXPECT_EQ(system->solve(0.0, *step), Status::kNotObservable);
        EXPECT_EQ(step->frame[0], Vec6(Vec6::Zero()));
        system->clear(1, 0, false);
        system->add_frame(0, bad * Mat6::Identity(), Vec6::Ones());
        EXPECT_EQ(system->solve(0.0, *step), Status::kNotObservable);
    }
}

}  // namespace
}  // namespace semtrack
