#include "sil/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "sil/can_ids.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

constexpr int kLeastImage_px = 64;
constexpr double kLeastHeight_m = 0.1;
constexpr double kMostHeight_m = 10.0;

/// Words as typed; turned into ReplayOptions after parsing.
struct Words {
    std::string cues;
    std::string extractor{"native"};
    std::string matcher{"patch"};
    std::string mask{"on"};
    std::string images{"files"};
    std::string image_size;
    std::string ego{"estimate"};
    std::string features{"images"};
    std::string can_dialect{"fd"};
    double camera_height_m{1.65};
    bool no_progress{false};
};

void add_drive(CLI::App& app, DriveOptions& drive) {
    app.add_option("--layout", drive.layout, "how the drive is stored")
        ->required()
        ->check(CLI::IsMember({"raw", "odometry", "tracking", "world"}));
    app.add_option("--root", drive.root, "folder of the data set (world: none)");
    app.add_option("--sequence", drive.sequence, "drive or sequence; world: scenario")->required();
    app.add_option("--calib", drive.calib, "calibration file in place of the layout's own");
    app.add_option("--detections-camera", drive.detections_camera, "camera of the boxes (0; tracking 2)")
        ->check(CLI::IsMember({0, 2}));
    app.add_option("--other", drive.others, "pose rows of another odometry on the same frames; may be given twice")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_replay(CLI::App& app, ReplayOptions& o, Words& w) {
    add_drive(app, o.drive);
    app.add_option("--first", o.first, "first frame number");
    app.add_option("--last", o.last, "last frame number");
    app.add_option("--detections", o.detections, "FILE, labels or none");
    app.add_option("--detection-delay", o.detection_delay, "frames that a detector's list comes late")
        ->check(CLI::Range(0, kMaxDetectionDelay));
    app.add_option("--cues", w.cues, "letters of S, M, F, P, G (default: all that the input allows)");
    app.add_option("--mask", w.mask, "off: features on objects count as background (to show what masks are worth)")
        ->check(CLI::IsMember({"on", "off"}));
    app.add_option("--extractor", w.extractor)->check(CLI::IsMember({"native", "opencv"}));
    app.add_option("--matcher", w.matcher)->check(CLI::IsMember({"patch", "orb"}));
    app.add_option("--images", w.images)->check(CLI::IsMember({"files", "none"}));
    app.add_option("--image-size", w.image_size, "WxH, with --images none");
    app.add_option("--ego", w.ego, "estimate, or a poses file: ego-motion is taken from it");
    app.add_option("--mount", o.mount, "file with T_v_c, 12 values");
    app.add_option("--camera-height", w.camera_height_m, "camera above the road, m");
    app.add_option("--features", w.features)->check(CLI::IsMember({"images", "simulated"}));
    app.add_option("--feature-noise", o.feature_noise_px, "px, of simulated features (0.5)")
        ->check(CLI::Range(0.01, 10.0));
    app.add_option("--vehicle-motion", o.vehicle_motion, "FILE or simulated: the vehicle's own speed and yaw rate");
    app.add_option("--can-dialect", w.can_dialect)->check(CLI::IsMember({"fd", "classic"}));
    add_can_id_options(app, o.can);
    CLI::Option* const can = app.add_option("--can", o.can_interface, "SocketCAN interface to send on");
    can->each([](const std::string& name) {
        if (name.empty()) {
            throw CLI::ValidationError("--can", "an interface's name is empty");
        }
    });
    app.add_flag("--realtime", o.realtime, "at the drive's own pace");
    app.add_option("--workers", o.workers, "threads that solve objects; the same results with any number (1)")
        ->check(CLI::Range(1, kMaxWorkers));
    app.add_flag("--pictures", o.pictures, "write pictures");
    app.add_flag("--points", o.points, "write points.csv");
    app.add_flag("--stages", o.stages, "write stages.csv: a hash of what each stage left");
    app.add_flag("--no-progress", w.no_progress);
    app.add_option("--out", o.out, "folder for the results")->required();
}

Cues parse_cues(const Words& w, bool images) {
    Cues cues{true, true, images, images, true};
    if (w.cues.empty()) {
        return cues;
    }
    cues = Cues{false, false, false, false, false};
    for (const char letter : w.cues) {
        bool* const cue = letter == 'S'   ? &cues.box
                          : letter == 'M' ? &cues.motion
                          : letter == 'F' ? &cues.features
                          : letter == 'P' ? &cues.alignment
                          : letter == 'G' ? &cues.ground
                                          : nullptr;
        if (cue == nullptr) {
            throw InputError("--cues: '" + w.cues + "' has other letters than S, M, F, P, G");
        }
        *cue = true;
    }
    if (!cues.box) {
        throw InputError("--cues: S (the box) is always needed");
    }
    if (!images && (cues.features || cues.alignment)) {
        throw InputError("--cues: F and P need images");
    }
    return cues;
}

void parse_image_size(const std::string& text, DriveOptions& drive) {
    const char* const end = text.data() + text.size();
    const auto [x, error_w] = std::from_chars(text.data(), end, drive.width);
    const bool has_x = error_w == std::errc{} && x != end && *x == 'x';
    const auto [rest, error_h] = std::from_chars(has_x ? x + 1 : end, end, drive.height);
    if (!has_x || error_h != std::errc{} || rest != end) {
        throw InputError("--image-size: '" + text + "' is not WIDTHxHEIGHT");
    }
    if (drive.width < kLeastImage_px || drive.width > kMaxImageWidth || drive.height < kLeastImage_px ||
        drive.height > kMaxImageHeight) {
        throw InputError("--image-size: " + text + " is not between 64x64 and " + std::to_string(kMaxImageWidth) + "x" +
                         std::to_string(kMaxImageHeight));
    }
}

void add_run(CLI::App& app, RunOptions& o, bool& no_progress) {
    app.add_option("--scenarios", o.scenarios, "scenario file (JSON)")->required();
    app.add_option("--out", o.out, "folder for the results")->required();
    app.add_option("--baseline", o.baseline, "folder of baselines to compare with");
    app.add_option("--junit", o.junit, "JUnit file (default: OUT/junit.xml)");
    app.add_option("--jobs", o.jobs, "replays at a time")->check(CLI::Range(1, 64));
    app.add_flag("--update-baseline", o.update_baseline, "write the baselines instead of comparing")
        ->needs("--baseline");
    app.add_flag("--no-progress", no_progress);
}

void add_convert(CLI::App& app, ConvertCommand& o, bool& no_viewpoint) {
    app.add_option("--format", o.convert.format, "what the input is")
        ->required()
        ->check(CLI::IsMember({"kitti", "rrc", "pointrcnn", "coco"}));
    app.add_option("--in", o.convert.in, "file (kitti: also a folder of one file a frame)")->required();
    app.add_option("--labels", o.convert.labels, "KITTI tracking labels, for viewpoints by overlap");
    app.add_option("--labels-viewpoints", o.convert.labels_viewpoints, "viewpoints of these labels")->needs("--labels");
    app.add_flag("--no-viewpoint", no_viewpoint, "leave viewpoints out");
    app.add_option("--class", o.convert.object_class, "of rows without one (Car)");
    app.add_option("--least-score", o.convert.least_score, "rows below are left out");
    app.add_option("--focal", o.convert.focal_px, "px, for results without a 3D place");
    app.add_option("--first", o.convert.first, "first frame that the detector saw (0)");
    app.add_option("--last", o.convert.last, "last one (the last row's)");
    app.add_option("--out", o.out, "detection file to write")->required();
}

void finish_replay(const Words& w, ReplayOptions& o) {
    o.drive.images = w.images == "files";
    if (w.ego != "estimate") {
        o.drive.ego = w.ego;
    }
    if (!o.drive.images && o.drive.ego.empty()) {
        throw InputError("--images none: needs --ego FILE");
    }
    if (!w.image_size.empty()) {
        if (o.drive.images) {
            throw InputError("--image-size: only with --images none");
        }
        parse_image_size(w.image_size, o.drive);
    }
    if (!(w.camera_height_m >= kLeastHeight_m && w.camera_height_m <= kMostHeight_m)) {
        throw InputError("--camera-height: not between 0.1 and 10 m");
    }
    if (o.first && o.last && *o.first > *o.last) {
        throw InputError("--first " + std::to_string(*o.first) + " is greater than --last " + std::to_string(*o.last));
    }
    o.simulated_features = w.features == "simulated";
    if (o.simulated_features && (o.drive.images || o.drive.ego.empty())) {
        throw InputError("--features simulated: needs --images none and --ego FILE");
    }
    o.config.cues = parse_cues(w, o.drive.images || o.simulated_features);
    o.config.camera_height_m = w.camera_height_m;
    o.config.mask_objects = w.mask == "on";
    o.config.matcher = w.matcher == "orb" ? MatcherKind::kOrb : MatcherKind::kPatch;
    o.opencv_extractor = w.extractor == "opencv";
#ifndef SEMTRACK_HAS_OPENCV
    if (o.opencv_extractor) {
        throw InputError("--extractor opencv: this program was built without OpenCV");
    }
#endif
    if (o.opencv_extractor && o.config.matcher != MatcherKind::kOrb) {
        throw InputError("--extractor opencv: only with --matcher orb");
    }
    o.can.dialect = w.can_dialect == "classic" ? CanDialect::kClassic : CanDialect::kFd;
    if (const std::string complaint = complaint_about_ids(o.can); !complaint.empty()) {
        throw InputError(complaint);
    }
    o.progress = !w.no_progress;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    CommandLine line;
    Words words;
    CLI::App app("semtrack software in the loop: ego-motion and 3D object tracking on recorded or rendered drives",
                 "semtrack-sil");
    app.require_subcommand(1);
    CLI::App* const replay = app.add_subcommand("replay", "run a drive through the tracker");
    add_replay(*replay, line.replay, words);
    CLI::App* const render = app.add_subcommand("render", "write a rendered scenario in one of KITTI's layouts");
    render->add_option("--scenario", line.render.scenario)->required();
    render->add_option("--layout", line.render.layout)
        ->required()
        ->check(CLI::IsMember({"raw", "odometry", "tracking"}));
    render->add_option("--frames", line.render.frames)->check(CLI::Range(1, 100000));
    render->add_option("--out", line.render.out)->required();
    CLI::App* const evaluate = app.add_subcommand("evaluate", "compare a results folder with the truth");
    add_drive(*evaluate, line.evaluate.drive);
    evaluate->add_option("--results", line.evaluate.results)->required();
    CLI::App* const run = app.add_subcommand("run", "run a file of scenarios against bounds and baselines");
    bool no_progress = false;
    add_run(*run, line.run, no_progress);
    CLI::App* const convert = app.add_subcommand("convert-detections", "make the detection format from other ones");
    bool no_viewpoint = false;
    add_convert(*convert, line.convert, no_viewpoint);
    const std::array<std::pair<CLI::App*, Command>, 5> commands{{{replay, Command::kReplay},
                                                                 {render, Command::kRender},
                                                                 {evaluate, Command::kEvaluate},
                                                                 {run, Command::kRun},
                                                                 {convert, Command::kConvert}}};
    const auto parsed = [&] {
        return std::find_if(commands.begin(), commands.end(), [](const auto& c) { return c.first->parsed(); });
    };
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        line.help = parsed() == commands.end() ? app.help() : parsed()->first->help();
        return line;
    } catch (const CLI::ParseError& error) {
        throw InputError(error.what());
    }
    line.command = parsed()->second;
    if (line.command == Command::kReplay) {
        finish_replay(words, line.replay);
    }
    line.run.progress = !no_progress;
    line.convert.convert.viewpoints = !no_viewpoint;
    return line;
}

}  // namespace semtrack::sil
