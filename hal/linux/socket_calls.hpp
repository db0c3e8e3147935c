// The system calls that CAN sockets need, as a seam: tests play every errno through it. Each call returns what the
// system call returns, or -errno.
#ifndef SEMTRACK_HAL_LINUX_SOCKET_CALLS_HPP
#define SEMTRACK_HAL_LINUX_SOCKET_CALLS_HPP

#include <linux/can.h>
#include <net/if.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

namespace semtrack::hal {

class SocketCalls {
public:
    /// A non-blocking raw CAN socket.
    [[nodiscard]] virtual int open_can() noexcept = 0;
    virtual int close(int fd) noexcept = 0;
    [[nodiscard]] virtual int bind(int fd, const sockaddr_can& address) noexcept = 0;
    [[nodiscard]] virtual int set_option(int fd, int level, int name, const void* value, socklen_t size) noexcept = 0;
    [[nodiscard]] virtual int get_option(int fd, int level, int name, void* value, socklen_t size) noexcept = 0;
    /// ioctl() on an interface's name.
    [[nodiscard]] virtual int control(int fd, unsigned long request, ifreq& interface) noexcept = 0;
    [[nodiscard]] virtual int write(int fd, const void* data, std::size_t size) noexcept = 0;
    [[nodiscard]] virtual int read(int fd, void* data, std::size_t size) noexcept = 0;
    /// recvmsg(): a frame with its control messages.
    [[nodiscard]] virtual int receive(int fd, msghdr& message) noexcept = 0;
    /// poll() for POLLOUT; fd -1: sleeps.
    virtual int wait_writable(int fd, int timeout_ms) noexcept = 0;
    /// CLOCK_MONOTONIC and CLOCK_REALTIME.
    [[nodiscard]] virtual std::int64_t monotonic_us() noexcept = 0;
    [[nodiscard]] virtual std::int64_t realtime_us() noexcept = 0;

protected:
    ~SocketCalls() = default;
};

/// The kernel's.
class PosixCalls final : public SocketCalls {
public:
    [[nodiscard]] int open_can() noexcept override;
    int close(int fd) noexcept override;
    [[nodiscard]] int bind(int fd, const sockaddr_can& address) noexcept override;
    [[nodiscard]] int set_option(int fd, int level, int name, const void* value, socklen_t size) noexcept override;
    [[nodiscard]] int get_option(int fd, int level, int name, void* value, socklen_t size) noexcept override;
    [[nodiscard]] int control(int fd, unsigned long request, ifreq& interface) noexcept override;
    [[nodiscard]] int write(int fd, const void* data, std::size_t size) noexcept override;
    [[nodiscard]] int read(int fd, void* data, std::size_t size) noexcept override;
    [[nodiscard]] int receive(int fd, msghdr& message) noexcept override;
    int wait_writable(int fd, int timeout_ms) noexcept override;
    [[nodiscard]] std::int64_t monotonic_us() noexcept override;
    [[nodiscard]] std::int64_t realtime_us() noexcept override;
};

}  // namespace semtrack::hal

#endif
