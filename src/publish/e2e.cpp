#include "publish/e2e.hpp"

namespace semtrack {

namespace {

/// The counter against the last one's, both below `counters`.
E2eState check_counter(int counter, int counters, int max_delta, E2eCheck& check) {
    const int delta = (counter + counters - check.counter) % counters;
    const bool first = !check.started;
    check.started = true;
    check.counter = static_cast<std::uint8_t>(counter);
    if (first || delta == 1) {
        return E2eState::kOk;
    }
    if (delta == 0) {
        return E2eState::kRepeated;
    }
    return delta <= max_delta ? E2eState::kOkSomeLost : E2eState::kWrongSequence;
}

}  // namespace

std::uint16_t crc16_1021(std::uint16_t crc, std::uint8_t byte) {
    unsigned c = crc ^ (static_cast<unsigned>(byte) << 8U);
    for (int bit = 0; bit < 8; ++bit) {
        c = (c & 0x8000U) != 0U ? (c << 1U) ^ 0x1021U : c << 1U;
    }
    return static_cast<std::uint16_t>(c & 0xFFFFU);
}

std::uint8_t crc8_1d(std::uint8_t crc, std::uint8_t byte) {
    unsigned c = static_cast<unsigned>(crc) ^ byte;
    for (int bit = 0; bit < 8; ++bit) {
        c = (c & 0x80U) != 0U ? (c << 1U) ^ 0x1DU : c << 1U;
    }
    return static_cast<std::uint8_t>(c & 0xFFU);
}

std::uint16_t profile5_crc(const FrameBytes& data, int length, std::uint16_t data_id) {
    std::uint16_t crc = 0xFFFF;
    for (int i = 2; i < length; ++i) {
        crc = crc16_1021(crc, data[static_cast<std::size_t>(i)]);
    }
    crc = crc16_1021(crc, static_cast<std::uint8_t>(data_id & 0xFFU));
    return crc16_1021(crc, static_cast<std::uint8_t>(data_id >> 8U));
}

void protect_profile5(FrameBytes& data, int length, std::uint16_t data_id, std::uint8_t counter) {
    data[2] = counter;
    put_bits(data, 0, 16, profile5_crc(data, length, data_id));
}

std::uint8_t profile11_crc(const FrameBytes& data, int length, std::uint16_t data_id) {
    std::uint8_t crc = crc8_1d(0, static_cast<std::uint8_t>(data_id & 0xFFU));
    crc = crc8_1d(crc, 0);
    for (int i = 1; i < length; ++i) {
        crc = crc8_1d(crc, data[static_cast<std::size_t>(i)]);
    }
    return crc;
}

void protect_profile11(FrameBytes& data, int length, std::uint16_t data_id, std::uint8_t counter) {
    put_bits(data, 8, 4, counter);
    put_bits(data, 12, 4, (static_cast<unsigned>(data_id) >> 8U) & 0xFU);
    data[0] = profile11_crc(data, length, data_id);
}

E2eState check_profile5(const FrameBytes& data, int length, std::uint16_t data_id, E2eCheck& check) {
    if (get_bits(data, 0, 16) != profile5_crc(data, length, data_id)) {
        return E2eState::kError;
    }
    return check_counter(data[2], kProfile5Counters, kProfile5MaxDelta, check);
}

E2eState check_profile11(const FrameBytes& data, int length, std::uint16_t data_id, E2eCheck& check) {
    const auto counter = static_cast<int>(get_bits(data, 8, 4));
    const bool ours = get_bits(data, 12, 4) == ((static_cast<unsigned>(data_id) >> 8U) & 0xFU);
    if (!ours || counter >= kProfile11Counters || data[0] != profile11_crc(data, length, data_id)) {
        return E2eState::kError;
    }
    return check_counter(counter, kProfile11Counters, kProfile11MaxDelta, check);
}

}  // namespace semtrack
