#!/usr/bin/env python3
"""How long frames keep the bus busy. As a program: bus_time.py CAN_LOG [FD data rate in bit/s, default 2000000]

ISO 11898-1: the bits of a frame with the stuff bits that its very content needs, or the most that any content may need,
and the three bits of silence behind it. Arbitration at 500 kbit/s."""
import sys

from can_files import read_log

ARBITRATION_BPS = 500000
CLASSIC_TAIL = 13  # CRC delimiter, ACK, ACK delimiter, EOF 7, intermission 3
FD_TAIL = 12       # the same from ACK on
FD_LENGTH_CODES = {**{n: n for n in range(9)}, 12: 9, 16: 10, 20: 11, 24: 12, 32: 13, 48: 14, 64: 15}


def bits_of(value, width):
    return [value >> i & 1 for i in range(width - 1, -1, -1)]


def data_bits(data):
    return [bit for byte in data for bit in bits_of(byte, 8)]


def crc15(bits):
    crc = 0
    for bit in bits:
        crc = (crc << 1 & 0x7FFF) ^ (0x4599 if crc >> 14 ^ bit else 0)
    return crc


def stuff_positions(bits):
    """Behind which bits a stuff bit goes: after five equal ones, stuff bits counted."""
    places, last, run = [], None, 0
    for i, bit in enumerate(bits):
        run = run + 1 if bit == last else 1
        last = bit
        if run == 5:
            places.append(i)
            last, run = 1 - bit, 1
    return places


def most_stuff_bits(bits):
    """The first after five bits, then one after every four."""
    return (bits - 1) // 4


def classic_us(number, data, extended=False, worst=False):
    """Microseconds of a classic frame."""
    head = [0] + (bits_of(number >> 18, 11) + [1, 1] + bits_of(number & 0x3FFFF, 18) + [0, 0, 0] if extended
                  else bits_of(number, 11) + [0, 0, 0])
    bits = head + bits_of(len(data), 4) + data_bits(data)
    bits += bits_of(crc15(bits), 15)
    stuff = most_stuff_bits(len(bits)) if worst else len(stuff_positions(bits))
    return (len(bits) + stuff + CLASSIC_TAIL) * 1e6 / ARBITRATION_BPS


def fd_us(number, data, data_bps, extended=False, worst=False):
    """Microseconds of an FD frame with bit-rate switch. The CRC's stuff bits stand at fixed places."""
    head = [0] + (bits_of(number >> 18, 11) + [1, 1] + bits_of(number & 0x3FFFF, 18) if extended
                  else bits_of(number, 11))
    head += [0] * (1 if extended else 2) + [1, 0, 1]  # RRS, IDE (standard), FDF, reserved, BRS
    body = [0] + bits_of(FD_LENGTH_CODES[len(data)], 4) + data_bits(data)  # ESI, length, data
    if worst:
        slow = most_stuff_bits(len(head))
        fast = most_stuff_bits(len(head) + len(body)) - slow
    else:
        # None behind the last bit: the CRC's first fixed stuff bit is there.
        places = [p for p in stuff_positions(head + body) if p < len(head) + len(body) - 1]
        slow = sum(p < len(head) - 1 for p in places)
        fast = len(places) - slow
    check = 4 + (17 if len(data) <= 16 else 21)  # stuff count, CRC
    check += (check + 3) // 4                    # fixed stuff bits
    slow_bits = len(head) + slow + 1 + FD_TAIL   # the CRC delimiter ends at the slow rate
    return slow_bits * 1e6 / ARBITRATION_BPS + (len(body) + fast + check) * 1e6 / data_bps


def frame_us(number, fd, data, data_bps, worst=False):
    return fd_us(number, data, data_bps, worst=worst) if fd else classic_us(number, data, worst=worst)


def list_times_ms(log, first_id, data_bps=2000000):
    """[(frames, ms with the stuff bits as they are, ms at worst)] of each list; a list starts with first_id."""
    lists = []
    for _, number, fd, data in read_log(log):
        if number == first_id:
            lists.append([0, 0.0, 0.0])
        lists[-1][0] += 1
        lists[-1][1] += 1e-3 * frame_us(number, fd, data, data_bps)
        lists[-1][2] += 1e-3 * frame_us(number, fd, data, data_bps, worst=True)
    return lists


def main():
    with open(sys.argv[1]) as file:
        log = file.read()
    data_bps = int(sys.argv[2]) if len(sys.argv) > 2 else 2000000
    lists = list_times_ms(log, next(read_log(log))[1], data_bps)
    frames, actual, worst = max(lists)
    print(f"{len(lists)} lists; the longest: {frames} frames, {actual:.3f} ms ({actual:.1f} % at 10 Hz), "
          f"worst stuffing {worst:.3f} ms")


if __name__ == "__main__":
    main()
