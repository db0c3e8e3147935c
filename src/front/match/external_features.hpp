// Features from outside in place of a matcher's: they get their owner from the masks, a slot, and an identity that ends
// where the owner changes.
#ifndef SEMTRACK_FRONT_MATCH_EXTERNAL_FEATURES_HPP
#define SEMTRACK_FRONT_MATCH_EXTERNAL_FEATURES_HPP

#include "front/match/matcher.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

class ExternalMatcher {
public:
    void reset();
    /// out sorted by owner, then slot. Features beyond an owner's budget, or with an id that is there already, are left
    /// out. Cost: a sort of the features.
    void process(const ExternalFeatures& in, const OwnerMask& mask, const OwnerPriors& priors, FrameFeatures& out);
    /// An outlier: its slot is freed; when it comes again it is a new feature.
    void reject(int owner, int slot) { table_.at(owner, slot).live = false; }

private:
    /// Sorted by owner, then id: the features of one owner are a block.
    struct Entry {
        std::uint8_t owner{0};
        std::uint32_t id{0};
        std::int16_t index{0};
        bool operator<(const Entry& o) const {
            return owner != o.owner ? owner < o.owner : id != o.id ? id < o.id : index < o.index;
        }
    };
    void collect(const ExternalFeatures& in, const OwnerMask& mask, const OwnerPriors& priors);
    [[nodiscard]] int find(int begin, int end, std::uint32_t id) const;
    void assign(int owner, int begin, int end, int budget);
    void emit(int owner, const ExternalFeatures& in, FrameFeatures& out);

    FeatureTable table_{};
    std::array<std::uint32_t, kMaxFeatures> external_id_{};  // of each slot
    std::array<std::int16_t, kMaxFeatures> entry_of_{};      // of each slot in this frame; -1: none
    StaticVector<Entry, kMaxFeatures> entries_{};
    std::array<bool, kMaxFeatures> taken_{};
};

}  // namespace semtrack

#endif
