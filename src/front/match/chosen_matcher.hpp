// The matcher that the configuration chooses. Only one runs, so the others take no memory of their own.
#ifndef SEMTRACK_FRONT_MATCH_CHOSEN_MATCHER_HPP
#define SEMTRACK_FRONT_MATCH_CHOSEN_MATCHER_HPP

#include <variant>

#include "front/feature/orb_extractor.hpp"
#include "front/match/orb_matcher.hpp"
#include "front/match/patch_matcher.hpp"
#include "semtrack/config.hpp"

namespace semtrack {

class ChosenMatcher {
public:
    ChosenMatcher() = default;
    ~ChosenMatcher() = default;
    ChosenMatcher(const ChosenMatcher&) = delete;  // the matcher points to the extractor beside it
    ChosenMatcher& operator=(const ChosenMatcher&) = delete;
    /// Starts from nothing. extractor: of the orb matcher, not owned; null: the native one.
    void reset(MatcherKind kind, FeatureExtractor* extractor);
    /// As PatchMatcher::process and OrbMatcher::process.
    Status process(const MatcherInput& input, FrameFeatures& out);
    void reject(int owner, int slot);
    [[nodiscard]] double row_offset_px() const;

private:
    struct Orb {
        OrbExtractor native{};
        OrbMatcher matcher{};
    };
    std::variant<PatchMatcher, Orb> matcher_{};
};

}  // namespace semtrack

#endif
