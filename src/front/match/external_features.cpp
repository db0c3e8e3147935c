#include "front/match/external_features.hpp"

#include <cmath>

#include "math/sort.hpp"

namespace semtrack {

namespace {

std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

bool usable(const ExternalFeature& f, const OwnerMask& mask) {
    return std::isfinite(f.u) && std::isfinite(f.v) && std::isfinite(f.u_right) && f.sigma_px > 0.0F &&
           std::isfinite(f.sigma_px) && f.u >= 0.0F && f.v >= 0.0F && f.u < static_cast<float>(mask.width) &&
           f.v < static_cast<float>(mask.height);
}

}  // namespace

void ExternalMatcher::reset() {
    table_ = FeatureTable{};
}

void ExternalMatcher::collect(const ExternalFeatures& in, const OwnerMask& mask, const OwnerPriors& priors) {
    entries_.clear();
    for (int i = 0; i < in.size(); ++i) {
        if (!usable(in[i], mask)) {
            continue;
        }
        const std::uint8_t owner = mask.at(static_cast<int>(in[i].u), static_cast<int>(in[i].v));
        if (owner < kMaxOwners && priors[owner].active) {
            (void)entries_.try_push_back({owner, in[i].id, static_cast<std::int16_t>(i)});
        }
    }
    heap_sort(entries_.begin(), entries_.size());
}

int ExternalMatcher::find(int begin, int end, std::uint32_t id) const {
    while (begin < end) {
        const int middle = begin + (end - begin) / 2;
        if (entries_[middle].id < id) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// Slots whose feature is there keep it; new features get free slots, in the order of their ids.
void ExternalMatcher::assign(int owner, int begin, int end, int budget) {
    const int first = first_feature_slot(owner);
    int used = 0;
    for (int s = 0; s < feature_slots(owner); ++s) {
        FeatureSlot& slot = table_.at(owner, s);
        entry_of_[at(first + s)] = -1;
        if (!slot.live) {
            continue;
        }
        const int e = find(begin, end, external_id_[at(first + s)]);
        slot.live = e < end && entries_[e].id == external_id_[at(first + s)] && !taken_[at(e)];
        if (slot.live) {
            entry_of_[at(first + s)] = static_cast<std::int16_t>(e);
            taken_[at(e)] = true;
            ++used;
        }
    }
    int free = table_.free_slot(owner);
    for (int e = begin; e < end && free >= 0 && used < budget; ++e) {
        const bool doubled = e > begin && entries_[e - 1].id == entries_[e].id;
        if (taken_[at(e)] || doubled) {
            continue;
        }
        FeatureSlot& slot = table_.at(owner, free);
        slot = FeatureSlot{};
        slot.live = true;
        slot.id = table_.next_id++;
        external_id_[at(first + free)] = entries_[e].id;
        entry_of_[at(first + free)] = static_cast<std::int16_t>(e);
        ++used;
        free = table_.free_slot(owner, free + 1);
    }
}

void ExternalMatcher::emit(int owner, const ExternalFeatures& in, FrameFeatures& out) {
    const int first = first_feature_slot(owner);
    for (int s = 0; s < feature_slots(owner); ++s) {
        FeatureSlot& slot = table_.at(owner, s);
        if (!slot.live) {
            continue;
        }
        const ExternalFeature& f = in[entries_[entry_of_[at(first + s)]].index];
        FeatureMeasurement m = continued(slot, owner, s);
        m.u = f.u;
        m.v = f.v;
        m.stereo = f.stereo;
        m.u_right = f.stereo ? f.u_right : 0.0F;
        m.v_right = f.stereo ? f.v : 0.0F;
        m.sigma_px = f.sigma_px;
        m.sigma_right_px = f.sigma_px;
        store(m, slot);
        if (!out.try_push_back(m)) {
            return;
        }
    }
}

void ExternalMatcher::process(const ExternalFeatures& in, const OwnerMask& mask, const OwnerPriors& priors,
                              FrameFeatures& out) {
    out.clear();
    collect(in, mask, priors);
    taken_.fill(false);
    int begin = 0;
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        int end = begin;
        while (end < entries_.size() && entries_[end].owner == owner) {
            ++end;
        }
        if (priors[at(owner)].active) {
            assign(owner, begin, end, priors[at(owner)].budget);
            emit(owner, in, out);
        } else {
            table_.clear_owner(owner);
        }
        begin = end;
    }
}

}  // namespace semtrack
