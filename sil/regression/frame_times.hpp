// Times of a case from its timing.csv, for tables only: they are the machine's, not the product's.
#ifndef SEMTRACK_SIL_REGRESSION_FRAME_TIMES_HPP
#define SEMTRACK_SIL_REGRESSION_FRAME_TIMES_HPP

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace semtrack::sil {

/// Each frame's and stage's shortest time over the runs that were added: another program that ran in between lengthens
/// one of them, not all.
class FrameTimes {
public:
    /// Runs of one case have the same frames; InputError when they do not.
    void add(const std::filesystem::path& timing_csv);
    /// NAME_ms, the median over the frames, and NAME_max_ms for the total, every stage, and front_end: the stages
    /// before the estimator, infer to reject.
    [[nodiscard]] nlohmann::ordered_json metrics() const;

private:
    struct Column {
        std::string name;
        std::vector<double> ms;  ///< by frame
    };
    std::vector<Column> columns_;
};

}  // namespace semtrack::sil

#endif
