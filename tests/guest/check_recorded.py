#!/usr/bin/env python3
"""Frames recorded on a CAN bus against those of can.log, byte for byte; times and the interface's name are the recorder's.

usage: check_recorded.py [--some] CAN_LOG DUMP    --some: what was lost on the way may be missing, nothing else may differ
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
    cases = [(frames("(9.0) vcan0 601##5AA\n(9.0) vcan0 602##5BB\n(9.1) vcan0 601##5AC\n"), False, True), (sent, False, True), (sent[:2], False, False), (sent[:2], True, True), (sent[::-1], True, False),
             (sent[:1] + ["602##1BC"], True, False), ([], True, False), (sent + sent[-1:], True, False)]
    wrong = [c for c in cases if (complaint(sent, c[0], c[1]) is None) != c[2]]
    print("planted differences:", "all found" if not wrong else f"FAILED: {wrong}")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
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
