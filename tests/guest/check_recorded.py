#!/usr/bin/env python3
"""Frames recorded on a CAN bus against those of can.log, byte for byte; times and the interface's name are the recorder's.

usage: check_recorded.py [--some] CAN_LOG DUMP    --some: what was lost on the way may be missing, nothing else may differ
       check_recorded.py --disturbed PARTS GAP CAN_LOG DUMP    --some, and lists are whole or absent but for PARTS of
           them; one pause left out at least GAP lists in a row: none of them came later
       check_recorded.py --self-test
"""
import sys


def frames(text):
    """ID#DATA of candump's log lines, or of plain ID#DATA lines."""
    out = []
    for line in text.splitlines():
        word = line.split()[-1] if line.split() else ""
        if "##" in word:  # newer kernels mark every CAN FD frame with flag 4
            id_, _, rest = word.partition("##")
            word = f"{id_}##{int(rest[0], 16) & ~4:X}{rest[1:]}"
        if "#" in word:
            out.append(word.upper())
    return out


def lists(text):
    """Frames of each list of can.log: those of one time stamp."""
    out, before = [], None
    for line in text.splitlines():
        stamp = line.split(None, 1)[0] if line.split() else before
        if stamp != before:
            out.append([])
            before = stamp
        out[-1] += frames(line)
    return out


def arrived(sent_lists, recorded):
    """Of each list, how many frames were recorded; None: not in order. Counters make every frame another one."""
    counts, at = [0] * len(sent_lists), 0
    flat = [(i, frame) for i, frames_ in enumerate(sent_lists) for frame in frames_]
    for frame in recorded:
        while at < len(flat) and flat[at][1] != frame:
            at += 1
        if at == len(flat):
            return None
        counts[flat[at][0]] += 1
        at += 1
    return counts


def disturbed_complaint(sent_lists, recorded, most_parts, least_gap):
    counts = arrived(sent_lists, recorded)
    if not recorded or counts is None:
        return "nothing was recorded" if not recorded else "a frame out of order, late or changed"
    parts = sum(0 < n < len(sent) for n, sent in zip(counts, sent_lists))
    if parts > most_parts:
        return f"{parts} lists arrived in part"
    inside = "".join("x" if n else "." for n in counts).strip(".")
    gap = max(len(run) for run in inside.split("x"))
    whole = sum(n == len(sent) for n, sent in zip(counts, sent_lists))
    print(f"lists: {whole} whole, {parts} in part, {counts.count(0)} absent, up to {gap} in a row")
    return None if gap >= least_gap else f"a pause left out {gap} lists in a row at most: others came late"


def complaint(sent, recorded, some):
    """None: all is well."""
    if not sent:
        return "can.log holds no frame"
    if not recorded:
        return "nothing was recorded"
    if not some:
        for i, (a, b) in enumerate(zip(sent, recorded)):
            if a != b:
                return f"frame {i}: sent {a}, recorded {b}"
        return None if len(sent) == len(recorded) else f"{len(sent)} frames sent, {len(recorded)} recorded"
    rest = iter(sent)
    for i, frame in enumerate(recorded):
        if not any(frame == candidate for candidate in rest):
            return f"recorded frame {i}, {frame}, is not among those still to come"
    return None


def self_test():
    sent = frames("(1.0) can0 601##1AA\n(1.0) can0 602##1BB\n(1.1) can0 601##1AC\n")
    newer = frames("(9.0) vcan0 601##5AA\n(9.0) vcan0 602##5BB\n(9.1) vcan0 601##5AC\n")
    cases = [(newer, False, True), (sent, False, True), (sent[:2], False, False), (sent[:2], True, True),
             (sent[::-1], True, False), (sent[:1] + ["602##1BC"], True, False), ([], True, False), (sent + sent[-1:], True, False)]
    wrong = [c for c in cases if (complaint(sent, c[0], c[1]) is None) != c[2]]
    three = [["1#A", "2#A"], ["1#B", "2#B"], ["1#C", "2#C"], ["1#D", "2#D"]]
    whole = [frame for frames_ in three for frame in frames_]
    for recorded, parts, gap, good in [(whole, 0, 0, True), (whole[:2] + whole[6:], 0, 2, True),
                                       (whole[:2] + whole[6:], 0, 3, False), (whole[:3] + whole[6:], 0, 0, False),
                                       (whole[:3] + whole[6:], 1, 1, True), (whole[6:] + whole[:2], 9, 0, False),
                                       (whole[:2] + whole[4:], 0, 2, False), ([], 9, 0, False)]:
        if (disturbed_complaint(three, recorded, parts, gap) is None) != good:
            wrong.append((recorded, parts, gap))
    print("planted differences:", "all found" if not wrong else f"FAILED: {wrong}")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if arguments[:1] == ["--disturbed"] and len(arguments) == 5:
        sent, recorded = (open(name).read() for name in arguments[3:])
        said = disturbed_complaint(lists(sent), frames(recorded), int(arguments[1]), int(arguments[2]))
        print(f"{len(frames(recorded))} of {len(frames(sent))} frames recorded: {said or 'in order, none stale'}")
        return 1 if said else 0
    some = arguments[:1] == ["--some"]
    files = arguments[1:] if some else arguments
    if len(files) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    sent, recorded = (frames(open(name).read()) for name in files)
    said = complaint(sent, recorded, some)
    print(f"{len(recorded)} of {len(sent)} frames recorded: {said or 'as sent'}")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
