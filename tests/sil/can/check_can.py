#!/usr/bin/env python3
"""The object list as a receiver sees it who has the DBC alone. Usage: check_can.py SEMTRACK_SIL SEMTRACK_DBC ROOT PART

PART dbc: the files in ROOT/docs/can are those that the table gives, and load without a warning.
PART fd, classic: a replay's can.log, decoded by an independent library with the DBC, equals list.csv within half a
bit; every CRC is recomputed; counters count. A planted fault of each kind must be found."""
import collections
import csv
import io
import logging
import math
import pathlib
import subprocess
import sys
import tempfile

SIL, DBC, ROOT, PART = sys.argv[1:5]
FILES = {"fd": "semtrack.dbc", "classic": "semtrack_classic.dbc"}
SKIPPED = {"E2eCrc", "E2eCounter", "E2eDataIdNibble", "PairIndex", "ObjectSlot"}  # of the frame, not of the list


def load(dialect):
    """The DBC by python3-canmatrix; its log must stay empty."""
    log = io.StringIO()
    logging.basicConfig(stream=log, level=logging.WARNING, force=True)
    import canmatrix.formats
    log.truncate(0)  # missing optional formats
    log.seek(0)
    matrix = canmatrix.formats.loadp_flat(str(ROOT + "/docs/can/" + FILES[dialect]))
    if log.getvalue():
        sys.exit(f"{FILES[dialect]}: loads with warnings: {log.getvalue()}")
    return matrix


def check_dbc():
    problems = []
    for dialect, name in FILES.items():
        text = subprocess.run([DBC, "--can-dialect", dialect], capture_output=True, text=True, check=True).stdout
        if text != pathlib.Path(ROOT, "docs/can", name).read_text():
            problems.append(f"docs/can/{name} is not what `semtrack-dbc --can-dialect {dialect}` writes")
        for frame in load(dialect).frames:
            if frame.is_fd != (dialect == "fd"):
                problems.append(f"{name}: {frame.name}: wrong frame format")
            cycle_ms = "20" if frame.name == "VehicleMotion" else "100"
            if frame.attributes.get("GenMsgCycleTime") != cycle_ms or not frame.comment:
                problems.append(f"{name}: {frame.name}: no cycle time or comment")
            for signal in frame.signals:
                if not signal.comment:
                    problems.append(f"{name}: {frame.name}.{signal.name}: no comment")
            used = [b for s in frame.signals for b in range(s.start_bit, s.start_bit + s.size)]
            if len(used) != len(set(used)) or max(used) >= 8 * frame.size:
                problems.append(f"{name}: {frame.name}: signals overlap or leave the frame")
    return problems


def crc(data, polynomial, width, value):
    """Bit by bit over a stream of bits: nothing in common with the library's."""
    for byte in data:
        for shift in range(7, -1, -1):
            feedback = (value >> (width - 1) ^ byte >> shift) & 1
            value = (value << 1 & (1 << width) - 1) ^ (polynomial if feedback else 0)
    return value


def protection_problem(data, data_id, fd):
    if fd:
        wanted = crc(data[2:] + bytes([data_id & 0xFF, data_id >> 8]), 0x1021, 16, 0xFFFF)
        return None if data[0] | data[1] << 8 == wanted else "CRC-16"
    if data[1] >> 4 != data_id >> 8:
        return "data id nibble"
    return None if data[0] == crc(bytes([data_id & 0xFF, 0]) + data[1:], 0x1D, 8, 0) else "CRC-8"


def read_log(text):
    for row in text.splitlines():
        stamp, _, body = row.split(" ")
        name, fd, payload = body.partition("##")
        if fd:
            payload = payload[1:]
        else:
            name, _, payload = body.partition("#")
        yield int(stamp[1:-1].replace(".", "")), int(name, 16), bytes.fromhex(payload)


def lists_of(log, matrix, fd):
    """[(time, header signals, {slot: signals})], and what is wrong with the frames."""
    by_id = {f.arbitration_id.id: f for f in matrix.frames}
    counters = {}
    lists, problems = [], []
    for time, number, data in read_log(log):
        frame = by_id[number]
        if len(data) != frame.size:
            problems.append(f"{frame.name}: {len(data)} bytes")
            continue
        wrong = protection_problem(data, int(frame.attributes["E2eDataId"]), fd)
        if wrong:
            problems.append(f"{time} {frame.name}: {wrong} is wrong")
        signals = frame.decode(data)
        counter = signals["E2eCounter"].raw_value
        last = counters.get(number)
        if last is not None and counter != (last + 1) % (256 if fd else 15):
            problems.append(f"{time} {frame.name}: counter {counter} after {last}")
        counters[number] = counter
        if frame.name == "ListHeader":
            lists.append((time, {}, collections.defaultdict(dict)))
        _, header, objects = lists[-1]
        index = signals["PairIndex" if "PairIndex" in signals else "ObjectSlot"].raw_value \
            if not {"PairIndex", "ObjectSlot"}.isdisjoint(signals) else None
        for name, value in signals.items():
            if name in SKIPPED:
                continue
            if index is None:
                header[name] = value
            elif name.endswith(("_0", "_1")):
                objects[2 * index + int(name[-1])][name[:-2]] = value
            elif fd:  # ListCounter, of both objects
                objects[2 * index][name] = objects[2 * index + 1][name] = value
            else:
                objects[index][name] = value
    return lists, problems


def compare(name, value, text, where):
    signal = value.signal
    missing = value.raw_value == (1 << signal.size) - 1 and "GenSigStartValue" in signal.attributes
    if text == "":
        return None if missing else f"{where}: {name} is sent but not in list.csv"
    if missing:
        return f"{where}: {name} is not available on the bus, list.csv has {text}"
    physical = value.raw_value * float(signal.factor) + float(signal.offset)
    if abs(physical - float(text)) <= 0.5000001 * float(signal.factor) or not math.isfinite(float(text)):
        return None
    return f"{where}: {name} is {physical} on the bus, {text} in list.csv"


def check_values(lists, rows):
    problems = []
    position = 0
    for time, header, objects in lists:
        count = header["ObjectCount"].raw_value
        for slot in range(-1, count):
            row = rows[position]
            position += 1
            signals = header if slot < 0 else objects[slot]
            where = f"frame {row['frame']} object {row['object']}"
            if row["object"] != ("" if slot < 0 else str(slot)) or int(row["time_us"]) != time:
                return problems + [f"{where}: the rows of list.csv are not those of the list at {time}"]
            if signals["Saturated" if slot >= 0 else "HeaderSaturated"].raw_value == 1:
                continue  # its values are the ends of their ranges
            problems += filter(None, (compare(n, v, row[n], where) for n, v in signals.items()))
        for slot in range(count, len(objects)):
            if any(v.raw_value != (1 << v.signal.size) - 1 for n, v in objects[slot].items() if n != "ListCounter"):
                problems.append(f"list at {time}: the unused slot {slot} is not all ones")
    if position != len(rows):
        problems.append(f"list.csv has {len(rows) - position} rows that were not sent")
    return problems


def check_run(dialect):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([SIL, "replay", "--layout", "world", "--sequence", "street", "--last", "24", "--detections",
                        "labels", "--can-dialect", dialect, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        log = pathlib.Path(folder, "can.log").read_text()
        table = list(csv.DictReader(open(pathlib.Path(folder, "list.csv"), newline="")))
    matrix = load(dialect)
    fd = dialect == "fd"
    lists, problems = lists_of(log, matrix, fd)
    problems += check_values(lists, table)
    sent = sum(header["ObjectCount"].raw_value for _, header, _ in lists)
    if len(lists) != 25 or sent < 50:
        problems.append(f"{len(lists)} lists with {sent} objects: the run shows nothing")
    # Faults that have to be found: a flipped bit, a lost frame, a value that is another.
    rows = log.splitlines()
    flipped = rows[:]
    flipped[7] = flipped[7][:-1] + ("0" if flipped[7][-1] != "0" else "1")
    if not lists_of("\n".join(flipped), matrix, fd)[1]:
        problems.append("planted: a flipped bit was not found")
    if not lists_of("\n".join(rows[:9] + rows[10:]), matrix, fd)[1]:
        problems.append("planted: a lost frame was not found")
    first = next(i for i, row in enumerate(table) if row["PositionX"])
    table[first] = {**table[first], "PositionX": str(float(table[first]["PositionX"]) + 0.02)}
    if not check_values(lists, table):
        problems.append("planted: a wrong value was not found")
    print(f"{dialect}: {len(rows)} frames, {len(lists)} lists, {sent} objects")
    return problems


found = check_dbc() if PART == "dbc" else check_run(PART)
print("\n".join(found[:20]) or "ok")
sys.exit(1 if found else 0)
