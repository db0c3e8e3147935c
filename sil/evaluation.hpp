// A results folder against a drive's truth: used by `evaluate` and, on its own fresh files, by `replay`.
#ifndef SEMTRACK_SIL_EVALUATION_HPP
#define SEMTRACK_SIL_EVALUATION_HPP

#include <filesystem>

#include "sil/metrics/metrics_json.hpp"
#include "sil/options.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

struct DriveTruth {
    Trajectory ego{};  ///< processed camera, in the frame of the file; empty: none
    ObjectTruthSet objects{};
    std::array<double, 3> t_c0_c{};            ///< x_c0 = x_c + t_c0_c
    std::optional<Calibration> calibration{};  ///< empty: not read
};

struct ResultFiles {
    std::vector<int> frames;
    Trajectory ego;
    bool has_objects{false};
    std::vector<ObjectRow> objects;
    std::vector<StateRow> states;  ///< empty, as ego_motion, in a folder that another program made
    std::vector<EgoMotionRow> ego_motion;
};

/// Labels' boxes are moved into the processed left image.
[[nodiscard]] DriveTruth truth_of(const Sequence& sequence);
/// For `evaluate`: an odometry sequence needs its poses only; other drives need no images.
[[nodiscard]] DriveTruth read_truth(const DriveOptions& options);

/// DIR/ego.txt and frames.txt, and objects.txt where it is. InputError by line: rows that do not fit together,
/// doubled or falling frame numbers, an object without size, the same frame and id twice.
[[nodiscard]] ResultFiles read_results(const std::filesystem::path& dir);
[[nodiscard]] Metrics compare(const ResultFiles& results, const DriveTruth& truth);
/// `others`: pose rows of other odometries on the frames of the results.
[[nodiscard]] Metrics evaluate_results(const std::filesystem::path& dir, const DriveTruth& truth,
                                       const std::vector<std::filesystem::path>& others);

/// `semtrack-sil evaluate`: writes DIR/metrics.json (the run's own counts in an older one are kept) and prints.
void run_evaluate(const EvaluateOptions& options);

}  // namespace semtrack::sil

#endif
