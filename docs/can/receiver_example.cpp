// A receiving ECU in a few lines: reads a candump log and prints every whole object list.
//   receiver_example fd|classic can.log
// Links semtrack::receiver alone. Not for the ECU: stdio and the log's parser; there a driver's FIFO gives the frames.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "semtrack/can_receiver.hpp"

namespace {

// [receiver]
semtrack::CanReceiver receiver;      // 1.2 KB, static
semtrack::ReceivedList object_list;  // 10.4 KB, static

void use(const semtrack::ReceivedList& list) {
    for (const semtrack::ReceivedObject& o : list.objects) {
        const bool measured = o.status.valid && o.status.value == semtrack::TrackStatus::kMeasured;
        std::printf("  id %u%s x %.2f y %.2f", static_cast<unsigned>(o.id), measured ? "" : " (not measured)",
                    o.x.value, o.y.value);
        if (o.velocity_x.valid && o.velocity_y.valid) {
            std::printf(" vx %.2f vy %.2f", o.velocity_x.value, o.velocity_y.value);
        }
        if (o.yaw.valid) {
            std::printf(" yaw %.3f", o.yaw.value);
        }
        std::printf("%s\n", o.saturated ? " (a value is out of range)" : "");
    }
}

/// Called for every received frame, in the order of reception; now_us: the ECU's own clock.
void on_frame(const semtrack::CanFrame& frame, std::int64_t now_us) {
    if (receiver.take(frame, now_us, object_list) != semtrack::FrameResult::kListComplete) {
        return;  // not whole yet, refused, or somebody else's
    }
    std::printf("list %u, image %lld us, taken at %lld us of our clock, %d objects\n",
                static_cast<unsigned>(object_list.list_counter), static_cast<long long>(object_list.image_time_us),
                static_cast<long long>(object_list.taken_us.value), object_list.objects.size());
    if (semtrack::bring_to_time(now_us, object_list) == semtrack::Status::kOk) {
        use(object_list);  // now in the vehicle frame of now_us
    }
}

/// Called once a cycle, with or without frames.
void on_cycle(std::int64_t now_us) {
    if (receiver.timed_out(now_us)) {
        std::printf("no object list: do without it\n");
    }
}
// [receiver]

int hex_digit(char c) {
    const char* const digits = "0123456789ABCDEF";
    const char* const at = c == '\0' ? nullptr : std::strchr(digits, c);
    return at == nullptr ? -1 : static_cast<int>(at - digits);
}

/// `(SECONDS.MICROSECONDS) can0 ID#DATA` or `ID##1DATA`.
bool parse(const char* line, semtrack::CanFrame& frame, std::int64_t& time_us) {
    long long seconds = 0;
    long long microseconds = 0;
    unsigned id = 0;
    int digits = 0;
    int end = 0;
    int start = 0;
    if (std::sscanf(line, "(%lld.%lld) %*s %n%x%n#", &seconds, &microseconds, &start, &id, &end) != 3) {
        return false;
    }
    frame = semtrack::CanFrame{};
    frame.id = id;
    digits = end - start;
    frame.extended = digits == 8;
    frame.fd = line[end + 1] == '#';
    const char* data = line + end + (frame.fd ? 3 : 1);
    for (; frame.length < 64 && hex_digit(data[0]) >= 0 && hex_digit(data[1]) >= 0; data += 2) {
        frame.data[frame.length++] = static_cast<std::uint8_t>(16 * hex_digit(data[0]) + hex_digit(data[1]));
    }
    time_us = 1000000 * seconds + microseconds;
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    // [set-up]
    semtrack::CanReceiverConfig config;  // base id 0x600, time-out 300 ms
    config.can.dialect =
        argc > 1 && std::strcmp(argv[1], "classic") == 0 ? semtrack::CanDialect::kClassic : semtrack::CanDialect::kFd;
    if (receiver.init(config) != semtrack::Status::kOk) {
        return 1;
    }
    // [set-up]
    std::FILE* const log = argc > 2 ? std::fopen(argv[2], "r") : nullptr;
    if (log == nullptr) {
        return 2;
    }
    char line[256];
    std::int64_t now_us = 0;
    while (std::fgets(line, sizeof line, log) != nullptr) {
        semtrack::CanFrame frame;
        if (parse(line, frame, now_us)) {
            on_frame(frame, now_us);
        }
    }
    (void)std::fclose(log);
    on_cycle(now_us);
    on_cycle(now_us + config.timeout_us + 1);
    return 0;
}
