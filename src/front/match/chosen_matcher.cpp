#include "front/match/chosen_matcher.hpp"

namespace semtrack {

void ChosenMatcher::reset(MatcherKind kind, FeatureExtractor* extractor) {
    if (kind == MatcherKind::kOrb) {
        Orb& orb = matcher_.emplace<Orb>();
        orb.matcher.reset();
        orb.matcher.set_extractor(extractor != nullptr ? extractor : &orb.native);
    } else {
        matcher_.emplace<PatchMatcher>().reset();
    }
}

Status ChosenMatcher::process(const MatcherInput& input, FrameFeatures& out) {
    if (Orb* orb = std::get_if<Orb>(&matcher_)) {
        return orb->matcher.process(input, out);
    }
    return std::get_if<PatchMatcher>(&matcher_)->process(input, out);
}

void ChosenMatcher::reject(int owner, int slot) {
    if (Orb* orb = std::get_if<Orb>(&matcher_)) {
        orb->matcher.reject(owner, slot);
    } else {
        std::get_if<PatchMatcher>(&matcher_)->reject(owner, slot);
    }
}

double ChosenMatcher::row_offset_px() const {
    if (const Orb* orb = std::get_if<Orb>(&matcher_)) {
        return orb->matcher.row_offset_px();
    }
    return std::get_if<PatchMatcher>(&matcher_)->row_offset_px();
}

}  // namespace semtrack
