#include "sil/stage_trace.hpp"

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <new>

#include "pipeline/tracker_core.hpp"

namespace semtrack {

namespace {

/// FNV-1a over values, byte by byte from the lowest.
class Hash {
public:
    void add(std::uint64_t value) {
        for (int i = 0; i < 8; ++i) {
            byte(static_cast<std::uint8_t>(value & 0xFFU));
            value >>= 8U;
        }
    }
    void add(double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        add(bits);
    }
    void add(float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        add(std::uint64_t{bits});
    }
    template <class Matrix>
    void add_all(const Matrix& m) {
        for (int r = 0; r < static_cast<int>(m.rows()); ++r) {
            for (int c = 0; c < static_cast<int>(m.cols()); ++c) {
                add(m(r, c));
            }
        }
    }
    void add(const Pose& T) {
        add_all(T.R);
        add_all(T.t);
    }
    void add(const OwnerMask& mask) {
        for (int y = 0; y < mask.height; ++y) {
            for (int x = 0; x < mask.width; ++x) {
                byte(mask.at(x, y));
            }
        }
    }
    void add(const FeatureMeasurement& m) {
        add(std::uint64_t{m.id});
        add(std::uint64_t{static_cast<std::uint16_t>(m.slot)} << 8U | std::uint64_t{m.stereo});
        add(m.u);
        add(m.v);
        add(m.sigma_px);
        if (m.stereo) {
            add(m.u_right);
            add(m.v_right);
            add(m.sigma_right_px);
        }
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    void byte(std::uint8_t b) { hash_ = (hash_ ^ b) * 1099511628211ULL; }

    std::uint64_t hash_{14695981039346656037ULL};
};

std::uint64_t track_hash(const Track& track) {
    Hash h;
    h.add(static_cast<std::uint64_t>(track.status));
    h.add(track.existence);
    h.add(static_cast<std::uint64_t>(track.hits));
    h.add_all(track.window.size_m);
    h.add_all(track.window.covariance);
    for (const ObjectFrame& frame : track.window.frames) {
        h.add(std::uint64_t{frame.frame});
        h.add(std::uint64_t{frame.box.valid});
        if (frame.box.valid) {
            for (const double edge :
                 {frame.box.box.left, frame.box.box.top, frame.box.box.right, frame.box.box.bottom}) {
                h.add(edge);
            }
        }
        h.add_all(frame.state.p);
        for (const double x : {frame.state.theta, frame.state.v, frame.state.delta}) {
            h.add(x);
        }
    }
    return h.value();
}

}  // namespace

/// Looks into the tracker; changes nothing.
class StageProbe {
public:
    static const TrackTable& tracks(const TrackerCore& core) { return core.tracks_; }
    static const FrameFeatures& features(const TrackerCore& core) { return core.features_; }
    static std::uint64_t masks(const TrackerCore& core) {
        Hash h;
        h.add(core.mask_left_);
        h.add(core.mask_right_);
        return h.value();
    }
    static std::uint64_t ego(const TrackerCore& core) {
        Hash h;
        h.add(core.T_w_c_);
        return h.value();
    }
};

void StageTrace::watch(const Tracker& tracker) {
    core_ = std::launder(reinterpret_cast<const TrackerCore*>(&tracker));  // its storage is all that a Tracker is
}

void StageTrace::add(Stage stage, std::uint32_t object, std::uint64_t hash) {
    char row[80];
    (void)std::snprintf(row, sizeof row, ",%s,%" PRIu32 ",%016" PRIx64 "\n", stage_name(stage), object, hash);
    rows_ += row;
}

void StageTrace::add_tracks(Stage stage) {
    const TrackTable& tracks = StageProbe::tracks(*core_);
    for (int s = 0; s < kMaxObjects; ++s) {
        std::uint64_t& last = last_[static_cast<std::size_t>(s)];
        const std::uint64_t now = tracks[s].alive ? track_hash(tracks[s]) : 0U;
        if (now != last && now != 0U) {
            add(stage, tracks[s].id, now);
        }
        last = now;
    }
}

void StageTrace::add_features(Stage stage, bool tracked) {
    const TrackTable& tracks = StageProbe::tracks(*core_);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        if (owner != kBackground && !tracks[owner - 1].alive) {
            continue;
        }
        Hash h;
        for (const FeatureMeasurement& m : StageProbe::features(*core_)) {
            if (m.owner == owner && m.tracked == tracked) {
                h.add(m);
            }
        }
        add(stage, owner == kBackground ? 0U : tracks[owner - 1].id, h.value());
    }
}

void StageTrace::begin(Stage stage) noexcept {
    if (core_ != nullptr && stage == Stage::kReject) {  // the matcher's result is whole here
        add_features(Stage::kMatch, true);
        add_features(Stage::kExtract, false);
    }
    next_.begin(stage);
}

void StageTrace::end(Stage stage) noexcept {
    next_.end(stage);
    if (core_ == nullptr) {
        return;
    }
    switch (stage) {
        case Stage::kMask:
            add(stage, 0U, StageProbe::masks(*core_));
            break;
        case Stage::kReject:
            add_features(stage, true);
            break;
        case Stage::kEgo:
            add(stage, 0U, StageProbe::ego(*core_));
            break;
        case Stage::kInfer:
        case Stage::kAssociate:
        case Stage::kObjects:
        case Stage::kAlign:
        case Stage::kLifecycle:
            add_tracks(stage);
            break;
        case Stage::kExtract:
        case Stage::kMatch:
        case Stage::kEncode:  // can.log has it
            break;
    }
}

std::string StageTrace::take(int frame) {
    const std::string number = std::to_string(frame);
    std::string out;
    std::size_t from = 0;
    while (from < rows_.size()) {
        const std::size_t to = rows_.find('\n', from) + 1U;
        out += number;
        out.append(rows_, from, to - from);
        from = to;
    }
    rows_.clear();
    return out;
}

}  // namespace semtrack
