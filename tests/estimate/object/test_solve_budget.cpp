// The objects' solves of a frame spend a bounded amount of work, and everybody's turn comes.
#include <gtest/gtest.h>

#include "estimate/object/solve_budget.hpp"

namespace semtrack {
namespace {

constexpr int kFull = kObjectWindow * (kMaxObjectFeatures + 48);
constexpr int kMostWork = 229000;

SolveWork work_of(int objects, int each) {
    SolveWork work{};
    for (int s = 0; s < objects; ++s) {
        work[static_cast<std::size_t>(s)] = each;
    }
    return work;
}

/// Iterations of all solves, trials and covariance included, in units of work.
int spent(const SolveWork& work, const SolveShares& shares) {
    int sum = 0;
    for (std::size_t s = 0; s < work.size(); ++s) {
        sum += work[s] * (1 + shares[s].iterations * (shares[s].trials ? 3 : 1));
    }
    return sum;
}

TEST(SolveBudget, CutsNothingForSixFullObjectsOrTwelveOrdinaryOnes) {
    SolveShares shares{};
    for (const SolveWork& work : {work_of(6, kFull), work_of(12, kObjectWindow * (48 + 48)), work_of(0, 0)}) {
        EXPECT_EQ(share_out(work, 5, shares), 0);
        for (const SolveShare& share : shares) {
            EXPECT_EQ(share.iterations, kObjectIterations);
            EXPECT_TRUE(share.trials);
        }
    }
}

TEST(SolveBudget, HoldsWhateverTheNumberOfFullObjects) {
    for (int objects = 1; objects <= kMaxObjects; ++objects) {
        const SolveWork work = work_of(objects, kFull);
        SolveShares shares{};
        const int cut = share_out(work, 3, shares);
        EXPECT_LE(spent(work, shares), kMostWork) << objects << " objects";
        EXPECT_GE(shares[0].iterations, kLeastObjectIterations);
        EXPECT_EQ(cut == 0, spent(work, shares) == (1 + 3 * kObjectIterations) * kFull * objects)
            << objects << " objects";
    }
}

TEST(SolveBudget, LetsEveryObjectTryWithinSixteenFramesAtFullLoad) {
    const SolveWork work = work_of(kMaxObjects, kFull);
    std::array<int, static_cast<std::size_t>(kMaxObjects)> tried{};
    for (std::uint32_t frame = 100; frame < 116U; ++frame) {
        SolveShares shares{};
        EXPECT_EQ(share_out(work, frame, shares), kMaxObjects);
        for (std::size_t s = 0; s < shares.size(); ++s) {
            tried[s] += shares[s].trials ? 1 : 0;
        }
    }
    for (const int n : tried) {
        EXPECT_GE(n, 1);
    }
}

}  // namespace
}  // namespace semtrack
