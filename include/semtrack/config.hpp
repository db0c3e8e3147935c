// Settings of a run. One value for all drives; every number has a unit and a meaning.
#ifndef SEMTRACK_CONFIG_HPP
#define SEMTRACK_CONFIG_HPP

#include <cstdint>

#include "semtrack/capacity.hpp"

namespace semtrack {

/// Terms of the object's cost; the paper's letters, and G (ground contact), ours.
struct Cues {
    bool box{true};         ///< S: box edges, always on
    bool motion{true};      ///< M: kinematic model
    bool features{true};    ///< F: features
    bool alignment{true};   ///< P: point-cloud alignment
    bool ground{true};      ///< G: ground contact
};

enum class MatcherKind : std::uint8_t { kPatch = 0, kOrb };

struct Config {
    Cues cues{};
    MatcherKind matcher{MatcherKind::kPatch};
    int background_features{500};     ///< at most kMaxBackgroundFeatures
    int object_features{100};         ///< at most kMaxObjectFeatures
    bool mask_objects{true};          ///< false: features on objects count as background (to show what masks are worth)
    double camera_height_m{1.65};     ///< above the road
    double camera_height_sigma_m{0.03};
};

}  // namespace semtrack

#endif
