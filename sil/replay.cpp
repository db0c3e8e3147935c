#include "sil/replay.hpp"

#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>

#ifdef SEMTRACK_HAS_OPENCV
#include "hal/opencv/opencv_extractor.hpp"
#endif
#include "semtrack/cycle.hpp"
#include "sil/can_output.hpp"
#include "sil/evaluation.hpp"
#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/vehicle_motion_file.hpp"
#include "sil/object_workers.hpp"
#include "sil/open_drive.hpp"
#include "sil/report/picture_writer.hpp"
#include "sil/report/progress.hpp"
#include "sil/report/summary.hpp"
#include "sil/report/writers.hpp"
#include "sil/result_folder.hpp"
#include "sil/simulate/feature_simulator.hpp"
#include "sil/sources.hpp"
#include "sil/stage_trace.hpp"

namespace semtrack::sil {

namespace {

// What the bus gets for a list before the next frame, and for the last one: classic CAN takes 29 ms for 16 objects.
constexpr int kBetweenCycles_ms = 60;
constexpr int kLastList_ms = 150;

volatile std::sig_atomic_t g_stop = 0;

extern "C" void stop_on_signal(int) {
    g_stop = 1;
}

struct Range {
    int first{0};
    int last{0};
};

Range range_of(const ReplayOptions& o, const Sequence& sequence) {
    const Range all{sequence.first_frame(), sequence.last_frame()};
    const Range wanted{o.first.value_or(all.first), o.last.value_or(all.last)};
    const std::string have =
        " (the drive has frames " + std::to_string(all.first) + " to " + std::to_string(all.last) + ")";
    if (wanted.first < all.first || wanted.first > all.last) {
        throw InputError("--first " + std::to_string(wanted.first) + ": no such frame" + have);
    }
    if (wanted.last < all.first || wanted.last > all.last) {
        throw InputError("--last " + std::to_string(wanted.last) + ": no such frame" + have);
    }
    if (wanted.first > wanted.last) {
        throw InputError("--first " + std::to_string(wanted.first) + " is greater than --last " +
                         std::to_string(wanted.last) + have);
    }
    return wanted;
}

/// Everything that is read before the first frame.
struct Drive {
    std::unique_ptr<Sequence> sequence;
    DriveCameras cameras;  ///< with the mount
    Range range;
    Detections detections;
};

Drive open(const ReplayOptions& o) {
    Drive d;
    d.sequence = open_drive(o.drive);
    d.cameras = d.sequence->cameras();
    if (!o.mount.empty()) {
        d.cameras.calibration.T_v_c = read_mount(o.mount);
    }
    d.range = range_of(o, *d.sequence);
    if (o.detections == "labels") {
        d.detections.by_frame = d.sequence->label_detections();
        if (d.detections.by_frame.empty()) {
            throw InputError("--detections labels: " + o.drive.sequence + " has no labels");
        }
    } else if (o.detections != "none") {
        d.detections = read_detections(o.detections, d.cameras.calibration.width, d.cameras.calibration.height);
    }
    return d;
}

std::map<std::int64_t, VehicleMotion> vehicle_motion_rows(const ReplayOptions& o, const Sequence& sequence) {
    if (o.vehicle_motion != "simulated") {
        return read_vehicle_motion(o.vehicle_motion);
    }
    std::map<std::int64_t, VehicleMotion> rows = sequence.simulated_vehicle_motion();
    if (rows.empty()) {
        throw InputError("--vehicle-motion simulated: only the layout world has simulated sensors");
    }
    return rows;
}

SequenceStereoSource::Settings stereo_settings(const ReplayOptions& o, const Range& range) {
    SequenceStereoSource::Settings s;
    s.first = range.first;
    s.last = range.last;
    s.images = o.drive.images;
    s.ahead = o.drive.layout != "world";
    s.realtime = o.realtime;
    return s;
}

class Run {
public:
    Run(const ReplayOptions& options, Drive& drive, const DriveTruth& truth, const std::filesystem::path& dir)
        : options_(options),
          drive_(drive),
          writers_(dir, drive.cameras, options.can.dialect, options.points),
          can_(writers_.can_log(), options.can_interface, options.can.dialect),
          trace_(timer_),
          stereo_(*drive.sequence, stereo_settings(options, drive.range), timer_),
          detections_(*drive.sequence, drive.detections.by_frame, drive.range.first, drive.range.last,
                      options.detection_delay),
          workers_(options.workers),
          tracker_(std::make_unique<Tracker>()),
          cycle_(std::make_unique<Cycle>()),
          output_(std::make_unique<Output>()),
          stereo_checks_(drive.cameras.calibration, drive.cameras.t_c0_c, truth.ego, truth.objects) {
        if (!options.drive.ego.empty()) {
            ego_.emplace(*drive.sequence, read_given_poses(options.drive), drive.cameras.calibration.T_v_c,
                         drive.range.first, drive.range.last, options.drive.ego.string());
        }
        if (!options.vehicle_motion.empty()) {
            motion_.emplace(vehicle_motion_rows(options, *drive.sequence));
        }
        if (options.simulated_features) {
            simulator_.emplace(*drive.sequence, read_given_poses(options.drive), drive.range.first, drive.range.last,
                               options.feature_noise_px);
        }
        if (options.pictures) {
            pictures_.emplace(dir, drive.cameras.calibration, *drive.sequence);
        }
#ifdef SEMTRACK_HAS_OPENCV
        if (options.opencv_extractor) {
            extractor_.emplace();
        }
        FeatureExtractor* const extractor = extractor_ ? &*extractor_ : nullptr;
#else
        FeatureExtractor* const extractor = nullptr;
#endif
        if (options.stages) {
            trace_.watch(*tracker_);
            stages_.emplace(dir / "stages.csv");
            stages_->write(StageTrace::header());
        }
        if (tracker_->init(options.config, drive.cameras.calibration, extractor, &trace_, workers_.parallel()) !=
            Status::kOk) {
            throw InputError(options.drive.sequence + ": the tracker refuses the calibration or the image size");
        }
        CyclePorts ports;
        ports.stereo = &stereo_;
        ports.detections = options.detections == "none" ? nullptr : &detections_;
        ports.motion = motion_ ? &*motion_ : nullptr;
        ports.ego = ego_ ? &*ego_ : nullptr;
        ports.features = simulator_ ? &*simulator_ : nullptr;
        ports.can = &can_;
        ports.observer = &timer_;
        cycle_->init(ports, options.can);
    }

    void all_frames() {
        const int total = drive_.range.last - drive_.range.first + 1;
        Progress progress(options_.progress, total);
        while (one_frame()) {
            progress.show(stereo_.frame() - drive_.range.first + 1, stereo_.frame());
        }
        if (pictures_) {
            pictures_->finish();
        }
        can_.service(kLastList_ms);
        if (can_.failed()) {
            throw std::runtime_error("can.log: cannot be written");
        }
        writers_.close();
        if (stages_) {
            stages_->close();
        }
    }

    [[nodiscard]] RunCounts counts() const {
        const Health& h = output_->health;
        const bool images = options_.drive.images;
        RunCounts out = {{"frames_dropped", images ? h.frames_dropped : 0},
                         {"frames_without_right", images ? h.frames_without_right : 0},
                         {"detection_lists", detections_.lists_handed_over()},
                         {"detection_lists_late", h.lists_late},
                         {"detection_lists_too_late", h.lists_too_late},
                         {"detections_dropped_reading", drive_.detections.dropped},
                         {"detections_of_no_frame", drive_.detections.bad_frames},
                         {"detections_dropped", h.detections_dropped},
                         {"tracks_dropped", h.tracks_dropped},
                         {"features_rejected", h.features_rejected},
                         {"solver_failures", h.solver_failures}};
        out.emplace_back("frames_road_not_plane", frames_road_not_plane_);
        if (motion_) {
            out.emplace_back("vehicle_motions", motion_->handed_over());
        }
        for (const auto& count : can_.counts(cycle_->counters())) {
            out.push_back(count);
        }
        return out;
    }
    [[nodiscard]] FeatureStatistics features() const {
        return features_.statistics();
    }
    [[nodiscard]] StereoScores stereo_scores() const {
        return stereo_checks_.scores();
    }
    [[nodiscard]] std::string complaint() const {
        return can_.complaint();
    }
    [[nodiscard]] const std::vector<double>& total_us() const {
        return total_us_;
    }

private:
    bool one_frame() {
        if (g_stop != 0) {
            throw std::runtime_error("stopped by a signal");
        }
        const std::string where = "frame " + std::to_string(stereo_.frame() + 1);
        switch (cycle_->step(*tracker_, *output_)) {
            case CycleResult::kProcessed:
                break;
            case CycleResult::kEnd:
                return false;
            case CycleResult::kSourceError:
                stereo_.rethrow();
                throw std::runtime_error(where + ": a source failed");
            case CycleResult::kNoFrame:
            case CycleResult::kRefused:
                throw std::runtime_error(where + ": the tracker refused its input");
        }
        can_.service(kBetweenCycles_ms);
        writers_.add(stereo_.frame(), *output_, cycle_->encoder().list_counter(), timer_.timing());
        if (stages_) {
            stages_->write(trace_.take(stereo_.frame()));
        }
        features_.add(*output_);
        stereo_checks_.add(stereo_.frame(), *output_);
        total_us_.push_back(timer_.timing().total_us);
        frames_road_not_plane_ += output_->health.road_not_plane ? 1 : 0;
        if (pictures_) {
            pictures_->add(stereo_.frame(), stereo_.left(), *output_);
        }
        return true;
    }

    const ReplayOptions& options_;
    Drive& drive_;
    StageTimer timer_;
    ResultWriters writers_;
    CanOutput can_;
    StageTrace trace_;
    std::optional<TextOutput> stages_;
    SequenceStereoSource stereo_;
    DelayedDetectionSource detections_;
    std::optional<VehicleMotionRows> motion_;
    std::optional<GivenPoseSource> ego_;
    std::optional<FeatureSimulator> simulator_;
    std::optional<PictureWriter> pictures_;
#ifdef SEMTRACK_HAS_OPENCV
    std::optional<OpenCvExtractor> extractor_;
#endif
    ObjectWorkers workers_;
    std::unique_ptr<Tracker> tracker_;
    std::unique_ptr<Cycle> cycle_;
    std::unique_ptr<Output> output_;
    std::vector<double> total_us_;
    std::int64_t frames_road_not_plane_{0};
    FeatureCounter features_;
    StereoChecker stereo_checks_;
};

}  // namespace

void run_replay(const ReplayOptions& options) {
    Drive drive = open(options);
    const DriveTruth truth = truth_of(*drive.sequence);
    ResultFolder folder(options.out);
    (void)std::signal(SIGINT, stop_on_signal);
    (void)std::signal(SIGTERM, stop_on_signal);
    Metrics metrics;
    std::vector<double> total_us;
    std::string complaint;
    {
        Run run(options, drive, truth, folder.work());
        run.all_frames();
        metrics = evaluate_results(folder.work(), truth, options.drive.others);
        metrics.run = run.counts();
        metrics.features = run.features();
        metrics.stereo = run.stereo_scores();
        total_us = run.total_us();
        complaint = run.complaint();
    }
    write_file(folder.work() / "metrics.json", to_json(metrics));
    folder.commit();
    (void)std::fputs(
        summary_text(options.drive.layout + " " + options.drive.sequence, metrics, total_us, options.out.string())
            .c_str(),
        stdout);
    if (!complaint.empty()) {
        (void)std::fprintf(stderr, "semtrack-sil: %s\n", complaint.c_str());
    }
}

}  // namespace semtrack::sil
