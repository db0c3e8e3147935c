// `semtrack-sil replay`: a drive through the same cycle that runs on an ECU, results into files.
#ifndef SEMTRACK_SIL_REPLAY_HPP
#define SEMTRACK_SIL_REPLAY_HPP

#include "sil/options.hpp"

namespace semtrack::sil {

/// InputError: bad input, nothing was written. Any other exception: the run failed, old results are untouched.
void run_replay(const ReplayOptions& options);

}  // namespace semtrack::sil

#endif
