// A kernel with one CAN interface behind the seam: a queue that drains in time, errors on demand, time that passes only
// while somebody waits.
#ifndef SEMTRACK_TESTS_HAL_LINUX_FAKE_KERNEL_HPP
#define SEMTRACK_TESTS_HAL_LINUX_FAKE_KERNEL_HPP

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <linux/sockios.h>
#include <sys/time.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include "hal/linux/socket_calls.hpp"
#include "semtrack/can_frame.hpp"

namespace semtrack::hal::test {

struct Arrival {
    canfd_frame frame{};
    int size{0};  ///< negative: -errno
    std::int64_t stamp_us{-1};
};

class FakeKernel final : public SocketCalls {
public:
    // The interface.
    bool exists{true};
    int index{7};
    int mtu{CANFD_MTU};
    bool up{true};
    bool carrier{true};
    int room{6};               ///< frames that the socket holds
    std::int64_t frame_us{0};  ///< on the bus; 0: at once
    bool stuck{false};         ///< nobody acknowledges
    // The next results of single calls; 0: as the interface is.
    std::deque<int> writes{};
    int open_error{0};
    int bind_error{0};
    int option_error{0};
    // What happened.
    std::vector<canfd_frame> sent{};
    std::vector<int> sizes{};
    std::vector<std::string> options{};
    can_filter filter{};
    socklen_t filter_size{99};
    int calls{0};
    int opened{0};
    int closed{0};
    std::deque<Arrival> arrivals{};
    std::int64_t now_us{1000000};
    std::int64_t realtime_ahead_us{1700000000000000};

    void error_frame(std::uint32_t what, std::uint8_t controller = 0) {
        Arrival a;
        a.frame.can_id = CAN_ERR_FLAG | what;
        a.frame.len = CAN_ERR_DLC;
        a.frame.data[1] = controller;
        a.size = CAN_MTU;
        arrivals.push_back(a);
    }
    void news(int error) {
        Arrival a;
        a.size = error;
        arrivals.push_back(a);
    }
    void vanish() {
        exists = false;
        bound_ = 0;
        queued_ = 0;
        news(-ENODEV);
    }
    void come_back(int as) {
        exists = true;
        index = as;
    }
    void go_down() {
        up = false;
        queued_ = 0;
        news(-ENETDOWN);
    }

    int open_can() noexcept override {
        ++calls;
        if (open_error != 0) {
            return open_error;
        }
        ++opened;
        bound_ = 0;
        return 3;
    }
    int close(int) noexcept override {
        ++calls;
        ++closed;
        return 0;
    }
    int bind(int, const sockaddr_can& address) noexcept override {
        ++calls;
        if (bind_error != 0) {
            return bind_error;
        }
        if (!exists || address.can_ifindex != index) {
            return -ENODEV;
        }
        bound_ = address.can_ifindex;
        return 0;
    }
    int set_option(int, int level, int name, const void* value, socklen_t size) noexcept override {
        ++calls;
        options.push_back(std::to_string(level) + ":" + std::to_string(name));
        if (level == SOL_CAN_RAW && name == CAN_RAW_FILTER) {
            filter_size = size;
            if (size == sizeof filter) {
                std::memcpy(&filter, value, sizeof filter);
            }
        }
        return option_error;
    }
    int get_option(int, int, int name, void* value, socklen_t size) noexcept override {
        ++calls;
        drain();
        if (name != SO_MEMINFO || size < sizeof(std::uint32_t) * SK_MEMINFO_VARS) {
            return -ENOPROTOOPT;
        }
        auto* const memory = static_cast<std::uint32_t*>(value);
        memory[SK_MEMINFO_WMEM_ALLOC] = 768U * static_cast<std::uint32_t>(queued_);
        return 0;
    }
    int control(int, unsigned long request, ifreq& interface) noexcept override {
        ++calls;
        if (!exists || std::string(interface.ifr_name) != "can0") {
            return -ENODEV;
        }
        if (request == SIOCGIFINDEX) {
            interface.ifr_ifindex = index;
        } else if (request == SIOCGIFMTU) {
            interface.ifr_mtu = mtu;
        } else {
            interface.ifr_flags = static_cast<short>((up ? IFF_UP : 0) | (up && carrier ? IFF_RUNNING : 0));
        }
        return 0;
    }
    int write(int, const void* data, std::size_t size) noexcept override {
        ++calls;
        drain();
        if (!writes.empty()) {
            const int result = writes.front();
            writes.pop_front();
            if (result != 0) {
                return result;
            }
        }
        if (bound_ == 0 || bound_ != index || !exists) {
            return -ENXIO;
        }
        if (!up) {
            return -ENETDOWN;
        }
        if (size > static_cast<std::size_t>(mtu)) {
            return -EINVAL;
        }
        if (queued_ >= room) {
            return -EAGAIN;
        }
        queued_ += frame_us > 0 || stuck ? 1 : 0;
        canfd_frame frame{};
        std::memcpy(&frame, data, std::min(size, sizeof frame));
        sent.push_back(frame);
        sizes.push_back(static_cast<int>(size));
        return static_cast<int>(size);
    }
    int read(int, void* data, std::size_t) noexcept override {
        ++calls;
        Arrival a;
        if (!next(a)) {
            return -EAGAIN;
        }
        if (a.size > 0) {
            std::memcpy(data, &a.frame, static_cast<std::size_t>(a.size));
        }
        return a.size;
    }
    int receive(int, msghdr& message) noexcept override {
        ++calls;
        Arrival a;
        if (!next(a)) {
            return -EAGAIN;
        }
        if (a.size > 0) {
            std::memcpy(message.msg_iov->iov_base, &a.frame, static_cast<std::size_t>(a.size));
        }
        if (a.stamp_us < 0) {
            message.msg_controllen = 0;
            return a.size;
        }
        cmsghdr* const control = CMSG_FIRSTHDR(&message);
        control->cmsg_level = SOL_SOCKET;
        control->cmsg_type = SO_TIMESTAMP;
        control->cmsg_len = CMSG_LEN(sizeof(timeval));
        const timeval time{a.stamp_us / 1000000, a.stamp_us % 1000000};
        std::memcpy(CMSG_DATA(control), &time, sizeof time);
        message.msg_controllen = CMSG_SPACE(sizeof(timeval));
        return a.size;
    }
    int wait_writable(int fd, int timeout_ms) noexcept override {
        ++calls;
        const std::int64_t end = now_us + std::int64_t{1000} * timeout_ms;
        drain();
        while (now_us < end && !(fd >= 0 && 2 * queued_ < room)) {
            now_us += 100;
            drain();
        }
        return 0;
    }
    std::int64_t monotonic_us() noexcept override { return now_us; }
    std::int64_t realtime_us() noexcept override { return now_us + realtime_ahead_us; }

private:
    bool next(Arrival& a) {
        if (arrivals.empty()) {
            return false;
        }
        a = arrivals.front();
        arrivals.pop_front();
        return true;
    }
    void drain() {
        while (queued_ > 0 && frame_us > 0 && !stuck && now_us >= drained_us_ + frame_us) {
            --queued_;
            drained_us_ += frame_us;
        }
        if (queued_ == 0) {
            drained_us_ = now_us;
        }
    }

    int bound_{0};
    int queued_{0};
    std::int64_t drained_us_{0};
};

}  // namespace semtrack::hal::test

#endif
