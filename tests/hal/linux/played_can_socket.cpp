// A preloaded library that plays a CAN socket for one process: there is an interface "can0", and the environment says
// what its calls return. Every frame that it takes, and the number of calls around it, go to a log.
//
// PLAYED_CAN_LOG   file: one row a call, `write RESULT SIZE HEX...` or `call NAME`.
// PLAYED_CAN_PLAN  words in the order of the writes: `ok*N`, `EAGAIN*N`, `ENOBUFS*N`, `ENETDOWN*N`, `short*N`, or in
//                  seconds since the plan got there: `ENETDOWN@3`. `busoff`: the next read is that error frame. After
//                  the last word everything is good.
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

int g_can = -1;  // the played socket; underneath it is /dev/null
bool g_bus_off = false;

template <class F>
F* real(const char* name) {
    return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

void log_row(const char* text) {
    static std::FILE* const file = std::fopen(std::getenv("PLAYED_CAN_LOG"), "w");
    if (file != nullptr) {
        (void)std::fputs(text, file);
        (void)std::fflush(file);
    }
}

void log_call(const char* name) {
    char row[64];
    (void)std::snprintf(row, sizeof row, "call %s\n", name);
    log_row(row);
}

double now_s() {
    timespec t{};
    (void)::clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// 0: good; -1: a short write; else errno.
int error_of(const char* word) {
    struct Name {
        const char* name;
        int error;
    };
    constexpr Name kNames[] = {{"ok", 0},          {"EAGAIN", EAGAIN}, {"ENOBUFS", ENOBUFS}, {"ENETDOWN", ENETDOWN},
                               {"ENODEV", ENODEV}, {"EINVAL", EINVAL}, {"short", -1}};
    for (const Name& n : kNames) {
        if (std::strncmp(word, n.name, std::strlen(n.name)) == 0) {
            return n.error;
        }
    }
    return 0;
}

int next_error() {
    static const char* plan = std::getenv("PLAYED_CAN_PLAN");
    static long left = -1;        // of the current word; -1: not begun
    static double until_s = 0.0;  // of the current word, if it counts seconds
    while (plan != nullptr && *plan != '\0') {
        if (*plan == ' ') {
            ++plan;
            continue;
        }
        if (std::strncmp(plan, "busoff", 6) == 0) {
            g_bus_off = true;
            plan += 6;
            continue;
        }
        const char* const number = std::strpbrk(plan, "*@");
        if (left < 0) {
            left = *number == '*' ? std::atol(number + 1) : 0;
            until_s = *number == '@' ? now_s() + std::atof(number + 1) : 0.0;
        }
        if (left > 0 || now_s() < until_s) {
            --left;
            left = left < 0 ? 0 : left;
            return error_of(plan);
        }
        left = -1;
        plan = std::strchr(plan, ' ');
    }
    return 0;
}

}  // namespace

extern "C" {

int socket(int domain, int type, int protocol) {
    if (domain != PF_CAN) {
        return real<int(int, int, int)>("socket")(domain, type, protocol);
    }
    g_can = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    log_call("socket");
    return g_can;
}

int bind(int fd, const sockaddr* address, socklen_t size) {
    if (fd != g_can) {
        return real<int(int, const sockaddr*, socklen_t)>("bind")(fd, address, size);
    }
    log_call("bind");
    return 0;
}

int setsockopt(int fd, int level, int name, const void* value, socklen_t size) {
    if (fd != g_can) {
        return real<int(int, int, int, const void*, socklen_t)>("setsockopt")(fd, level, name, value, size);
    }
    log_call("setsockopt");
    return 0;
}

int getsockopt(int fd, int level, int name, void* value, socklen_t* size) {
    if (fd != g_can) {
        return real<int(int, int, int, void*, socklen_t*)>("getsockopt")(fd, level, name, value, size);
    }
    log_call("getsockopt");
    std::memset(value, 0, *size);
    return 0;
}

int ioctl(int fd, unsigned long request, ...) {
    va_list arguments;
    va_start(arguments, request);
    void* const data = va_arg(arguments, void*);
    va_end(arguments);
    if (fd != g_can || fd < 0) {
        return real<int(int, unsigned long, void*)>("ioctl")(fd, request, data);
    }
    log_call("ioctl");
    auto* const interface = static_cast<ifreq*>(data);
    if (std::strcmp(interface->ifr_name, "can0") != 0) {
        errno = ENODEV;
        return -1;
    }
    if (request == SIOCGIFINDEX) {
        interface->ifr_ifindex = 3;
    } else if (request == SIOCGIFMTU) {
        interface->ifr_mtu = std::getenv("PLAYED_CAN_CLASSIC") != nullptr ? CAN_MTU : CANFD_MTU;
    } else if (request == SIOCGIFFLAGS) {
        interface->ifr_flags = IFF_UP | IFF_RUNNING;
    }
    return 0;
}

ssize_t write(int fd, const void* data, size_t size) {
    if (fd != g_can || fd < 0) {
        return real<ssize_t(int, const void*, size_t)>("write")(fd, data, size);
    }
    const int error = next_error();
    char row[256];
    int n = std::snprintf(row, sizeof row, "write %d %zu ", error, size);
    for (size_t k = 0; k < size && n + 3 < static_cast<int>(sizeof row); ++k) {
        n += std::snprintf(row + n, sizeof row - static_cast<size_t>(n), "%02X",
                           static_cast<const unsigned char*>(data)[k]);
    }
    row[n++] = '\n';
    row[n] = '\0';
    log_row(row);
    if (error > 0) {
        errno = error;
        return -1;
    }
    return static_cast<ssize_t>(error < 0 ? size / 2 : size);
}

ssize_t read(int fd, void* data, size_t size) {
    if (fd != g_can || fd < 0) {
        return real<ssize_t(int, void*, size_t)>("read")(fd, data, size);
    }
    log_call("read");
    if (!g_bus_off) {
        errno = EAGAIN;
        return -1;
    }
    g_bus_off = false;
    can_frame frame{};
    frame.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
    frame.len = CAN_ERR_DLC;
    std::memcpy(data, &frame, sizeof frame);
    return sizeof frame;
}

int poll(pollfd* fds, nfds_t count, int timeout) {
    if (count == 1 && g_can >= 0 && (fds[0].fd == g_can || fds[0].fd < 0)) {
        log_call("poll");
        if (fds[0].fd == g_can) {
            fds[0].revents = POLLOUT | POLLERR;  // as the kernel does after ENOBUFS and ENETDOWN: ready at once
            return 1;
        }
    }
    return real<int(pollfd*, nfds_t, int)>("poll")(fds, count, timeout);
}

int close(int fd) {
    if (fd == g_can && fd >= 0) {
        log_call("close");
        g_can = -1;
    }
    return real<int(int)>("close")(fd);
}

}  // extern "C"
