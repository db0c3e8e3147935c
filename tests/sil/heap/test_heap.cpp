// No stage of the core allocates: counted over whole cycles on the rendered street, objects and CAN included.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "semtrack/cycle.hpp"
#include "sil/heap/counting_malloc.hpp"
#include "sil/world/world_sequence.hpp"

namespace semtrack {
namespace {

constexpr int kFrames = 30;

/// Images and lists that are ready before the counting starts.
class ReadyDrive final : public StereoSource, public DetectionSource, public CanTx {
public:
    ReadyDrive() : world_("street", {kFrames, false, 2}) {
        for (int f = 0; f < kFrames; ++f) {
            world_.render(f, left_[static_cast<std::size_t>(f)], right_[static_cast<std::size_t>(f)]);
        }
        lists_ = &world_.label_detections();
    }
    void rewind() {
        frame_ = -1;
        sent_ = 0;
    }
    [[nodiscard]] const Calibration& calibration() const { return world_.cameras().calibration; }

    [[nodiscard]] SourceResult next(StereoFrame& frame) noexcept override {
        if (frame_ + 1 == kFrames) {
            return SourceResult::kEnd;
        }
        ++frame_;
        const auto f = static_cast<std::size_t>(frame_);
        frame.time_us = world_.time_us(frame_);
        // One frame without its right image, one without images.
        frame.left = frame_ == 6 ? ImageView{} : left_[f].view();
        frame.right = frame_ >= 5 && frame_ <= 6 ? ImageView{} : right_[f].view();
        return SourceResult::kOk;
    }
    [[nodiscard]] SourceResult poll(std::int64_t now_us,
                                    StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept override {
        DetectionList list;
        list.time_us = now_us;
        for (const Detection& d : lists_->at(frame_)) {
            (void)list.items.try_push_back(d);
        }
        (void)lists.try_push_back(list);
        return SourceResult::kOk;
    }
    [[nodiscard]] Result send(const CanFrame& /*frame*/, std::int64_t /*time_us*/) noexcept override {
        ++sent_;
        return Result::kSent;
    }
    [[nodiscard]] int sent() const { return sent_; }

private:
    sil::WorldSequence world_;
    std::array<sil::GreyImage, kFrames> left_;
    std::array<sil::GreyImage, kFrames> right_;
    const std::map<int, std::vector<Detection>>* lists_{nullptr};
    int frame_{-1};
    int sent_{0};
};

struct Seen {
    long allocations{0};
    int objects{0};
    int points{0};
    std::uint32_t frames_dropped{0};
};

Seen run(ReadyDrive& drive, MatcherKind matcher) {
    drive.rewind();
    const auto tracker = std::make_unique<Tracker>();
    const auto cycle = std::make_unique<Cycle>();
    const auto output = std::make_unique<Output>();
    CyclePorts ports;
    ports.stereo = &drive;
    ports.detections = &drive;
    ports.can = &drive;
    Config config;
    config.matcher = matcher;
    Seen seen;
    {
        const AllocationCounter counter;
        EXPECT_EQ(tracker->init(config, drive.calibration()), Status::kOk);
        cycle->init(ports, CanConfig{});
        while (cycle->step(*tracker, *output) == CycleResult::kProcessed) {
            seen.objects = output->objects.size() > seen.objects ? output->objects.size() : seen.objects;
            seen.points = output->points.size() > seen.points ? output->points.size() : seen.points;
        }
        seen.allocations = counter.count();
    }
    seen.frames_dropped = output->health.frames_dropped;
    return seen;
}

TEST(Heap, IsNotTouchedByInitNorByAnyCycleOfAWholeDriveWithEitherMatcher) {
    ReadyDrive drive;
    for (const MatcherKind matcher : {MatcherKind::kPatch, MatcherKind::kOrb}) {
        const Seen seen = run(drive, matcher);
        EXPECT_EQ(seen.allocations, 0);
        EXPECT_GE(seen.objects, 5) << "the run shows nothing";
        EXPECT_GE(seen.points, 300) << "the run shows nothing";
        EXPECT_GT(drive.sent(), kFrames);
        EXPECT_EQ(seen.frames_dropped, 1U);
    }
}

// Positive control: the counter sees each way to allocate. Through volatile: compilers delete free(malloc(1)).
TEST(HeapCounter, SeesEveryKindOfAllocation) {
    const AllocationCounter counter;
    void* volatile p = std::malloc(1);
    EXPECT_EQ(counter.count(), 1);
    p = std::realloc(p, 100);
    EXPECT_EQ(counter.count(), 2);
    std::free(p);
    p = std::calloc(2, 2);
    EXPECT_EQ(counter.count(), 3);
    std::free(p);
    p = ::operator new(16);
    EXPECT_EQ(counter.count(), 4);
    ::operator delete(p);
    p = ::operator new (64, std::align_val_t{64});
    EXPECT_EQ(counter.count(), 5);
    ::operator delete (p, std::align_val_t{64});
    ASSERT_EQ(::posix_memalign(const_cast<void**>(&p), 64, 64), 0);
    EXPECT_EQ(counter.count(), 6);
    std::free(p);
    p = ::mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    EXPECT_EQ(counter.count(), 7);
    ASSERT_NE(p, MAP_FAILED);
    EXPECT_EQ(::munmap(p, 4096), 0);
}

}  // namespace
}  // namespace semtrack
