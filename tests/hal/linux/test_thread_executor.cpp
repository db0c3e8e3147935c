// Worker threads for objects: each job once, no worker twice at a time, and all of it seen by the caller.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <thread>

#include "hal/linux/thread_executor.hpp"

namespace semtrack::hal::test {
namespace {

constexpr int kJobs = 32;

/// Counts plainly, without atomics: a sanitizer for threads sees every job that overlaps another on its worker.
class CountingJobs final : public Jobs {
public:
    void run(int job, int worker) noexcept override {
        const auto w = static_cast<std::size_t>(worker);
        overlaps += active[w].exchange(true) ? 1 : 0;
        ++runs[static_cast<std::size_t>(job)];
        ++of_worker[w];
        thread[w] = std::this_thread::get_id();
        ++begun;
        for (int ms = 0; begun < wait_for && ms < 20000; ++ms) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        active[w] = false;
    }
    std::array<int, kJobs> runs{};
    std::array<int, kMaxWorkers> of_worker{};
    std::array<std::thread::id, kMaxWorkers> thread{};
    std::array<std::atomic<bool>, kMaxWorkers> active{};
    std::atomic<int> overlaps{0};
    std::atomic<int> begun{0};
    int wait_for{0};  ///< a job ends when so many have begun
};

TEST(ThreadExecutor, RunsEachJobOnceInThousandsOfRoundsOfAnySize) {
    for (const int workers : {1, 2, 4, kMaxWorkers}) {
        ThreadExecutor executor;
        ASSERT_TRUE(executor.start(workers));
        ASSERT_EQ(executor.workers(), workers);
        for (int round = 0; round < 2000; ++round) {
            const int count = round % (kJobs + 1);
            CountingJobs jobs;
            executor.run(jobs, count);
            for (int job = 0; job < kJobs; ++job) {
                ASSERT_EQ(jobs.runs[static_cast<std::size_t>(job)], job < count ? 1 : 0) << "round " << round;
            }
            ASSERT_EQ(jobs.overlaps, 0);
        }
    }
}

TEST(ThreadExecutor, WorksOnAsManyJobsAtOnceAsItHasWorkers) {
    ThreadExecutor executor;
    ASSERT_TRUE(executor.start(4));
    CountingJobs jobs;
    jobs.wait_for = 4;  // only four workers at once get past it
    executor.run(jobs, kJobs);
    std::set<std::thread::id> threads;
    for (int w = 0; w < 4; ++w) {
        EXPECT_GT(jobs.of_worker[static_cast<std::size_t>(w)], 0);
        threads.insert(jobs.thread[static_cast<std::size_t>(w)]);
    }
    EXPECT_EQ(threads.size(), 4U);
    EXPECT_EQ(jobs.thread[0], std::this_thread::get_id());
}

TEST(ThreadExecutor, WithoutThreadsItIsTheCaller) {
    ThreadExecutor executor;
    EXPECT_EQ(executor.workers(), 1);
    CountingJobs jobs;
    executor.run(jobs, kJobs);
    EXPECT_EQ(jobs.of_worker[0], kJobs);
}

TEST(ThreadExecutor, RefusesNumbersThatItDoesNotHaveAndASecondStart) {
    ThreadExecutor executor;
    EXPECT_FALSE(executor.start(0));
    EXPECT_FALSE(executor.start(-1));
    EXPECT_FALSE(executor.start(kMaxWorkers + 1));
    EXPECT_EQ(executor.workers(), 1);
    EXPECT_TRUE(executor.start(2));
    EXPECT_FALSE(executor.start(3));
    EXPECT_EQ(executor.workers(), 2);
}

TEST(ThreadExecutor, EndsItsThreadsWithoutHavingWorked) {
    for (int i = 0; i < 50; ++i) {
        ThreadExecutor executor;
        ASSERT_TRUE(executor.start(kMaxWorkers));
    }
}

}  // namespace
}  // namespace semtrack::hal::test
