#include "publish/object_list.hpp"

#include <cmath>

#include "math/sort.hpp"

namespace semtrack {

namespace {

constexpr double kMinExistence = 0.05;  // how far uncertainty pushes an object back
constexpr double kTruncatedShare = 0.1;
constexpr double kMovingPerson_mps = 0.5;  // below, the direction of motion says nothing

struct Rank {
    double key;
    std::uint32_t id;
    std::uint8_t index;

    bool operator<(const Rank& o) const { return key < o.key || (key == o.key && id < o.id); }
};

class Values {
public:
    explicit Values(SignalValues& v) : v_(v) { v_ = SignalValues{}; }
    void set(SignalId id, double value) { v_[static_cast<std::size_t>(id)] = {value, true}; }
    void flag(SignalId id, bool value) { set(id, value ? 1.0 : 0.0); }
    /// 0 says that the component is not estimated.
    void sigma(SignalId id, double value) {
        if (value > 0.0) {
            set(id, value);
        }
    }
    [[nodiscard]] bool saturated(int first, int last) const {
        for (int i = first; i < last; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (quantise(signal_spec(static_cast<SignalId>(i)), v_[k]).saturated) {
                return true;
            }
        }
        return false;
    }

private:
    SignalValues& v_;
};

double modulo(std::int64_t value, std::int64_t modulus) {
    const std::int64_t rest = value % modulus;
    return static_cast<double>(rest < 0 ? rest + modulus : rest);
}

}  // namespace

int choose_objects(const Output& output, int max_objects, ObjectOrder& order) {
    StaticVector<Rank, kMaxObjects> ranks;
    for (int i = 0; i < output.objects.size(); ++i) {
        const TrackedObject& o = output.objects[i];
        const auto& p = o.position_v;
        const double distance = std::sqrt(p[0] * p[0] + p[1] * p[1]);
        const double certainty = o.existence > kMinExistence ? o.existence : kMinExistence;
        const Rank rank{distance / certainty, o.id, static_cast<std::uint8_t>(i)};
        if (std::isfinite(rank.key) && std::isfinite(p[2])) {
            (void)ranks.try_push_back(rank);  // as many places as the output has
        }
    }
    heap_sort(ranks.begin(), ranks.size());
    ranks.truncate(max_objects);
    order.clear();
    for (const Rank& rank : ranks) {
        (void)order.try_push_back(rank.index);
    }
    return output.objects.size() - order.size();
}

void header_values(const Output& output, const ListFacts& facts, SignalValues& values) {
    const EgoState& e = output.ego;
    const Health& h = output.health;
    Values v(values);
    v.set(SignalId::kListCounter, facts.list_counter);
    v.set(SignalId::kProtocolVersion, kProtocolVersion);
    v.set(SignalId::kObjectCount, facts.objects);
    v.set(SignalId::kObjectsDropped, facts.dropped + static_cast<double>(h.objects_untracked));
    v.set(SignalId::kImageTime, modulo(e.time_us, std::int64_t{1} << signal_spec(SignalId::kImageTime).length));
    v.set(SignalId::kImageAge, static_cast<double>(facts.now_us - e.time_us) * 1e-3);
    v.set(SignalId::kEgoStatus, static_cast<double>(e.status));
    v.set(SignalId::kEgoSpeed, e.speed);
    v.set(SignalId::kEgoYawRate, e.yaw_rate);
    v.sigma(SignalId::kSigmaEgoSpeed, e.sigma_speed);
    v.sigma(SignalId::kSigmaEgoYawRate, e.sigma_yaw_rate);
    v.flag(SignalId::kEgoDegraded, h.ego_degraded);
    v.flag(SignalId::kNoRightImage, h.no_right_image);
    v.flag(SignalId::kNoDetections, h.no_detections);
    v.set(SignalId::kFramesDropped, modulo(h.frames_dropped, 1 << signal_spec(SignalId::kFramesDropped).length));
    v.flag(SignalId::kHeaderSaturated, v.saturated(0, kFirstObjectSignal));
}

void object_values(const TrackedObject& o, std::uint8_t list_counter, SignalValues& values) {
    Values v(values);
    v.set(SignalId::kListCounter, list_counter);
    v.set(SignalId::kObjectId, static_cast<double>(o.id % kObjectIds));
    v.set(SignalId::kClass, static_cast<double>(o.object_class));
    v.set(SignalId::kStatus, static_cast<double>(o.status));
    v.set(SignalId::kMovement, static_cast<double>(o.movement));
    v.set(SignalId::kExistence, o.existence);
    const auto oldest = static_cast<double>(max_raw(signal_spec(SignalId::kAge)));
    v.set(SignalId::kAge, o.age < oldest ? o.age : oldest);
    v.set(SignalId::kPositionX, o.position_v[0]);
    v.set(SignalId::kPositionY, o.position_v[1]);
    v.set(SignalId::kPositionZ, o.position_v[2]);
    v.set(SignalId::kVelocityX, o.velocity_v[0]);
    v.set(SignalId::kVelocityY, o.velocity_v[1]);
    if (o.has_heading || std::fabs(o.speed) > kMovingPerson_mps) {
        v.set(SignalId::kYaw, o.yaw_v);
        v.sigma(SignalId::kSigmaYaw, o.sigma_yaw);
    }
    v.set(SignalId::kYawRate, o.yaw_rate);
    v.set(SignalId::kLength, o.size[0]);
    v.set(SignalId::kWidth, o.size[1]);
    v.set(SignalId::kHeight, o.size[2]);
    v.sigma(SignalId::kSigmaX, o.sigma_position_v[0]);
    v.sigma(SignalId::kSigmaY, o.sigma_position_v[1]);
    v.sigma(SignalId::kSigmaZ, o.sigma_position_v[2]);
    v.sigma(SignalId::kSigmaVelocityX, o.sigma_velocity_v[0]);
    v.sigma(SignalId::kSigmaVelocityY, o.sigma_velocity_v[1]);
    v.flag(SignalId::kTruncated, o.truncation > kTruncatedShare);
    v.set(SignalId::kOcclusion, o.occlusion);
    v.set(SignalId::kReferencePoint, 0.0);
    v.flag(SignalId::kSaturated, v.saturated(kFirstObjectSignal, kListSignals));
}

}  // namespace semtrack
