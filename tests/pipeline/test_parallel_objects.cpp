// Objects solved by several workers: the same bytes as by one, whatever the order and the threads' own settings.
#include <gtest/gtest.h>

#include <cfenv>
#include <cstring>
#include <memory>
#include <vector>

#include "semtrack/tracker.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

constexpr std::int64_t kFrame_us = 100000;

/// Deals jobs to its workers from the last to the first, each with another rounding, as a thread of the customer's may
/// have it. On one thread: what it shows is that nothing of a result is left in a worker.
class DealingExecutor final : public Executor {
public:
    explicit DealingExecutor(int workers) : workers_(workers) {}
    [[nodiscard]] int workers() const noexcept override { return workers_; }
    void run(Jobs& jobs, int count) noexcept override {
        const int before = std::fegetround();
        (void)std::fesetround(FE_UPWARD);
        for (int job = count - 1; job >= 0; --job) {
            jobs.run(job, (job + round_) % workers_);
        }
        (void)std::fesetround(before);
        ++round_;
        most_ = count > most_ ? count : most_;
    }
    [[nodiscard]] int most() const { return most_; }

private:
    int workers_;
    int round_{0};
    int most_{0};
};

Detection car_at(double x_px, double width_px, double phase) {
    Detection d;
    d.object_class = ObjectClass::kCar;
    d.score = 0.9;
    d.box = {x_px + phase, 150.0 - 0.2 * width_px, x_px + phase + width_px, 150.0 + 0.35 * width_px + 0.1 * phase};
    return d;
}

/// Six cars in a row, approaching: boxes only.
DetectionList cars(int frame) {
    DetectionList list;
    list.time_us = kFrame_us * (frame + 1);
    for (int i = 0; i < 6; ++i) {
        const double grow = 1.0 + 0.02 * frame * (1 + i % 3);
        (void)list.items.try_push_back(car_at(20.0 + 60.0 * i, 40.0 * grow, 0.7 * frame * (i % 2)));
    }
    return list;
}

std::vector<double> run(const ParallelObjects& parallel) {
    std::vector<double> seen;
    const auto tracker = std::make_unique<Tracker>();
    const auto output = std::make_unique<Output>();
    EXPECT_EQ(tracker->init(Config{}, PlaneScene{}.calibration(), nullptr, nullptr, parallel), Status::kOk);
    for (int frame = 0; frame < 20; ++frame) {
        StaticVector<DetectionList, kMaxDetectionLists> lists;
        (void)lists.try_push_back(cars(frame));
        Input input;
        input.time_us = kFrame_us * (frame + 1);
        input.detections = &lists;
        EXPECT_EQ(tracker->process(input, *output), Status::kOk);
        for (const TrackedObject& o : output->objects) {
            for (const double x : {static_cast<double>(o.id), o.position_v[0], o.position_v[1], o.speed, o.yaw_v,
                                   o.size[0], o.sigma_position_v[0], o.sigma_yaw}) {
                seen.push_back(x);
            }
        }
    }
    return seen;
}

TEST(ParallelObjects, GiveTheSameBytesWithOneTwoAndFourWorkers) {
    const std::vector<double> alone = run({});
    ASSERT_GT(alone.size(), 8U * 5U * 10U) << "five cars in half of the frames";
    for (const int workers : {1, 2, 4}) {
        DealingExecutor executor(workers);
        const auto memory = std::make_unique<WorkerMemory[]>(3);
        const std::vector<double> shared = run({&executor, memory.get(), workers - 1});
        EXPECT_GE(executor.most(), 5) << "several jobs in one run";
        ASSERT_EQ(shared.size(), alone.size());
        EXPECT_EQ(std::memcmp(shared.data(), alone.data(), alone.size() * sizeof(double)), 0) << workers << " workers";
    }
}

TEST(ParallelObjects, WithoutMemoryForEveryWorkerTheTrackerRefuses) {
    const auto tracker = std::make_unique<Tracker>();
    const auto memory = std::make_unique<WorkerMemory[]>(kMaxWorkers);
    const auto init = [&](Executor& executor, WorkerMemory* scratch, int count) {
        return tracker->init(Config{}, PlaneScene{}.calibration(), nullptr, nullptr, {&executor, scratch, count});
    };
    DealingExecutor one(1);
    DealingExecutor four(4);
    DealingExecutor none(0);
    DealingExecutor many(kMaxWorkers + 1);
    EXPECT_EQ(init(one, nullptr, 0), Status::kOk);
    EXPECT_EQ(init(four, memory.get(), 3), Status::kOk);
    EXPECT_EQ(init(four, memory.get(), 2), Status::kInvalidArgument);
    EXPECT_EQ(init(four, nullptr, 3), Status::kInvalidArgument);
    EXPECT_EQ(init(four, memory.get(), -1), Status::kInvalidArgument);
    EXPECT_EQ(init(none, memory.get(), 3), Status::kInvalidArgument);
    EXPECT_EQ(init(many, memory.get(), kMaxWorkers), Status::kInvalidArgument);
    const auto output = std::make_unique<Output>();
    Input input;
    input.time_us = kFrame_us;
    EXPECT_EQ(tracker->process(input, *output), Status::kInvalidArgument);
}

}  // namespace
}  // namespace semtrack
