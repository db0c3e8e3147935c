// What a run shows at its end: one screen.
#ifndef SEMTRACK_SIL_REPORT_SUMMARY_HPP
#define SEMTRACK_SIL_REPORT_SUMMARY_HPP

#include <string>
#include <vector>

#include "sil/metrics/metrics_json.hpp"

namespace semtrack::sil {

/// Errors in words, one a line; a line only where it is known.
[[nodiscard]] std::string errors_text(const Metrics& metrics);

/// total_us: by frame, for the median and the worst.
[[nodiscard]] std::string summary_text(const std::string& drive, const Metrics& metrics,
                                       const std::vector<double>& total_us, const std::string& out);

}  // namespace semtrack::sil

#endif
