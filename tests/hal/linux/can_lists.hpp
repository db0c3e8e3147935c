// Lists whose frames say which list they belong to, and what a bus saw of them.
#ifndef SEMTRACK_TESTS_HAL_LINUX_CAN_LISTS_HPP
#define SEMTRACK_TESTS_HAL_LINUX_CAN_LISTS_HPP

#include <map>
#include <vector>

#include "fake_kernel.hpp"
#include "hal/linux/socketcan_tx.hpp"

namespace semtrack::hal::test {

inline constexpr int kListFrames = 5;
inline constexpr std::int64_t kPeriod_us = 100000;

inline CanFrame list_frame(int list, int k, bool fd = true) {
    CanFrame f;
    f.id = 0x600U + (k > 0 ? 1U : 0U);
    f.fd = fd;
    f.length = fd ? 64 : 8;
    f.data[0] = static_cast<std::uint8_t>(list);
    f.data[1] = static_cast<std::uint8_t>(k);
    return f;
}

/// As Cycle does it. kSent: every frame was taken over.
inline CanTx::Result offer(SocketCanTx& tx, int list, int frames = kListFrames, bool fd = true) {
    CanTx::Result result = tx.begin_list(frames, 0);
    for (int k = 0; k < frames && result == CanTx::Result::kSent; ++k) {
        result = tx.send(list_frame(list, k, fd), 0);
    }
    return result;
}

/// Frames of each list that got to the kernel.
inline std::map<int, int> frames_of_lists(const FakeKernel& kernel) {
    std::map<int, int> out;
    for (const canfd_frame& f : kernel.sent) {
        ++out[f.data[0]];
    }
    return out;
}

}  // namespace semtrack::hal::test

#endif
