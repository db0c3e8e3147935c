#include "hal/linux/socketcan_rx.hpp"

#include <sys/time.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace semtrack::hal {

namespace {

constexpr std::int64_t kMicroseconds = 1000000;

/// The kernel's stamp, else `otherwise`.
std::int64_t stamp_of(msghdr& message, std::int64_t otherwise) {
    const cmsghdr* const control = CMSG_FIRSTHDR(&message);  // only the stamp is asked for
    if (control == nullptr || control->cmsg_level != SOL_SOCKET || control->cmsg_type != SO_TIMESTAMP) {
        return otherwise;
    }
    timeval time{};
    std::memcpy(&time, CMSG_DATA(control), sizeof time);
    return std::int64_t{time.tv_sec} * kMicroseconds + time.tv_usec;
}

}  // namespace

CanOpen SocketCanRx::open(const char* interface, const CanConfig& config, std::int64_t clock_offset_us) noexcept {
    config_ = config;
    clock_offset_us_ = clock_offset_us;
    CanSocket::Options options;
    options.fd = config.dialect == CanDialect::kFd;
    options.receives = true;
    options.stamps = true;
    // Exactly this id, of its width, no remote frames.
    options.filter.can_id = vehicle_motion_id(config) | (config.extended ? CAN_EFF_FLAG : 0U);
    options.filter.can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | (config.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    const CanOpen result = socket_.open(interface, options);
    gone_ = result != CanOpen::kOk;
    fresh_ = false;
    check_ = E2eCheck{};
    return result;
}

SourceResult SocketCanRx::poll(std::int64_t, VehicleMotion& motion) noexcept {
    if (gone_ && socket_.reopen() == CanOpen::kOk) {
        gone_ = false;
        ++counters_.reopened;
    }
    const std::int64_t monotonic_us = calls_.monotonic_us();
    const std::int64_t realtime_us = calls_.realtime_us();
    for (int k = 0; k < kMaxReads && !gone_; ++k) {
        if (!read_one(realtime_us, realtime_us - monotonic_us)) {
            break;
        }
    }
    if (fresh_ && monotonic_us - received_us_ > kTimeout_us) {
        ++counters_.timeouts;
        fresh_ = false;
        check_ = E2eCheck{};  // whatever counter comes next starts a new sequence
    }
    if (!fresh_) {
        return SourceResult::kNone;
    }
    motion = motion_;
    return SourceResult::kOk;
}

/// Stamps are of CLOCK_REALTIME, which may be set; ages are not to follow it, so they count by the monotonic clock.
/// False: there is nothing more to read.
bool SocketCanRx::read_one(std::int64_t now_us, std::int64_t realtime_minus_monotonic_us) noexcept {
    canfd_frame frame{};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timeval))> control{};
    iovec place{&frame, sizeof frame};
    msghdr message{};
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const int size = calls_.receive(socket_.fd(), message);
    if (size == -ENODEV || size == -ENXIO || size == -EBADF) {
        ++counters_.downs;
        gone_ = true;
        return false;
    }
    if (size == -ENETDOWN) {
        ++counters_.downs;
        return true;  // said once; what was received before is still there
    }
    if (size < 0) {
        return size == -EINTR;
    }
    if (size == static_cast<int>(CAN_MTU) || size == static_cast<int>(CANFD_MTU)) {
        const std::int64_t stamp_us = std::min(stamp_of(message, now_us), now_us);
        take(frame, size, stamp_us, stamp_us - realtime_minus_monotonic_us);
    }
    return size > 0;
}

void SocketCanRx::take(const canfd_frame& frame, int size, std::int64_t stamp_us, std::int64_t received_us) noexcept {
    CanFrame in;
    in.extended = (frame.can_id & CAN_EFF_FLAG) != 0U;
    in.id = frame.can_id & (in.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    in.fd = size == static_cast<int>(CANFD_MTU);
    in.length = std::min<std::uint8_t>(frame.len, in.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
    std::copy_n(frame.data, in.length, in.data.begin());
    // Older than the time-out before this one: the sequence starts again, as after a poll that saw it.
    if (check_.started && received_us - received_us_ > kTimeout_us) {
        check_ = E2eCheck{};
    }
    VehicleMotionSignals signals;
    const E2eState state = decode_vehicle_motion(config_, in, check_, signals);
    ++counters_.frames[static_cast<std::size_t>(state)];
    if (!usable(state)) {
        return;
    }
    if (!to_vehicle_motion(signals, stamp_us + clock_offset_us_, motion_)) {
        ++counters_.not_available;
        fresh_ = false;
        return;
    }
    received_us_ = received_us;
    fresh_ = true;
}

}  // namespace semtrack::hal
