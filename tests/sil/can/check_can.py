#!/usr/bin/env python3
"""The object list of a run as a receiver sees it who has the DBC alone. Usage: check_can.py SEMTRACK_SIL SEMTRACK_DBC ROOT fd|classic

A replay's can.log, decoded by an independent library with the DBC, equals list.csv within half a bit; every CRC is
recomputed; counters count; flags say which values lie outside their range. A planted fault of each kind must be found."""
import pathlib
import subprocess
import sys
import tempfile

from can_files import load
from list_check import check_values, lists_of, read_run

SIL, DBC, ROOT, DIALECT = sys.argv[1:5]
FD = DIALECT == "fd"


def flipped(row, digit):
    """The lowest bit of one hexadecimal digit of a row, counted from its end."""
    i = len(row) - 1 - digit
    return row[:i] + f"{int(row[i], 16) ^ 1:X}" + row[i + 1:]


def planted_frames(rows, matrix):
    """What has to be found in the frames."""
    digits = 2 * 64 if FD else 2 * 8
    i = max(range(20), key=lambda k: len(rows[k]))
    for digit in (0, 1, digits // 2, digits - 1):  # the last byte, the middle, the CRC
        broken = rows[:]
        broken[i] = flipped(broken[i], digit)
        yield f"a flipped bit, digit {digit}", broken
    yield "a lost frame", rows[:9] + rows[10:]
    yield "a frame that comes twice", rows[:9] + [rows[8]] + rows[9:]
    yield "swapped frames of one message", swapped(rows)
    yield "a short frame", rows[:5] + [rows[5][:-2]] + rows[6:]


def swapped(rows):
    ids = [row.split(" ")[2].split("#")[0] for row in rows]
    i = next(i for i in range(len(ids) - 1) if ids[i] == ids[i + 1])
    return rows[:i] + [rows[i + 1], rows[i]] + rows[i + 2:]


def planted_values(table):
    """What has to be found in the values: of an object and of the header."""
    for name, step in (("PositionX", 0.02), ("VelocityY", -0.02), ("Yaw", 0.0016), ("ObjectId", 1), ("SigmaX", 0.04),
                       ("EgoSpeed", 0.02), ("EgoYawRate", 0.001), ("ObjectCount", 1), ("ImageTime", 1)):
        i = next(i for i, row in enumerate(table) if row[name])
        changed = repr(float(table[i][name]) + step)
        yield f"another {name}", table[:i] + [{**table[i], name: changed}] + table[i + 1:]
        if name != "ImageTime":
            yield f"{name} that was not there", table[:i] + [{**table[i], name: ""}] + table[i + 1:]
    i = next(i for i, row in enumerate(table) if row["PositionX"])
    yield "a value out of range, not flagged", table[:i] + [{**table[i], "VelocityX": "500"}] + table[i + 1:]
    yield "a row that was not sent", table + [table[-1]]
    yield "a list that is not in list.csv", table[:-1]


def other_ids():
    """A run with other ids, 29-bit ones too, by the DBC written for them."""
    problems = []
    for options in (["--base-id", "0x123"], ["--base-id", "0x18FF0000", "--extended"]):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([SIL, "replay", "--layout", "world", "--sequence", "street", "--last", "4", "--detections",
                            "labels", "--can-dialect", DIALECT, *options, "--out", folder], check=True,
                           stdout=subprocess.DEVNULL)
            text = subprocess.run([DBC, "--can-dialect", DIALECT, *options], check=True, capture_output=True, text=True)
            file = pathlib.Path(folder, "ids.dbc")
            file.write_text(text.stdout)
            log, table = read_run(folder)
            lists, found = lists_of(log, load(file)[0], FD)
        found += check_values(lists, table)[0]
        digits = {len(row.split(" ")[2].split("#")[0]) for row in log.splitlines()}
        if len(lists) != 5 or digits != {8 if "--extended" in options else 3}:
            found.append(f"{len(lists)} lists, ids of {digits} digits")
        problems += [f"{' '.join(options)}: {problem}" for problem in found]
    return problems


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([SIL, "replay", "--layout", "world", "--sequence", "street", "--last", "24", "--detections",
                        "labels", "--can-dialect", DIALECT, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        log, table = read_run(folder)
    matrix, _ = load(pathlib.Path(ROOT, "docs/can", "semtrack.dbc" if FD else "semtrack_classic.dbc"))
    lists, problems = lists_of(log, matrix, FD)
    problems += check_values(lists, table)[0]
    sent = sum(header["ObjectCount"].raw_value for _, header, _ in lists)
    if len(lists) != 25 or sent < 50:
        problems.append(f"{len(lists)} lists with {sent} objects: the run shows nothing")
    problems += other_ids()
    planted = 0
    for what, rows in planted_frames(log.splitlines(), matrix):
        planted += 1
        if not lists_of("\n".join(rows), matrix, FD)[1]:
            problems.append(f"planted: {what} was not found")
    for what, rows in planted_values(table):
        planted += 1
        if not check_values(lists, rows)[0]:
            problems.append(f"planted: {what} was not found")
    print("\n".join(problems[:20]))
    print(f"{DIALECT}: {len(log.splitlines())} frames, {len(lists)} lists, {sent} objects, {planted} planted faults, "
          f"{len(problems)} problems")
    return 1 if problems else 0


sys.exit(main())
