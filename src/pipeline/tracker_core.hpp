// The inside of Tracker: all state, and the stages in the order of the paper's Fig. 2.
#ifndef SEMTRACK_PIPELINE_TRACKER_CORE_HPP
#define SEMTRACK_PIPELINE_TRACKER_CORE_HPP

#include <array>
#include <cstdint>

#include "estimate/ego/ego_estimator.hpp"
#include "estimate/ground/ground_estimator.hpp"
#include "estimate/ground/road_shape.hpp"
#include "front/associate/associate.hpp"
#include "front/box/infer_box.hpp"
#include "front/mask/owner_mask_builder.hpp"
#include "front/match/chosen_matcher.hpp"
#include "front/match/external_features.hpp"
#include "front/ransac/reject.hpp"
#include "pipeline/level.hpp"
#include "pipeline/object_team.hpp"
#include "semtrack/tracker.hpp"
#include "track/track_table.hpp"

namespace semtrack {

/// A track as it stood at one frame, ready to be compared with that frame's detections.
struct TrackAtFrame {
    int slot{0};
    int index{0};  ///< of the frame in the track's window
};

inline constexpr int kYoungHits = 4;  ///< until then a track's motion is not known: its last 2D box predicts best

class TrackerCore {
public:
    Status init(const Config& config, const Calibration& calibration, FeatureExtractor* extractor,
                StageObserver* observer, const ObjectTeam& team);
    Status process(const Input& input, Output& output);

private:
    friend class TrackerMemory;  // says how large the members are
    friend class StageProbe;  // of the SIL: reads what a stage left, to compare two targets stage by stage

    // tracker_core.cpp
    [[nodiscard]] bool acceptable(const Input& input) const;
    [[nodiscard]] Pose given_pose(const Input& input) const;
    [[nodiscard]] Pose predict_ego(const Input& input) const;
    void run_ego(const Input& input);  // stage 7
    void count_health(const Input& input);
    void build_output(Output& output);
    void describe_points(Output& output) const;
    void begin(Stage stage) {
        if (observer_ != nullptr) {
            observer_->begin(stage);
        }
    }
    void end(Stage stage) {
        if (observer_ != nullptr) {
            observer_->end(stage);
        }
    }

    // tracker_detections.cpp: stages 1 and 2
    void predict_tracks();
    void refresh_poses(Track& track) const;
    void take_lists(const Input& input);
    void take_list(const DetectionList& list, std::uint32_t frame);
    void attach(Track& track, int index, const DetectionList& list, int item, std::uint32_t frame);
    void start_track(const DetectionList& list, int item, std::uint32_t frame);
    void fill_window(ObjectWindow& window, const ObjectState& first, std::int64_t first_us, std::uint32_t first_frame);
    void learn_ground(const Track& track, int slot, int index);
    void watch_heading(Track& track, int index, const Detection& detection);
    [[nodiscard]] bool infer(const Detection& detection, const Pose& T_c_l, const Vec3& size_m, const double* theta,
                             ObjectState& x) const;
    [[nodiscard]] Box2d expected_box(const Track& track, int index) const;
    // tracker_association.cpp
    [[nodiscard]] std::array<double, 4> edge_tolerance(const Track& track, int index, const Box2d& expected) const;
    void widen_hidden_edges();
    [[nodiscard]] bool is_repeat(int item) const;
    [[nodiscard]] bool frame_of(std::int64_t time_us, std::uint32_t& frame, Pose& T_w_c) const;

    // tracker_features.cpp: stages 3 to 6
    void build_masks();
    void add_mask_items(const Track& track, int slot);
    void set_priors();
    void match(const Input& input);
    void reject();
    void drop_feature(int owner, int slot);

    // tracker_road.cpp: the road for ground contact
    void place_vehicle();
    void collect_road(const FeatureMeasurement& m);
    void learn_road();

    // tracker_objects.cpp: stages 8 to 10
    void feed_features();
    void share_solver();
    void solve_objects();
    void align_objects();
    void update_lifecycle();

    Config config_{};
    Calibration calibration_{};
    StageObserver* observer_{nullptr};
    bool ready_{false};
    bool started_{false};
    bool features_usable_{false};        // this frame's image, or its features from outside, were matched
    bool features_given_{false};         // from outside
    std::uint32_t frame_{0};             // number of the current frame, from 1
    std::uint32_t last_image_frame_{0};  // the matcher's last frame
    std::int64_t time_us_{0};
    Pose T_v_c_{};
    Vec3 t_d_c_{Vec3::Zero()};
    Pose T_w_c_{};  // of the current frame: predicted until stage 7, then estimated

    LocalLevel level_{};
    EgoEstimator ego_{};
    EgoResult ego_result_{};
    GroundEstimator ground_{};
    RoadPoints road_points_{};  // that may be road, for the plane
    RoadPoints lane_points_{};  // ahead, whatever they lie on, for its shape
    RoadShape road_shape_{};
    TrackTable tracks_{};
    ChosenMatcher matcher_{};
    ExternalMatcher external_{};  // in its place while Input::features comes
    OwnerMaskBuilder mask_builder_{};
    OwnerMask mask_left_{};
    OwnerMask mask_right_{};
    OwnerPriors priors_{};
    FrameFeatures features_{};
    OutlierRejection rejection_{};
    ObjectFrame new_frame_{};
    DetectionList usable_{};
    StaticVector<Box2d, kMaxDetections> unplaced_{};  // of the newest list: too much outside the image to start a track
    StaticVector<TrackAtFrame, kMaxObjects> candidates_{};
    TrackBoxes boxes_{};
    Associator associator_{};
    Assignment assignment_{};
    MaskItems mask_items_left_{};
    MaskItems mask_items_right_{};
    MaskResults mask_results_{};
    SolveShares shares_{};
    ObjectTeam team_{};
    ObjectWorker worker_{};  // the first one; its solver serves the ego-motion too
    std::array<ObjectSolveReport, kMaxObjects> solve_reports_{};
    Health health_{};
};

}  // namespace semtrack

#endif
