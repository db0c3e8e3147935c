// The rendered street as a drive for the replay (layout `world`): no files, exact truth.
#ifndef SEMTRACK_SIL_WORLD_WORLD_SEQUENCE_HPP
#define SEMTRACK_SIL_WORLD_WORLD_SEQUENCE_HPP

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sil/sequence.hpp"
#include "sil/world/detector.hpp"
#include "sil/world/truth.hpp"
#include "sil/world/vehicle_motion.hpp"

namespace semtrack::sil {

struct WorldOptions {
    int frames{0};      ///< 0: the scenario's own number; more: everything drives on
    bool ideal{false};  ///< detections without a detector's errors
    int threads{2};     ///< 1 or 2; the bytes do not depend on it
};

[[nodiscard]] std::vector<std::string> scenario_names();

/// Frames 0..n-1, 100000 us apart, from 0. Camera 0 is the processed left camera, so no shift between cameras.
/// Truth of every frame is there (labelled_frames is complete); frames whose images were dropped have labels and no
/// detections. The first call of labels(), label_detections() or object_truth() traces all frames (about 25 ms each).
class WorldSequence : public Sequence {
public:
    /// Throws InputError for an unknown scenario or a negative number of frames.
    explicit WorldSequence(const std::string& scenario, const WorldOptions& options = {});

    [[nodiscard]] const DriveCameras& cameras() const override { return cameras_; }
    [[nodiscard]] int first_frame() const override { return 0; }
    [[nodiscard]] int last_frame() const override { return scene_.frames() - 1; }
    [[nodiscard]] std::int64_t time_us(int frame) const override { return frame * world::kFrame_us; }
    void load(int frame, GreyImage& left, GreyImage& right) override { render(frame, left, right); }
    [[nodiscard]] const std::vector<Label>& labels() const override;
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return frames_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return ego_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override;

    [[nodiscard]] std::map<std::int64_t, VehicleMotion> simulated_vehicle_motion() const override {
        return world::vehicle_motion(scene_);
    }

    /// As load, for const sequences. Throws InputError for a frame that is not there.
    void render(int frame, GreyImage& left, GreyImage& right) const;
    /// Speed and yaw rate of every road user in every frame, seen or not.
    [[nodiscard]] const std::vector<world::ObjectTruth>& object_truth() const;
    [[nodiscard]] const world::Scene& scene() const { return scene_; }
    [[nodiscard]] const std::string& name() const { return scene_.scenario().name; }

private:
    struct Seen;
    const Seen& seen() const;

    WorldOptions options_;
    world::Scene scene_;
    DriveCameras cameras_{};
    std::vector<int> frames_{};
    std::map<int, RigidTransform> ego_{};
    mutable std::shared_ptr<const Seen> seen_{};
};

}  // namespace semtrack::sil

#endif
