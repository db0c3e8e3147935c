#!/usr/bin/env python3
"""docs/can/README.md says what the DBC files say. Usage: check_can_docs.py ROOT [--write]

The table of signals between the marks is made from the DBC files (--write puts it there); code blocks are parts of
receiver_example.cpp; the frames shown are golden ones."""
import pathlib
import re
import sys

from can_files import load

ROOT = pathlib.Path(sys.argv[1])
PAGE = ROOT / "docs/can/README.md"
MARK = "<!-- signals -->"
FRAME = {"E2eCrc", "E2eCounter", "E2eDataIdNibble", "PairIndex", "ObjectSlot", "ListCounter"}


def plain(number):
    text = f"{float(number):.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def table():
    fd = {f.name: f for f in load(ROOT / "docs/can/semtrack.dbc")[0].frames}
    classic = {re.sub("_0$", "", s.name): (f.name, s) for f in load(ROOT / "docs/can/semtrack_classic.dbc")[0].frames
               for s in f.signals if s.name not in FRAME}
    rows = ["| signal | FD: first bit, bits | classic: message, first bit | step, offset | range | unit | meaning |",
            "|---|---|---|---|---|---|---|"]
    for frame in fd.values():
        rows.append(f"| **{frame.name}** | {frame.size} bytes | | | | | {frame.comment} |")
        for s in frame.signals:
            name = re.sub("_0$", "", s.name)
            if name in FRAME or name.endswith("_1"):
                continue
            message, other = classic[name]
            codes = ", ".join(f"{k} {v}" for k, v in s.values.items() if v != "not available")
            meaning = s.comment.removesuffix(". All ones: not available") + (f" ({codes})" if codes else "")
            rows.append(f"| {name} | {s.start_bit}, {s.size} | {message}, {other.start_bit} | {plain(s.factor)}, "
                        f"{plain(s.offset)} | {plain(s.min)} to {plain(s.max)} | {s.unit} | {meaning} |")
    return "\n".join(rows)


def main():
    page = PAGE.read_text()
    before, old, after = page.split(MARK)
    made = "\n" + table() + "\n"
    if "--write" in sys.argv:
        PAGE.write_text(before + MARK + made + MARK + after)
        return 0
    problems = [] if old == made else ["the table of signals is not the DBC's: run with --write"]
    example = (ROOT / "docs/can/receiver_example.cpp").read_text()
    blocks = re.findall(r"```cpp\n(.*?)```", page, re.S)
    flat = re.sub(r"\s+", " ", example)
    problems += [f"not in receiver_example.cpp: {b[:60]!r}" for b in blocks if re.sub(r"\s+", " ", b).strip() not in flat]
    golden = "".join((ROOT / f"tests/publish/golden/{d}.log").read_text() for d in ("fd", "classic", "vehicle_motion"))
    frames = re.findall(r"^(?:\([\d.]+\) can0 )?([0-9A-F]{3}##?[0-9A-F]+)$", page, re.M)
    problems += [f"no golden frame: {f}" for f in frames if f not in golden]
    if not blocks or len(frames) < 3:
        problems.append("no code or no frames on the page: nothing was checked")
    if table() in page.replace("0.01", "0.02"):
        problems.append("planted: another step was not found")
    print("\n".join(problems) or f"ok: {made.count(chr(10)) - 3} rows, {len(blocks)} code blocks, {len(frames)} frames")
    return 1 if problems else 0


sys.exit(main())
