// The result files of a run, row by row as the frames come.
#ifndef SEMTRACK_SIL_REPORT_WRITERS_HPP
#define SEMTRACK_SIL_REPORT_WRITERS_HPP

#include <filesystem>
#include <optional>

#include "semtrack/can_encoder.hpp"
#include "sil/report/tables.hpp"
#include "sil/report/text_output.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// ego.txt, frames.txt, ego.csv, objects.txt, states.csv, list.csv, timing.csv, can.log (opened here, filled by a CanTx), with
/// `points` points.csv. Throws std::runtime_error when one cannot be written.
class ResultWriters {
public:
    /// cameras: with the mount that the tracker has. dialect: of the list that was published.
    ResultWriters(const std::filesystem::path& dir, const DriveCameras& cameras, CanDialect dialect, bool points);
    /// Once per frame number, growing. The first frame's camera is the origin of ego.txt. list_counter: of the list
    /// that was published for this frame.
    void add(int frame, const Output& output, std::uint8_t list_counter, const FrameTiming& timing);
    void close();
    [[nodiscard]] std::FILE* can_log() { return can_log_.handle(); }

private:
    void add_ego(int frame, const Output& output);
    void add_objects(int frame, const Output& output);
    void add_points(int frame, const Output& output);

    Pose T_v_c_;
    Pose T_c_v_;
    std::array<double, 3> t_c0_c_;
    CanDialect dialect_;
    bool started_{false};
    Pose T_first_w_{};  ///< from W to the first processed camera
    TextOutput ego_;
    TextOutput frames_;
    TextOutput ego_csv_;
    TextOutput objects_;
    TextOutput states_;
    TextOutput list_;
    TextOutput timing_;
    TextOutput can_log_;
    std::optional<TextOutput> points_;
};

}  // namespace semtrack::sil

#endif
