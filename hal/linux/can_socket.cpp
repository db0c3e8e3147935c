#include "hal/linux/can_socket.hpp"

#include <linux/can/raw.h>
#include <linux/sockios.h>

#include <cerrno>

namespace semtrack::hal {

namespace {

CanOpen open_result(int error) {
    switch (error) {
        case -EAFNOSUPPORT:
        case -EPROTONOSUPPORT:
        case -ESOCKTNOSUPPORT:
            return CanOpen::kNoSocketCan;
        case -EPERM:
        case -EACCES:
            return CanOpen::kNotAllowed;
        case -ENODEV:
        case -ENXIO:
            return CanOpen::kNoInterface;
        default:
            return CanOpen::kFailed;
    }
}

}  // namespace

const char* text(CanOpen result) {
    switch (result) {
        case CanOpen::kOk:
            return "open";
        case CanOpen::kBadName:
            return "the name of an interface has 1 to 15 characters";
        case CanOpen::kNoSocketCan:
            return "this kernel has no SocketCAN";
        case CanOpen::kNotAllowed:
            return "not allowed";
        case CanOpen::kNoInterface:
            return "no such CAN interface";
        case CanOpen::kClassicOnly:
            return "the interface carries classic CAN only (mtu 16)";
        case CanOpen::kFailed:
            break;
    }
    return "cannot be opened";
}

CanOpen CanSocket::open(const char* interface, const Options& options) noexcept {
    close();
    name_ = {};
    options_ = options;
    missed_ = false;
    for (std::size_t i = 0; interface[i] != '\0'; ++i) {
        if (i + 1 >= name_.size()) {
            name_ = {};
            return CanOpen::kBadName;
        }
        name_[i] = interface[i];
    }
    return name_[0] == '\0' ? CanOpen::kBadName : open_now();
}

CanOpen CanSocket::reopen() noexcept {
    const std::int64_t now_us = calls_.monotonic_us();
    if (missed_ && now_us - missed_us_ < kLookPause_us) {
        return CanOpen::kNoInterface;
    }
    const CanOpen result = look_and_open();
    missed_ = result != CanOpen::kOk;
    missed_us_ = now_us;
    return result;
}

CanOpen CanSocket::look_and_open() noexcept {
    ifreq request{};
    if (fd_ >= 0) {
        const int found = control(SIOCGIFINDEX, request);
        if (found < 0) {
            return open_result(found);
        }
    }
    close();
    return name_[0] == '\0' ? CanOpen::kBadName : open_now();
}

void CanSocket::close() noexcept {
    if (fd_ >= 0) {
        (void)calls_.close(fd_);
    }
    fd_ = -1;
}

int CanSocket::control(unsigned long request, ifreq& request_data) noexcept {
    request_data = ifreq{};
    for (std::size_t i = 0; i < name_.size(); ++i) {
        request_data.ifr_name[i] = name_[i];
    }
    return calls_.control(fd_, request, request_data);
}

CanOpen CanSocket::open_now() noexcept {
    const int opened = calls_.open_can();
    if (opened < 0) {
        return open_result(opened);
    }
    fd_ = opened;
    ifreq request{};
    sockaddr_can address{};
    CanOpen result = CanOpen::kOk;
    int error = control(SIOCGIFINDEX, request);
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    if (error < 0) {
        result = open_result(error);
    } else if (options_.fd && control(SIOCGIFMTU, request) >= 0 && request.ifr_mtu == CAN_MTU) {
        result = CanOpen::kClassicOnly;
    } else if (!configure()) {
        result = CanOpen::kFailed;
    } else {
        error = calls_.bind(fd_, address);
        result = error < 0 ? open_result(error) : CanOpen::kOk;
    }
    if (result != CanOpen::kOk) {
        close();
    }
    return result;
}

bool CanSocket::configure() noexcept {
    const auto set = [this](int level, int name, const void* value, socklen_t size) {
        return calls_.set_option(fd_, level, name, value, size) >= 0;
    };
    const int yes = 1;
    const auto filter_size = static_cast<socklen_t>(options_.receives ? sizeof options_.filter : 0U);
    bool ok = set(SOL_CAN_RAW, CAN_RAW_FILTER, options_.receives ? &options_.filter : nullptr, filter_size);
    ok = ok && set(SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &options_.errors, sizeof options_.errors);
    ok = ok && (!options_.fd || set(SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &yes, sizeof yes));
    ok = ok &&
         (options_.send_bytes == 0 || set(SOL_SOCKET, SO_SNDBUF, &options_.send_bytes, sizeof options_.send_bytes));
    return ok && (!options_.stamps || set(SOL_SOCKET, SO_TIMESTAMP, &yes, sizeof yes));
}

bool CanSocket::without_carrier() noexcept {
    ifreq request{};
    const int result = control(SIOCGIFFLAGS, request);
    const auto flags = static_cast<unsigned>(request.ifr_flags);
    return result >= 0 && (flags & IFF_UP) != 0U && (flags & IFF_RUNNING) == 0U;
}

}  // namespace semtrack::hal
