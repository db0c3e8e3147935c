// A scene in memory through the whole cycle, frame by frame: what is counted and timed.
#ifndef SEMTRACK_TESTS_BUDGET_SCENE_RUN_HPP
#define SEMTRACK_TESTS_BUDGET_SCENE_RUN_HPP

#include <cstdint>
#include <utility>
#include <vector>

#include "board/scene_source.hpp"
#include "semtrack/cycle.hpp"

namespace semtrack::budget {

/// How full the capacities are in one frame.
struct Load {
    int objects{0};          ///< published, and measured in this frame
    int background{0};       ///< features of the background after rejection
    int least_on_object{0};  ///< features of the object with the fewest
    int on_objects{0};       ///< of all objects
};

class SceneRun {
public:
    /// observer: told of the stages, encoding included. features: in place of the images' own. Both may be null.
    SceneRun(std::vector<std::uint8_t> scene, const Config& config, StageObserver* observer,
             FeatureSource* features = nullptr)
        : scene_(std::move(scene)), reader_(scene_.data(), scene_.size()), source_(reader_) {
        ready_ = reader_.ok() && tracker_.init(config, reader_.calibration(), nullptr, observer) == Status::kOk;
        CyclePorts ports;
        ports.stereo = &source_;
        ports.detections = &source_;
        ports.can = &bus_;
        ports.features = features;
        ports.observer = observer;
        cycle_.init(ports, CanConfig{});
    }
    SceneRun(const SceneRun&) = delete;
    SceneRun& operator=(const SceneRun&) = delete;

    [[nodiscard]] int frames() const { return ready_ ? reader_.frames() : 0; }
    /// false: there is no further frame.
    [[nodiscard]] bool step() { return ready_ && cycle_.step(tracker_, output_) == CycleResult::kProcessed; }
    [[nodiscard]] const Output& output() const { return output_; }

    [[nodiscard]] Load load() const {
        Load out;
        std::vector<int> of(static_cast<std::size_t>(kMaxOwners), 0);
        for (const SparsePoint& p : output_.points) {
            ++of[p.owner];
        }
        out.background = of[0];
        out.least_on_object = output_.objects.empty() ? 0 : kMaxObjectFeatures;
        for (const TrackedObject& object : output_.objects) {
            const int n = of[static_cast<std::size_t>(object.slot) + 1U];
            out.objects += object.status == TrackStatus::kMeasured ? 1 : 0;
            out.on_objects += n;
            out.least_on_object = n < out.least_on_object ? n : out.least_on_object;
        }
        return out;
    }

private:
    class Bus final : public CanTx {
    public:
        Result send(const CanFrame&, std::int64_t) noexcept override { return Result::kSent; }
    };

    std::vector<std::uint8_t> scene_;
    board::SceneReader reader_;
    board::SceneSource source_;
    Bus bus_{};
    Tracker tracker_{};
    Cycle cycle_{};
    Output output_{};
    bool ready_{false};
};

}  // namespace semtrack::budget

#endif
