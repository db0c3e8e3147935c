#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

#include "hal/linux/socket_calls.hpp"

namespace semtrack::hal {

namespace {

int result(long value) {
    return value < 0 ? -errno : static_cast<int>(value);
}

std::int64_t time_us(clockid_t clock) {
    timespec t{};
    (void)::clock_gettime(clock, &t);
    return std::int64_t{t.tv_sec} * 1000000 + t.tv_nsec / 1000;
}

}  // namespace

int PosixCalls::open_can() noexcept {
    return result(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
}

int PosixCalls::close(int fd) noexcept {
    return result(::close(fd));
}

int PosixCalls::bind(int fd, const sockaddr_can& address) noexcept {
    // MISRA deviation D-06: bind() takes every family's address as a sockaddr*.
    return result(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address));
}

int PosixCalls::set_option(int fd, int level, int name, const void* value, socklen_t size) noexcept {
    return result(::setsockopt(fd, level, name, value, size));
}

int PosixCalls::get_option(int fd, int level, int name, void* value, socklen_t size) noexcept {
    return result(::getsockopt(fd, level, name, value, &size));
}

int PosixCalls::control(int fd, unsigned long request, ifreq& interface) noexcept {
    return result(::ioctl(fd, request, &interface));
}

int PosixCalls::write(int fd, const void* data, std::size_t size) noexcept {
    return result(::write(fd, data, size));
}

int PosixCalls::read(int fd, void* data, std::size_t size) noexcept {
    return result(::read(fd, data, size));
}

int PosixCalls::receive(int fd, msghdr& message) noexcept {
    return result(::recvmsg(fd, &message, MSG_DONTWAIT));
}

int PosixCalls::wait_writable(int fd, int timeout_ms) noexcept {
    pollfd entry{fd, POLLOUT, 0};  // poll() passes over a negative fd
    return result(::poll(&entry, 1, timeout_ms));
}

std::int64_t PosixCalls::monotonic_us() noexcept {
    return time_us(CLOCK_MONOTONIC);
}

std::int64_t PosixCalls::realtime_us() noexcept {
    return time_us(CLOCK_REALTIME);
}

}  // namespace semtrack::hal
