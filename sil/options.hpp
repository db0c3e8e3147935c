// The command line as data. Parsing is in options.cpp; what the words mean is in docs/formats.md.
#ifndef SEMTRACK_SIL_OPTIONS_HPP
#define SEMTRACK_SIL_OPTIONS_HPP

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semtrack/can_encoder.hpp"
#include "semtrack/config.hpp"
#include "semtrack/parallel_objects.hpp"
#include "sil/kitti/convert_detections.hpp"

namespace semtrack::sil {

/// Which drive, and through which cameras.
struct DriveOptions {
    std::string layout;
    std::filesystem::path root;
    std::string sequence;
    std::filesystem::path calib;  ///< empty: the layout's own
    int detections_camera{-1};    ///< -1: the layout's default
    bool images{true};
    int width{1242};  ///< without images
    int height{375};
    std::filesystem::path ego;  ///< poses file; empty: estimate
    std::vector<std::filesystem::path> others;  ///< pose rows of other odometries, of the same frames
};

struct ReplayOptions {
    DriveOptions drive;
    std::optional<int> first;
    std::optional<int> last;
    std::string detections{"none"};  ///< none, labels or a file
    int detection_delay{0};
    bool opencv_extractor{false};
    bool simulated_features{false};
    double feature_noise_px{0.5};  ///< of simulated features
    Config config{};
    std::filesystem::path mount;
    std::string vehicle_motion;  ///< none (empty), simulated or a file
    CanConfig can{};
    std::string can_interface;  ///< empty: can.log only
    bool realtime{false};
    int workers{1};  ///< threads that solve objects
    bool pictures{false};
    bool points{false};
    bool stages{false};
    bool progress{true};
    std::filesystem::path out;
};

struct RenderOptions {
    std::string scenario;
    std::string layout;
    int frames{0};  ///< 0: the scenario's own number
    std::filesystem::path out;
};

struct EvaluateOptions {
    DriveOptions drive;
    std::filesystem::path results;
};

struct RunOptions {
    std::filesystem::path scenarios;
    std::filesystem::path out;
    std::filesystem::path baseline;  ///< empty: none
    std::filesystem::path junit;     ///< empty: OUT/junit.xml
    bool update_baseline{false};
    int jobs{2};
    bool progress{true};
};

struct ConvertCommand {
    ConvertOptions convert;
    std::filesystem::path out;
};

enum class Command { kHelp, kReplay, kRender, kEvaluate, kRun, kConvert };

struct CommandLine {
    Command command{Command::kHelp};
    std::string help;  ///< kHelp
    ReplayOptions replay;
    RenderOptions render;
    EvaluateOptions evaluate;
    RunOptions run;
    ConvertCommand convert;
};

/// Throws InputError for bad usage, also for what this build does not have.
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace semtrack::sil

#endif
