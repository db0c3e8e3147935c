// A CAN_RAW socket bound to one interface by name; it can be bound anew after the interface was gone. No heap.
#ifndef SEMTRACK_HAL_LINUX_CAN_SOCKET_HPP
#define SEMTRACK_HAL_LINUX_CAN_SOCKET_HPP

#include <array>

#include "hal/linux/socket_calls.hpp"

namespace semtrack::hal {

/// No opening ends in any other way.
enum class CanOpen : std::uint8_t {
    kOk = 0,
    kBadName,      ///< empty, or longer than 15 characters
    kNoSocketCan,  ///< the kernel has no AF_CAN
    kNotAllowed,
    kNoInterface,  ///< no interface of this name, or none of CAN
    kClassicOnly,  ///< CAN FD is asked for, and the interface's mtu is 16
    kFailed        ///< any other error of the kernel
};
/// One line for a person.
[[nodiscard]] const char* text(CanOpen result);

class CanSocket {
public:
    static constexpr std::int64_t kLookPause_us = 500000;
    struct Options {
        bool fd{true};         ///< CAN FD frames as well
        bool receives{false};  ///< `filter` is set; false: no data frames come in
        can_filter filter{};
        can_err_mask_t errors{0};  ///< error frames that come in
        int send_bytes{0};         ///< SO_SNDBUF; 0: the system's
        bool stamps{false};        ///< the kernel's time of reception
    };
    explicit CanSocket(SocketCalls& calls) : calls_(calls) {}
    ~CanSocket() { close(); }
    CanSocket(const CanSocket&) = delete;
    CanSocket& operator=(const CanSocket&) = delete;

    /// At most nine system calls. The interface may be down. An open socket is closed first.
    [[nodiscard]] CanOpen open(const char* interface, const Options& options) noexcept;
    /// As before, when the interface is there (one call when it is not). It is looked for twice a second at most: for a
    /// process with CAP_NET_ADMIN the kernel runs modprobe at each look at a name that it does not know.
    [[nodiscard]] CanOpen reopen() noexcept;
    void close() noexcept;
    [[nodiscard]] int fd() const { return fd_; }

    /// Up, but without carrier: a controller that left the bus.
    [[nodiscard]] bool without_carrier() noexcept;

private:
    [[nodiscard]] int control(unsigned long request, ifreq& request_data) noexcept;
    [[nodiscard]] CanOpen look_and_open() noexcept;
    [[nodiscard]] CanOpen open_now() noexcept;
    [[nodiscard]] bool configure() noexcept;

    SocketCalls& calls_;
    std::array<char, IFNAMSIZ> name_{};
    Options options_{};
    int fd_{-1};
    bool missed_{false};  // the last look found nothing
    std::int64_t missed_us_{0};
};

}  // namespace semtrack::hal

#endif
