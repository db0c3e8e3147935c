#include "hal/linux/socketcan_tx.hpp"

#include <linux/can/error.h>
#include <linux/sock_diag.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

namespace semtrack::hal {

namespace {

constexpr int kNews = 6;         // error frames taken before a list
constexpr int kIdleTries = 2;    // tries of service() that move nothing
constexpr int kFirstNap_ms = 3;  // seven FD frames at 500k/2M
constexpr int kNapGrowth = 8;
constexpr int kLeastSendBuffer = 2048;  // below the kernel's own least: about six frames of either format

/// Both formats start alike; the size tells the kernel which one it is.
canfd_frame kernel_frame(const CanFrame& in) {
    canfd_frame out{};
    out.can_id = in.id | (in.extended ? CAN_EFF_FLAG : 0U);
    out.len = in.length;
    out.flags = in.fd ? CANFD_BRS : 0U;
    std::copy_n(in.data.begin(), in.length, out.data);
    return out;
}
static_assert(offsetof(canfd_frame, data) == offsetof(can_frame, data) && CAN_MTU < CANFD_MTU);

bool interface_is_gone(int error) {
    return error == -ENODEV || error == -ENXIO || error == -EBADF;
}

}  // namespace

CanOpen SocketCanTx::open(const char* interface, bool fd) noexcept {
    CanSocket::Options options;
    options.fd = fd;
    options.errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL;
    options.send_bytes = kLeastSendBuffer;
    const CanOpen result = socket_.open(interface, options);
    fd_ = fd;
    gone_ = result != CanOpen::kOk;
    down_ = bus_off_ = passive_ = false;
    clear_list();
    return result;
}

CanTx::Result SocketCanTx::begin_list(int frames, std::int64_t) noexcept {
    if (frames < 1 || frames > kMaxCanFrames) {
        return Result::kInvalidFrame;
    }
    if (!gone_) {
        take_news();
    }
    const bool off = (gone_ && !recover()) || bus_is_off();
    const Result result = off ? Result::kBusOff : finish_last_list();
    if (result != Result::kSent) {
        if (off) {
            give_up(false);
        }
        ++counters_.lists_refused;
        return result;
    }
    expected_ = frames;
    list_start_us_ = calls_.monotonic_us();
    stalled_ = false;
    return Result::kSent;
}

/// kSent: nothing is left of it, sent or given up.
CanTx::Result SocketCanTx::finish_last_list() noexcept {
    // One that has not begun is not worth more than its successor; one that waited too long would be stale.
    const bool worth = next_ > 0 && stored_ == expected_ && !down_ && !is_old();
    if (!worth || !advance()) {
        give_up(false);
    }
    return waiting() ? Result::kBusy : Result::kSent;
}

CanTx::Result SocketCanTx::send(const CanFrame& frame, std::int64_t time_us) noexcept {
    if (stored_ == expected_) {
        const Result begun = begin_list(1, time_us);
        if (begun != Result::kSent) {
            return begun;
        }
    }
    if (!is_legal(frame) || frame.fd != fd_) {
        give_up(true);
        return Result::kInvalidFrame;
    }
    list_[static_cast<std::size_t>(stored_++)] = frame;
    if (!stalled_ && !advance()) {
        give_up(true);
        return Result::kBusOff;
    }
    return Result::kSent;
}

bool SocketCanTx::service(int timeout_ms) noexcept {
    const std::int64_t end_us = calls_.monotonic_us() + std::int64_t{1000} * timeout_ms;
    int nap_ms = kFirstNap_ms;
    int idle = 0;
    while (waiting() && stored_ == expected_ && idle < kIdleTries) {  // each turn sends a frame or is idle
        const auto left_ms = static_cast<int>(std::max<std::int64_t>(end_us - calls_.monotonic_us(), 0) / 1000);
        const bool wakes = full_ && idle == 0;  // a full queue behind the socket does not wake poll()
        calls_.wait_writable(wakes ? socket_.fd() : -1, wakes ? left_ms : std::min(nap_ms, left_ms));
        const int before = next_;
        if (is_old() || !advance()) {
            give_up(false);
            break;
        }
        const bool moved = next_ != before;
        idle = moved ? 0 : idle + 1;
        nap_ms = moved ? kFirstNap_ms : nap_ms * kNapGrowth;
        if (left_ms <= 0) {
            break;
        }
    }
    return !waiting();
}

CanState SocketCanTx::state() const noexcept {
    return gone_ || down_ ? CanState::kDown
           : bus_off_     ? CanState::kBusOff
           : passive_     ? CanState::kErrorPassive
                          : CanState::kActive;
}

/// Writes what is stored, as far as the kernel takes it. False: the list cannot go on.
bool SocketCanTx::advance() noexcept {
    stalled_ = full_ = false;
    bool recovered = false;
    while (next_ < stored_ && !stalled_) {
        if (next_ > 0 && next_ + 1 == expected_ && !queue_is_empty()) {
            stalled_ = true;
            break;
        }
        switch (write(list_[static_cast<std::size_t>(next_)])) {
            case Written::kYes:
                ++next_;
                break;
            case Written::kLater:
                stalled_ = true;
                break;
            case Written::kGone:
                if (next_ > 0 || recovered || !recover()) {
                    return false;
                }
                recovered = true;
                break;
            case Written::kRefused:
                return false;
        }
    }
    if (expected_ > 0 && next_ == expected_) {
        ++counters_.lists_sent;
        clear_list();
    }
    return true;
}

SocketCanTx::Written SocketCanTx::write(const CanFrame& frame) noexcept {
    const canfd_frame data = kernel_frame(frame);
    const std::size_t size = frame.fd ? CANFD_MTU : CAN_MTU;
    const int written = calls_.write(socket_.fd(), &data, size);
    if (written == static_cast<int>(size)) {
        ++counters_.frames_sent;
        down_ = false;
        return Written::kYes;
    }
    if (written >= 0) {
        ++counters_.short_writes;
        return Written::kLater;
    }
    if (interface_is_gone(written)) {
        lose_interface();
        return Written::kGone;
    }
    switch (written) {
        case -EINTR:
            return Written::kLater;
        case -EAGAIN:
            ++counters_.busy;
            full_ = true;
            return Written::kLater;
        case -ENOBUFS:
        case -ENOMEM:
            ++counters_.no_buffers;
            return Written::kLater;
        case -ENETDOWN:
            go_down();
            return Written::kRefused;
        default:
            ++counters_.other_errors;
            down_ = true;  // as far as this list is concerned; EINVAL: the interface came back without CAN FD
            return Written::kRefused;
    }
}

/// Error frames, and what the kernel says of the interface.
void SocketCanTx::take_news() noexcept {
    for (int k = 0; k < kNews; ++k) {
        canfd_frame frame{};
        const int size = calls_.read(socket_.fd(), &frame, sizeof frame);
        if (interface_is_gone(size)) {
            lose_interface();
            return;
        }
        if (size == -ENETDOWN) {
            go_down();  // said once; the first frame of the list tells whether it is up again
        } else if (size >= static_cast<int>(CAN_MTU) && (frame.can_id & CAN_ERR_FLAG) != 0U) {
            take_error_frame(frame);
        } else if (size < static_cast<int>(CAN_MTU) && size != -EINTR) {
            return;
        }
    }
}

void SocketCanTx::take_error_frame(const canfd_frame& frame) noexcept {
    if ((frame.can_id & CAN_ERR_RESTARTED) != 0U) {
        bus_off_ = passive_ = false;
    }
    if ((frame.can_id & CAN_ERR_CRTL) != 0U) {
        constexpr unsigned kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
        constexpr unsigned kBetter = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_ACTIVE;
        const unsigned what = frame.data[1];
        if ((what & kPassive) != 0U) {
            counters_.error_passives += passive_ ? 0U : 1U;
            passive_ = true;
        } else if ((what & kBetter) != 0U) {
            passive_ = false;
            bus_off_ = bus_off_ && (what & CAN_ERR_CRTL_ACTIVE) == 0U;
        }
    }
    if ((frame.can_id & CAN_ERR_BUSOFF) != 0U) {
        go_bus_off();
    }
}

bool SocketCanTx::bus_is_off() noexcept {
    if (socket_.without_carrier()) {
        go_bus_off();
    } else if (bus_off_ && calls_.monotonic_us() - bus_off_us_ >= kBusOffPause_us) {
        bus_off_ = false;
    }
    return bus_off_;
}

bool SocketCanTx::recover() noexcept {
    if (socket_.reopen() != CanOpen::kOk) {
        return false;
    }
    ++counters_.reopened;
    gone_ = down_ = bus_off_ = passive_ = false;
    return true;
}

bool SocketCanTx::queue_is_empty() noexcept {
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    const int result =
        calls_.get_option(socket_.fd(), SOL_SOCKET, SO_MEMINFO, memory.data(), static_cast<socklen_t>(sizeof memory));
    return result < 0 || memory[SK_MEMINFO_WMEM_ALLOC] == 0U;
}

bool SocketCanTx::is_old() noexcept {
    return calls_.monotonic_us() - list_start_us_ > kListLifetime_us;
}

/// told: the caller hears of it by the result of this call.
void SocketCanTx::give_up(bool told) noexcept {
    if (expected_ == 0) {
        return;
    }
    ++(next_ > 0 ? counters_.lists_broken : told ? counters_.lists_refused : counters_.lists_unsent);
    lists_lost_ += told ? 0U : 1U;
    clear_list();
}

void SocketCanTx::clear_list() noexcept {
    expected_ = stored_ = next_ = 0;
}

void SocketCanTx::go_down() noexcept {
    counters_.downs += down_ ? 0U : 1U;
    down_ = true;
    bus_off_ = passive_ = false;
}

void SocketCanTx::lose_interface() noexcept {
    counters_.downs += gone_ || down_ ? 0U : 1U;
    gone_ = true;
    bus_off_ = passive_ = false;
}

void SocketCanTx::go_bus_off() noexcept {
    counters_.bus_offs += bus_off_ ? 0U : 1U;
    bus_off_ = true;
    bus_off_us_ = calls_.monotonic_us();
}

}  // namespace semtrack::hal
