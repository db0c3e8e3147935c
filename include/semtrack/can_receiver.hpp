// The other ECU's side: CAN frames -> whole object lists. Embed it where the lists are used; it needs can_encoder's
// settings (dialect, base id) and nothing else of the tracker (CMake target semtrack::receiver, no Eigen).
//
// Frames are taken one by one in the order of their reception (one FIFO for all ids of the list). Each is checked end
// to end (E2E Profile 5 or 11), and has to be the very next one of its list: a list with a lost, repeated, swapped,
// damaged or foreign frame is given up at once and counted, lists never mix, and the caller's list is written only when
// the last frame of a list has come. Values are decoded by the encoder's own table.
//
// No heap, no exceptions, no recursion, no clock, no libm. sizeof(CanReceiver) is below kCanReceiverBytes; a
// ReceivedList is 10.4 KB and belongs to the caller. Cost: a CRC of at most 64 bytes a frame, and with the last
// frame of a list the decoding of at most 32 objects of 26 signals.
#ifndef SEMTRACK_CAN_RECEIVER_HPP
#define SEMTRACK_CAN_RECEIVER_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "semtrack/can_encoder.hpp"
#include "semtrack/can_frame.hpp"
#include "semtrack/received.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

enum class ReferencePoint : std::uint8_t { kBoxCentre = 0, kBottomMiddle };

/// One road user. Positions in the vehicle frame V (ISO 8855: x forward, y left, z up) of the image's time; velocities
/// over ground, along V's axes. Sigmas are standard deviations; one that is not estimated is not valid.
struct ReceivedObject {
    std::uint16_t id{0};  ///< 0..4094; stays while the track lives, used again later
    Received<ObjectClass> object_class{};
    Received<TrackStatus> status{};
    Received<MovementState> movement{};
    Received<double> existence{};         ///< probability, 0..1
    Received<double> age{};               ///< cycles since the first detection; stops at 1022
    Received<double> x{};                 ///< m, of reference_point
    Received<double> y{};                 ///< m
    Received<double> z{};                 ///< m
    Received<double> velocity_x{};        ///< m/s
    Received<double> velocity_y{};        ///< m/s
    Received<double> yaw{};               ///< rad, heading against V's x axis; not valid: a standing pedestrian
    Received<double> yaw_rate{};          ///< rad/s
    Received<double> length{};            ///< m, of the 3D box
    Received<double> width{};             ///< m
    Received<double> height{};            ///< m
    Received<double> sigma_x{};           ///< m
    Received<double> sigma_y{};           ///< m
    Received<double> sigma_z{};           ///< m
    Received<double> sigma_velocity_x{};  ///< m/s
    Received<double> sigma_velocity_y{};  ///< m/s
    Received<double> sigma_yaw{};         ///< rad
    Received<bool> truncated{};           ///< partly outside the image
    Received<std::uint8_t> occlusion{};   ///< 0 visible, 1 partly, 2 largely hidden, 3 unknown
    Received<ReferencePoint> reference_point{};
    bool saturated{false};  ///< at least one value is
};

struct ReceivedList {
    std::uint8_t list_counter{0};
    std::int64_t image_time_us{0};    ///< of the images, in the sender's time base, unwrapped over 2^40 us
    Received<std::int64_t> age_us{};  ///< of the images when the list was sent; steps of 100 us
    std::int64_t received_us{0};      ///< reception of the list's first frame, receiver's clock
    /// When the images were taken, receiver's clock: received_us - age_us (the first frame's way over the bus, about
    /// 0.3 ms, is neglected). Not valid when the age is missing or saturated.
    Received<std::int64_t> taken_us{};
    Received<EgoStatus> ego_status{};
    Received<double> ego_speed{};     ///< m/s along V's x axis
    Received<double> ego_yaw_rate{};  ///< rad/s, positive to the left
    Received<double> sigma_ego_speed{};
    Received<double> sigma_ego_yaw_rate{};
    Received<bool> ego_degraded{};
    Received<bool> no_right_image{};
    Received<bool> no_detections{};
    Received<bool> road_not_plane{};
    std::uint16_t frames_dropped{0};                      ///< images lost since the sender's start, modulo 2^16
    Received<double> objects_dropped{};                   ///< road users that found no place in the list
    bool saturated{false};                                ///< at least one of the header's values is
    StaticVector<ReceivedObject, kMaxObjects> objects{};  ///< nearest and most certain first
};

struct CanReceiverConfig {
    CanConfig can{};
    std::int64_t timeout_us{300000};  ///< without a whole list; three cycles of 10 Hz
    /// The first list's image time is the first one not before this (0: the 40 bits as they come). A receiver that
    /// knows the sender's time to some days gets its full value so.
    std::int64_t reference_time_us{0};
};

enum class FrameResult : std::uint8_t {
    kIgnored = 0,   ///< another message's id; nothing changed
    kTaken,         ///< a frame of a list that is not whole yet
    kListComplete,  ///< the list's last frame: `list` holds it
    kRefused        ///< counted, and the list it came in is given up
};

/// Only grow (and wrap at 2^32).
struct CanReceiverCounters {
    std::array<std::uint32_t, kE2eStates> frames{};  ///< by E2eState; kNoNewData: frames of other ids
    std::uint32_t frames_out_of_place{0};            ///< right by themselves, but not the next one of the list
    std::uint32_t lists_complete{0};
    std::uint32_t lists_broken{0};   ///< begun and given up
    std::uint32_t lists_missed{0};   ///< never begun: the list counter jumped over them (at most 255 at a time)
    std::uint32_t lists_refused{0};  ///< of another protocol version, or with an impossible count
    std::uint32_t timeouts{0};
};

inline constexpr std::size_t kCanReceiverBytes = 1280;

class CanReceiver {
public:
    /// Forgets everything. kInvalidArgument: the ids do not fit into 11 (29) bits, or the time-out is not positive;
    /// then every frame is ignored.
    Status init(const CanReceiverConfig& config);
    /// now_us: reception, by any clock of the receiver that does not run backwards. `list` is written when the result
    /// is kListComplete, and untouched otherwise. Any bytes may come.
    [[nodiscard]] FrameResult take(const CanFrame& frame, std::int64_t now_us, ReceivedList& list);
    /// What became of the lists since the last call; for a task that runs once a cycle. kOk: a whole list came.
    /// kOkSomeLost: a whole list came, and one before it did not. kRepeated, kWrongSequence, kError: none came, and
    /// that is the last refused frame's state (kError too for one out of place). kNoNewData: nothing came.
    [[nodiscard]] E2eState poll();
    /// No whole list for timeout_us, or none yet. The last list is not to be used any more.
    [[nodiscard]] bool timed_out(std::int64_t now_us) const;
    [[nodiscard]] const CanReceiverCounters& counters() const { return counters_; }

private:
    E2eState check(const CanFrame& frame, int message);
    [[nodiscard]] bool begin_list(const CanFrame& frame, std::int64_t now_us);
    [[nodiscard]] bool is_next(const CanFrame& frame, int message) const;
    FrameResult refuse(E2eState state);
    FrameResult finish(ReceivedList& list);
    void give_up();
    void restart_after_silence(std::int64_t now_us);
    [[nodiscard]] std::int64_t unwrap(std::uint64_t raw) const;

    /// Of a whole list: FD 24 + 16 x 64, classic 116 x 8.
    static constexpr std::size_t kListBytes = 1048;

    CanReceiverConfig config_{};
    CanReceiverCounters counters_{};
    std::array<E2eCheck, 16> checks_{};  // per message of the table
    std::array<std::uint8_t, kListBytes> bytes_{};
    std::size_t size_{0};
    int next_{0};  // frame of the list that has to come; 0: none begun
    int total_{0};
    int objects_{0};
    std::uint8_t list_counter_{0};
    bool ready_{false};     // init succeeded
    bool counted_{false};   // list_counter_ is of a list
    bool heard_{false};     // a frame came since init or the last silence
    bool whole_{false};     // a list came since init
    bool new_list_{false};  // since poll
    bool new_loss_{false};
    E2eState refused_{E2eState::kNoNewData};
    std::int64_t heard_us_{0};
    std::int64_t whole_us_{0};  // reception of the first frame of the last whole list
    std::int64_t begun_us_{0};
    std::int64_t image_time_us_{0};
};
static_assert(sizeof(CanReceiver) <= kCanReceiverBytes, "see the head of this file");

/// Brings a list to another time of the receiver's clock: objects go on straight with their velocity, turn with their
/// yaw rate, and the vehicle frame moves along the ego's arc; V of own_us is the frame of the result. Sigmas of x, y
/// and yaw are untouched: the receiver adds its own model. At most a second from taken_us. kInvalidArgument: taken_us,
/// ego speed or ego yaw rate are not valid or saturated, or own_us is farther away; the list is then untouched.
Status bring_to_time(std::int64_t own_us, ReceivedList& list);

}  // namespace semtrack

#endif
