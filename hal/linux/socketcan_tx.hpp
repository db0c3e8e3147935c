// Object lists onto SocketCAN: whole or not at all, never an old one after a pause, never waiting
// (docs/can/socketcan.md). No thread, no heap, no exception.
//
// The kernel takes about six frames at a time (SO_SNDBUF at its least); the list waits here, and goes on with the next
// call of service() or begin_list(). Its last frame waits until the kernel has handed on all others, so what a stalled
// bus holds back is never a whole list: a receiver drops it by its list counter.
#ifndef SEMTRACK_HAL_LINUX_SOCKETCAN_TX_HPP
#define SEMTRACK_HAL_LINUX_SOCKETCAN_TX_HPP

#include <array>
#include <cstdint>

#include "hal/linux/can_socket.hpp"
#include "semtrack/can_encoder.hpp"
#include "semtrack/hal/can_tx.hpp"

namespace semtrack::hal {

/// Only grow.
struct SocketCanCounters {
    std::uint32_t frames_sent{0};    ///< taken by the kernel
    std::uint32_t lists_sent{0};     ///< with their last frame
    std::uint32_t lists_refused{0};  ///< by begin_list() or send(): the bus was busy, off or down
    std::uint32_t lists_unsent{0};   ///< taken over, then given up before their first frame
    std::uint32_t lists_broken{0};   ///< given up after their first frame; receivers drop what came
    std::uint32_t busy{0};           ///< EAGAIN: the socket was full
    std::uint32_t no_buffers{0};     ///< ENOBUFS: the interface's queue was full
    std::uint32_t short_writes{0};
    std::uint32_t other_errors{0};  ///< of writing, neither of these nor down
    std::uint32_t downs{0};         ///< the interface went down or vanished
    std::uint32_t bus_offs{0};
    std::uint32_t error_passives{0};
    std::uint32_t reopened{0};  ///< the interface came back
};

class SocketCanTx final : public CanTx {
public:
    /// A list that is not on the bus by then is given up for the next one: one and a half periods of the camera.
    static constexpr std::int64_t kListLifetime_us = 150000;
    /// After bus-off without news of a restart: when to try again.
    static constexpr std::int64_t kBusOffPause_us = 200000;

    explicit SocketCanTx(SocketCalls& calls) : calls_(calls), socket_(calls) {}

    /// The interface may be down: lists are refused until it is up.
    [[nodiscard]] CanOpen open(const char* interface, bool fd) noexcept;
    /// Takes news of the bus, sends what is left of the list before. kBusy: that list is still going out. kBusOff: no
    /// list can. At most 10 system calls when nothing gets out.
    [[nodiscard]] Result begin_list(int frames, std::int64_t time_us) noexcept override;
    /// Sends or stores the frame. A frame without begin_list() is a list of its own.
    [[nodiscard]] Result send(const CanFrame& frame, std::int64_t time_us) noexcept override;
    [[nodiscard]] CanState state() const noexcept override;
    [[nodiscard]] std::uint32_t lists_lost() const noexcept override { return lists_lost_; }
    /// Sends what is left of the list, waiting at most timeout_ms in all; gives up when two tries in a row move
    /// nothing. True: nothing is left. To be called between cycles, when the camera leaves time, else lists longer
    /// than the kernel takes at once go out a camera's period late.
    bool service(int timeout_ms) noexcept;
    /// Frames of the current list that wait here.
    [[nodiscard]] bool waiting() const { return next_ < expected_; }
    /// For a poll() of the caller's own; -1 while closed.
    [[nodiscard]] int fd() const { return socket_.fd(); }
    [[nodiscard]] const SocketCanCounters& counters() const { return counters_; }

private:
    enum class Written : std::uint8_t { kYes, kLater, kGone, kRefused };
    [[nodiscard]] Written write(const CanFrame& frame) noexcept;
    [[nodiscard]] bool advance() noexcept;
    [[nodiscard]] Result finish_last_list() noexcept;
    void give_up(bool told) noexcept;
    void clear_list() noexcept;
    void take_news() noexcept;
    void take_error_frame(const canfd_frame& frame) noexcept;
    [[nodiscard]] bool recover() noexcept;
    [[nodiscard]] bool bus_is_off() noexcept;
    [[nodiscard]] bool queue_is_empty() noexcept;
    [[nodiscard]] bool is_old() noexcept;
    void go_down() noexcept;
    void lose_interface() noexcept;
    void go_bus_off() noexcept;

    SocketCalls& calls_;
    CanSocket socket_;
    std::array<CanFrame, static_cast<std::size_t>(kMaxCanFrames)> list_{};
    int expected_{0};  // frames of the list
    int stored_{0};    // of them, taken over
    int next_{0};      // of them, written
    std::int64_t list_start_us_{0};
    std::int64_t bus_off_us_{0};
    std::uint32_t lists_lost_{0};
    bool fd_{true};
    bool stalled_{false};  // the kernel refused the next frame; not tried again within this call
    bool full_{false};     // ... because the socket is full: poll() tells when it is not
    bool down_{false};     // the interface is down
    bool gone_{true};      // the socket is closed, or its interface is not there any more
    bool bus_off_{false};
    bool passive_{false};
    SocketCanCounters counters_{};
};

}  // namespace semtrack::hal

#endif
