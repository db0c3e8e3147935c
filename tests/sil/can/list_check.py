"""A can.log, decoded with the DBC alone, against list.csv: the signals of the same lists before quantisation."""
import collections
import csv
import math
import pathlib

from can_files import SKIPPED, protection_problem, read_log

FLAGS = ("Saturated", "HeaderSaturated")


def lists_of(log, matrix, fd):
    """[(time, header signals, {slot: signals})], and what is wrong with the frames."""
    by_id = {f.arbitration_id.id: f for f in matrix.frames}
    counters = {}
    lists, problems = [], []
    for time, number, is_fd, data in read_log(log):
        frame = by_id[number]
        if len(data) != frame.size or is_fd != fd:
            problems.append(f"{frame.name}: {len(data)} bytes, FD {is_fd}")
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
        index = next((signals[n].raw_value for n in ("PairIndex", "ObjectSlot") if n in signals), None)
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


def ends(signal):
    """Lowest and highest physical value: all ones is none where it says "not available"."""
    highest = (1 << signal.size) - (2 if "GenSigStartValue" in signal.attributes else 1)
    return float(signal.offset), highest * float(signal.factor) + float(signal.offset)


def compare(name, value, text, where):
    """(problem or None, is the value outside its range)"""
    signal = value.signal
    missing = value.raw_value == (1 << signal.size) - 1 and "GenSigStartValue" in signal.attributes
    if text == "":
        return None if missing else f"{where}: {name} is sent but not in list.csv", False
    wanted = float(text)
    if missing or not math.isfinite(wanted):
        right = missing and not math.isfinite(wanted)
        return None if right else f"{where}: {name} is not available on the bus, list.csv has {text}", False
    physical = value.raw_value * float(signal.factor) + float(signal.offset)
    half = 0.5000001 * float(signal.factor)
    lowest, highest = ends(signal)
    outside = wanted < lowest - half or wanted > highest + half
    right = abs(physical - min(max(wanted, lowest), highest)) <= half
    return None if right else f"{where}: {name} is {physical} on the bus, {text} in list.csv", outside


def check_values(lists, rows):
    """(problems, records with a value outside its range)"""
    problems = []
    position = saturated = 0
    for time, header, objects in lists:
        count = header["ObjectCount"].raw_value
        for slot in range(-1, count):
            if position == len(rows):
                return problems + ["list.csv is too short"], saturated
            row = rows[position]
            position += 1
            signals = header if slot < 0 else objects[slot]
            where = f"frame {row['frame']} object {row['object']}"
            if row["object"] != ("" if slot < 0 else str(slot)) or int(row["time_us"]) != time:
                return problems + [f"{where}: the rows of list.csv are not those of the list at {time}"], saturated
            if signals["ListCounter"].raw_value != header["ListCounter"].raw_value:
                problems.append(f"{where}: of another list")
            results = [compare(n, v, row[n], where) for n, v in signals.items()]
            problems += [p for p, _ in results if p]
            outside = any(o for _, o in results)
            saturated += outside
            flag = signals[FLAGS[slot < 0]].raw_value
            if flag != outside:
                problems.append(f"{where}: {FLAGS[slot < 0]} is {flag}")
            empty = [n for n, text in row.items() if text and n not in signals and n not in ("frame", "time_us", "object")]
            if empty:
                problems.append(f"{where}: {empty} of list.csv are not sent")
        for slot in range(count, len(objects)):
            if any(v.raw_value != (1 << v.signal.size) - 1 for n, v in objects[slot].items() if n != "ListCounter"):
                problems.append(f"list at {time}: the unused slot {slot} is not all ones")
    if position != len(rows):
        problems.append(f"list.csv has {len(rows) - position} rows that were not sent")
    return problems, saturated


def read_run(folder):
    log = pathlib.Path(folder, "can.log").read_text()
    with open(pathlib.Path(folder, "list.csv"), newline="") as file:
        return log, list(csv.DictReader(file))
