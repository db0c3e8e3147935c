#include "board/run_scene.hpp"

#include <cstring>

#include "board/scene_source.hpp"
#include "semtrack/cycle.hpp"

namespace semtrack::board {

namespace {

class HashingBus final : public CanTx {
public:
    Result send(const CanFrame& frame, std::int64_t) noexcept override {
        for (unsigned shift = 0; shift < 32U; shift += 8U) {
            add(static_cast<std::uint8_t>(frame.id >> shift));
        }
        add(frame.length);
        for (std::size_t i = 0; i < frame.length; ++i) {
            add(frame.data[i]);
        }
        ++frames_;
        return Result::kSent;
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_; }
    [[nodiscard]] int frames() const { return frames_; }

private:
    void add(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 1099511628211ULL; }

    std::uint64_t hash_{14695981039346656037ULL};
    int frames_{0};
};

/// As an ECU places them: megabytes, and not on the stack.
Tracker g_tracker;
Cycle g_cycle;
Output g_output;

}  // namespace

SceneResult run_scene(const std::uint8_t* scene, std::size_t size) {
    SceneResult result;
    SceneReader reader(scene, size);
    Config config;
    config.background_features = kMaxBackgroundFeatures < 250 ? kMaxBackgroundFeatures : 250;
    config.object_features = kMaxObjectFeatures < 60 ? kMaxObjectFeatures : 60;
    if (!reader.ok() || g_tracker.init(config, reader.calibration()) != Status::kOk) {
        return result;
    }
    SceneSource source(reader);
    HashingBus bus;
    CyclePorts ports;
    ports.stereo = &source;
    ports.detections = &source;
    ports.can = &bus;
    g_cycle.init(ports, CanConfig{});
    while (result.frames < reader.frames() && g_cycle.step(g_tracker, g_output) == CycleResult::kProcessed) {
        ++result.frames;
    }
    result.complete = reader.ok() && result.frames == reader.frames();
    result.can_frames = bus.frames();
    result.objects = g_output.objects.size();
    result.points = g_output.points.size();
    result.hash = bus.hash();
    return result;
}

namespace {

/// Without a library's formatted output: newlib's wants a heap.
class Line {
public:
    explicit Line(char* text) : at_(text) {}
    void put(const char* text) {
        const std::size_t size = std::strlen(text);
        std::memcpy(at_, text, size);
        at_ += size;
    }
    void hexadecimal(std::uint64_t value) {
        for (int shift = 60; shift >= 0; shift -= 4) {
            *at_++ = "0123456789abcdef"[(value >> static_cast<unsigned>(shift)) & 0xFU];
        }
    }
    void decimal(int value) {
        char digits[12];
        int count = 0;
        do {
            digits[count++] = static_cast<char>('0' + value % 10);
            value /= 10;
        } while (value != 0);
        while (count > 0) {
            *at_++ = digits[--count];
        }
    }
    void end() { *at_ = '\0'; }

private:
    char* at_;
};

}  // namespace

void format_result(const SceneResult& result, char* text) {
    Line line(text);
    line.put("hash ");
    line.hexadecimal(result.hash);
    line.put(" frames ");
    line.decimal(result.frames);
    line.put(" can ");
    line.decimal(result.can_frames);
    line.put(" objects ");
    line.decimal(result.objects);
    line.put(" points ");
    line.decimal(result.points);
    line.put(result.complete ? " complete\n" : " INCOMPLETE\n");
    line.end();
}

}  // namespace semtrack::board
