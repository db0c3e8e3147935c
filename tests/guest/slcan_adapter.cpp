// Plays a serial CAN adapter for the kernel's slcan driver on a pseudo-terminal. It makes what neither vcan nor
// emulated controllers do: a transmit queue that stays full, error-passive, bus-off.
//
// usage: slcan_adapter NAME_FILE LOG    NAME_FILE gets the interface's name once it is up; LOG a line ID#DATA for every
// frame that reached the adapter. Commands on stdin, one a line: passive, busoff, active, stall, resume, down, up,
// quit.
#include <fcntl.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

constexpr int kSlcanDiscipline = 17;  // N_SLCAN

void need(bool ok, const char* what) {
    if (!ok) {
        throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
    }
}

class Adapter {
public:
    explicit Adapter(const char* log) : log_(log) {
        master_ = posix_openpt(O_RDWR | O_NOCTTY);
        need(master_ >= 0 && grantpt(master_) == 0 && unlockpt(master_) == 0, "pseudo-terminal");
        slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
        termios settings{};
        need(slave_ >= 0 && tcgetattr(slave_, &settings) == 0, "its other end");
        cfmakeraw(&settings);
        need(tcsetattr(slave_, TCSANOW, &settings) == 0, "raw mode");
        const int discipline = kSlcanDiscipline;
        need(ioctl(slave_, TIOCSETD, &discipline) == 0, "line discipline slcan");
        need(ioctl(slave_, SIOCGIFNAME, name_) == 0, "interface name");
        set_up(true);
    }
    [[nodiscard]] const char* name() const { return name_; }
    [[nodiscard]] int fd() const { return master_; }
    [[nodiscard]] bool reads() const { return reads_; }

    /// false: the end.
    bool obey(const std::string& command) {
        if (command == "passive") {
            say("sp100130\r");
        } else if (command == "busoff") {
            say("sb000255\r");
        } else if (command == "active") {
            say("sa000000\r");
        } else if (command == "stall" || command == "resume") {
            reads_ = command == "resume";
        } else if (command == "down" || command == "up") {
            set_up(command == "up");
        } else {
            return false;
        }
        return true;
    }

    void take() {
        char buffer[512];
        const ssize_t n = read(master_, buffer, sizeof buffer);
        for (ssize_t i = 0; i < n; ++i) {
            if (buffer[i] != '\r') {
                line_ += buffer[i];
                continue;
            }
            const std::size_t id = line_.empty() ? 0U : line_[0] == 't' ? 3U : line_[0] == 'T' ? 8U : 0U;
            if (id != 0U && line_.size() >= id + 2U) {
                log_ << line_.substr(1, id) << '#' << line_.substr(id + 2U) << '\n' << std::flush;
            }
            line_.clear();
        }
    }

private:
    void say(const char* text) { need(write(master_, text, std::strlen(text)) > 0, "write"); }
    void set_up(bool up) {
        const int s = socket(AF_INET, SOCK_DGRAM, 0);
        ifreq request{};
        (void)std::snprintf(request.ifr_name, sizeof request.ifr_name, "%s", name_);
        need(s >= 0 && ioctl(s, SIOCGIFFLAGS, &request) == 0, "flags");
        request.ifr_flags = static_cast<short>(up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP);
        need(ioctl(s, SIOCSIFFLAGS, &request) == 0, "up or down");
        close(s);
    }

    std::ofstream log_;
    int master_{-1};
    int slave_{-1};
    char name_[IFNAMSIZ]{};
    bool reads_{true};
    std::string line_;
};

int play(const char* name_file, const char* log) {
    Adapter adapter(log);
    std::ofstream(name_file) << adapter.name() << '\n';
    std::string commands;
    for (;;) {
        pollfd ends[2] = {{STDIN_FILENO, POLLIN, 0}, {adapter.reads() ? adapter.fd() : -1, POLLIN, 0}};
        need(poll(ends, 2, -1) > 0, "poll");
        if ((ends[1].revents & POLLIN) != 0) {
            adapter.take();
        }
        if (ends[0].revents == 0) {
            continue;
        }
        char buffer[128];
        const ssize_t n = read(STDIN_FILENO, buffer, sizeof buffer);
        if (n <= 0) {
            return 0;
        }
        commands.append(buffer, static_cast<std::size_t>(n));
        for (std::size_t end = commands.find('\n'); end != std::string::npos; end = commands.find('\n')) {
            if (!adapter.obey(commands.substr(0, end))) {
                return 0;
            }
            commands.erase(0, end + 1U);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        (void)std::fputs("usage: slcan_adapter NAME_FILE LOG\n", stderr);
        return 2;
    }
    try {
        return play(argv[1], argv[2]);
    } catch (const std::exception& error) {
        (void)std::fprintf(stderr, "slcan_adapter: %s\n", error.what());
        return 1;
    }
}
