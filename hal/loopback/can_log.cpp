#include "hal/loopback/can_log.hpp"

namespace semtrack::hal {

namespace {

constexpr std::int64_t kMicroseconds = 1000000;
constexpr int kSecondsDigits = 10;  // as candump pads them
constexpr int kMaxInterface = 16;

struct LineBuilder {
    CanLogLine& line;
    std::size_t size{0};

    void put(char c) { line[size++] = c; }
    void number(std::uint64_t value, int least_digits) {
        std::array<char, 20> digits{};
        int count = 0;
        while (value != 0U || count < least_digits) {
            digits[static_cast<std::size_t>(count++)] = static_cast<char>('0' + value % 10U);
            value /= 10U;
        }
        while (count > 0) {
            put(digits[static_cast<std::size_t>(--count)]);
        }
    }
    void hexadecimal(std::uint32_t value, int digits) {
        for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
            put("0123456789ABCDEF"[(value >> static_cast<unsigned>(shift)) & 0xFU]);
        }
    }
    void time(std::int64_t time_us) {
        put('(');
        const bool negative = time_us < 0;
        if (negative) {
            put('-');
        }
        const std::uint64_t all =
            negative ? ~static_cast<std::uint64_t>(time_us) + 1U : static_cast<std::uint64_t>(time_us);
        number(all / kMicroseconds, kSecondsDigits);
        put('.');
        number(all % kMicroseconds, 6);
        put(')');
    }
};

}  // namespace

std::size_t can_log_line(const CanFrame& frame, std::int64_t time_us, const char* interface, CanLogLine& line) {
    if (!is_legal(frame)) {
        return 0;
    }
    LineBuilder b{line};
    b.time(time_us);
    b.put(' ');
    for (int i = 0; i < kMaxInterface && interface[i] != '\0'; ++i) {
        b.put(interface[i]);
    }
    b.put(' ');
    b.hexadecimal(frame.id, frame.extended ? 8 : 3);
    b.put('#');
    if (frame.fd) {
        b.put('#');
        b.put('1');
    }
    for (int i = 0; i < frame.length; ++i) {
        b.hexadecimal(frame.data[static_cast<std::size_t>(i)], 2);
    }
    b.put('\n');
    return b.size;
}

CanTx::Result CanLog::send(const CanFrame& frame, std::int64_t time_us) noexcept {
    const std::size_t size = can_log_line(frame, time_us, interface_, line_);
    if (size == 0U) {
        return Result::kInvalidFrame;
    }
    if (failed_ || std::fwrite(line_.data(), 1, size, file_) != size) {
        failed_ = true;
        return Result::kBusOff;
    }
    return Result::kSent;
}

}  // namespace semtrack::hal
