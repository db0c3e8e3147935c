#include "sil/can_output.hpp"

#include "sil/sequence.hpp"
#ifdef SEMTRACK_HAS_LINUX
#include "hal/linux/socketcan_tx.hpp"
#endif

namespace semtrack::sil {

#ifdef SEMTRACK_HAS_LINUX

struct CanOutput::Bus {
    hal::PosixCalls calls{};
    hal::SocketCanTx tx{calls};
    bool takes_list{false};
    std::uint32_t refused{0};

    Bus(const std::string& interface, CanDialect dialect) {
        const hal::CanOpen result = tx.open(interface.c_str(), dialect == CanDialect::kFd);
        if (result != hal::CanOpen::kOk) {
            throw InputError("--can " + interface + ": " + hal::text(result));
        }
    }
    void begin(int frames, std::int64_t time_us) {
        takes_list = tx.begin_list(frames, time_us) == CanTx::Result::kSent;
        refused += takes_list ? 0U : 1U;
    }
    void send(const CanFrame& frame, std::int64_t time_us) {
        if (takes_list && tx.send(frame, time_us) != CanTx::Result::kSent) {
            takes_list = false;
            ++refused;
        }
    }
    [[nodiscard]] std::uint32_t dropped() const { return refused + tx.lists_lost(); }
};

void CanOutput::service(int timeout_ms) {
    if (bus_) {
        (void)bus_->tx.service(timeout_ms);
    }
}

CanState CanOutput::state() const noexcept {
    return bus_ ? bus_->tx.state() : CanState::kActive;
}

RunCounts CanOutput::counts(const CycleCounters& cycle) const {
    if (!bus_) {
        return {{"can_frames", cycle.frames_sent},
                {"can_lists", cycle.lists_sent},
                {"can_lists_dropped", cycle.lists_dropped}};
    }
    const hal::SocketCanCounters& c = bus_->tx.counters();
    return {{"can_frames", c.frames_sent},
            {"can_lists", c.lists_sent},
            {"can_lists_dropped", bus_->dropped() + cycle.lists_dropped},
            {"can_lists_broken", c.lists_broken},
            {"can_busy", c.busy},
            {"can_no_buffers", c.no_buffers},
            {"can_short_writes", c.short_writes},
            {"can_other_errors", c.other_errors},
            {"can_downs", c.downs},
            {"can_bus_offs", c.bus_offs},
            {"can_error_passives", c.error_passives},
            {"can_reopened", c.reopened}};
}

std::string CanOutput::complaint() const {
    if (!bus_ || bus_->dropped() == 0U) {
        return {};
    }
    return interface_ + ": " + std::to_string(bus_->dropped()) + " lists did not get onto the bus, " +
           std::to_string(bus_->tx.counters().lists_sent) + " did";
}

#else

/// Never made.
struct CanOutput::Bus {
    Bus(const std::string& interface, CanDialect) {
        throw InputError("--can " + interface + ": this program was built without SocketCAN");
    }
    void begin(int, std::int64_t) {}
    void send(const CanFrame&, std::int64_t) {}
    [[nodiscard]] std::uint32_t dropped() const { return 0; }
};

void CanOutput::service(int) {}

CanState CanOutput::state() const noexcept {
    return CanState::kActive;
}

RunCounts CanOutput::counts(const CycleCounters& cycle) const {
    return {
        {"can_frames", cycle.frames_sent}, {"can_lists", cycle.lists_sent}, {"can_lists_dropped", cycle.lists_dropped}};
}

std::string CanOutput::complaint() const {
    return {};
}

#endif

CanOutput::CanOutput(std::FILE* log, const std::string& interface, CanDialect dialect)
    : log_(log), interface_(interface), bus_(interface.empty() ? nullptr : std::make_unique<Bus>(interface, dialect)) {}

CanOutput::~CanOutput() = default;

CanTx::Result CanOutput::begin_list(int frames, std::int64_t time_us) noexcept {
    if (bus_) {
        bus_->begin(frames, time_us);
    }
    return Result::kSent;
}

CanTx::Result CanOutput::send(const CanFrame& frame, std::int64_t time_us) noexcept {
    const Result logged = log_.send(frame, time_us);
    if (bus_) {
        bus_->send(frame, time_us);
    }
    return logged;
}

std::uint32_t CanOutput::lists_lost() const noexcept {
    return bus_ ? bus_->dropped() : 0U;
}

}  // namespace semtrack::sil
