#!/usr/bin/env python3
"""Compares result folders of `semtrack-sil replay --stages` byte by byte; of the first that differs says frame, stage, object.

usage: compare_runs.py REFERENCE OTHER...     status 0: the same bytes, 1: they differ, 2: bad usage
       compare_runs.py --self-test REFERENCE  plants differences into copies of REFERENCE: each has to be named
"""
import pathlib
import shutil
import sys
import tempfile

COMPARED = ["can.log", "ego.txt", "objects.txt", "states.csv"]
STAGES = "stages.csv"
HEADERS = {"states.csv", STAGES}


def rows(folder, name):
    return (folder / name).read_bytes().split(b"\n")


def first_difference(a, b):
    """Index of the first row that differs; None: all are equal."""
    for i in range(max(len(a), len(b))):
        if i >= len(a) or i >= len(b) or a[i] != b[i]:
            return i
    return None


def place_in_results(folder, name, index):
    """Frame and object of a result row, as far as the file says."""
    lines = rows(folder, name)
    row = lines[index].decode(errors="replace") if index < len(lines) else ""
    if not row:
        return "after its last row"
    if name == "ego.txt":
        frames = (folder / "frames.txt").read_text().split()
        return f"frame {frames[index]}" if index < len(frames) else f"row {index}"
    if name == "objects.txt":
        return "frame {}, object {}".format(*row.split()[:2])
    if name == "states.csv":
        cells = row.split(",")
        return f"frame {cells[0]}, object {cells[2]}"
    return f"row {index + 1}: {row[:60]}"


def compare(reference, other):
    """Lines that say what differs; empty: nothing."""
    said = []
    for name in COMPARED:
        for folder in (reference, other):
            if not (folder / name).is_file() or (folder / name).stat().st_size == 0:
                return [f"{folder}: no {name}"]
        index = first_difference(rows(reference, name), rows(other, name))
        if index is not None:
            said.append(f"{name} differs first at {place_in_results(reference, name, index)}")
    stages = [folder / STAGES for folder in (reference, other)]
    if all(s.is_file() for s in stages):
        a, b = rows(reference, STAGES), rows(other, STAGES)
        index = first_difference(a, b)
        if index is not None:
            row = (a[index] if index < len(a) and a[index] else b[index]).decode(errors="replace")
            frame, stage, object_id = (row.split(",") + ["", "", ""])[:3]
            said.insert(0, f"first difference: frame {frame}, stage {stage}, object {object_id}")
        elif said:
            said.insert(0, "first difference: after the last stage (publishing or writing)")
    return said


def planted(reference, work, name, index, row):
    """A copy of the reference whose row is another one."""
    copy = work / f"{name}-{index}"
    shutil.copytree(reference, copy)
    lines = rows(copy, name)
    lines[index] = row(lines[index])
    (copy / name).write_bytes(b"\n".join(lines))
    return copy


def flip(row):
    """Another last digit."""
    return row[:-1] + (b"0" if row[-1:] != b"0" else b"1")


def self_test(reference):
    failures = []

    def expect(other, *words):
        said = " | ".join(compare(reference, other))
        if not all(word in said for word in words):
            failures.append(f"{other.name}: {words} not in {said!r}")

    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        same = work / "same"
        shutil.copytree(reference, same)
        if compare(reference, same):
            failures.append(f"a plain copy differs: {compare(reference, same)}")
        stages = [r.decode().split(",") for r in rows(reference, STAGES)[1:] if r]
        for stage in ("match", "ego", "objects"):
            index, cells = next((i, c) for i, c in enumerate(stages, 1) if c[1] == stage and i > len(stages) // 2)
            expect(planted(reference, work, STAGES, index, flip), f"frame {cells[0]}, stage {stage}, object {cells[2]}")
        for name in COMPARED:
            index = len(rows(reference, name)) // 2
            expect(planted(reference, work, name, index, flip), name, "after the last stage")
        cut = work / "cut"
        shutil.copytree(reference, cut)
        (cut / "can.log").write_bytes(b"\n".join(rows(cut, "can.log")[:-5]))
        expect(cut, "can.log")
        (cut / "ego.txt").unlink()
        expect(cut, "no ego.txt")
    for failure in failures:
        print("FAILED:", failure)
    print(f"planted differences: {'FAILED' if failures else 'all named'}")
    return 1 if failures else 0


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "--self-test":
        return self_test(pathlib.Path(arguments[1]))
    if len(arguments) < 2 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    reference = pathlib.Path(arguments[0])
    status = 0
    for name in arguments[1:]:
        said = compare(reference, pathlib.Path(name))
        print(f"{name}: {'the same bytes' if not said else 'DIFFERS'}")
        for line in said:
            print("   ", line)
        status = 1 if said else status
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
