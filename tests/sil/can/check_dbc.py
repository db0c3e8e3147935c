#!/usr/bin/env python3
"""The DBC files as other tools read them. Usage: check_dbc.py SEMTRACK_DBC ROOT

Those in ROOT/docs/can are what the table gives; they and those of other base ids, 29-bit ones too, keep every rule that
some tool insists on, load without a warning, and say what a receiver needs. Planted violations must be found. The golden
frames in ROOT/tests/publish/golden decode to what went in."""
import pathlib
import re
import subprocess
import sys
import tempfile

from can_files import load, protection_problem, read_log

DBC, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
FILES = {"fd": "semtrack.dbc", "classic": "semtrack_classic.dbc"}
IDS = [(None, False), (0x0, False), (0x7EF, False), (0x123, False), (0x700, True), (0x18FF0000, True),
       (0x1FFFFFEF, True)]
FD_LENGTHS = {*range(9), 12, 16, 20, 24, 32, 48, 64}
SIGNAL = re.compile(r' SG_ (\w+) : (\d+)\|(\d+)@1\+ \(([^,]+),([^)]+)\) \[([^|]+)\|([^\]]+)\] "([^"]*)" (\w+)$')
COUNTING = {"E2eCrc", "E2eCounter", "E2eDataIdNibble", "ListCounter", "PairIndex", "ObjectSlot", "ProtocolVersion",
            "ImageTime", "FramesDropped"}  # all ones is a value like any other
UNITLESS = COUNTING - {"ImageTime"} | {
    "ObjectCount", "ObjectsDropped", "EgoStatus", "EgoDegraded", "NoRightImage", "NoDetections", "RoadNotPlane", "HeaderSaturated",
    "ObjectId", "Class", "Status", "Movement", "Existence", "Truncated", "Occlusion", "ReferencePoint", "Saturated"}


def text_problems(text):
    """Rules of the text itself."""
    problems = []
    if not text.isascii():
        problems.append("not pure ASCII")
    names = re.findall(r"^BO_ \d+ (\w+):", text, re.M)
    if len({n.lower() for n in names}) != len(names):
        problems.append("two messages of one name")
    scaled, frame = set(), ""
    seen = set()
    for row in text.splitlines():
        if row.startswith("BO_ "):
            frame, seen = row.split()[1], set()
        if not row.startswith(" SG_"):
            continue
        match = SIGNAL.match(row)
        if not match:
            problems.append(f"unreadable: {row}")
            continue
        name, numbers = match[1], match.groups()[3:7]
        if name.lower() in seen:
            problems.append(f"{name}: two signals of one name")
        seen.add(name.lower())
        names.append(name)
        problems += [f"{name}: {n} is not a plain decimal" for n in numbers if not re.fullmatch(r"-?\d+(\.\d+)?", n)]
        if (float(numbers[0]), float(numbers[1])) != (1.0, 0.0):
            scaled.add((frame, name))
        if not match[8] and re.sub("_[01]$", "", name) not in UNITLESS:
            problems.append(f"{name}: no unit")
    problems += [f"{n}: not a C identifier of at most 32 characters" for n in names
                 if not re.fullmatch(r"[A-Za-z_]\w{0,31}", n)]
    for frame, name, table in re.findall(r"^VAL_ (\d+) (\w+)(.*);$", text, re.M):
        if (frame, name) in scaled:
            problems.append(f"{name}: a value table on a scaled signal")
        if not re.fullmatch(r'( \d+ "[^"]+")+ ', table):
            problems.append(f"{name}: value table{table}")
    if max((i for i, r in enumerate(text.splitlines()) if r.startswith("BA_DEF")), default=0) > \
            min((i for i, r in enumerate(text.splitlines()) if r.startswith("BA_ ")), default=0):
        problems.append("an attribute before its definition")
    return problems


def frame_problems(matrix, dialect, base, extended):
    """What the decoder made of it."""
    problems = []
    for k, frame in enumerate(matrix.frames):
        here, attribute = frame.name, frame.attributes
        if (frame.arbitration_id.id, bool(frame.arbitration_id.extended)) != (base + k, extended):
            problems.append(f"{here}: id {frame.arbitration_id}")
        wanted_format = ("Extended" if extended else "Standard") + ("CAN_FD" if dialect == "fd" else "CAN")
        if frame.is_fd != (dialect == "fd") or attribute.get("VFrameFormat") != wanted_format:
            problems.append(f"{here}: frame format {attribute.get('VFrameFormat')}")
        if (attribute.get("CANFD_BRS") == "1") != (dialect == "fd"):
            problems.append(f"{here}: CANFD_BRS {attribute.get('CANFD_BRS')}")
        if frame.size not in (FD_LENGTHS if dialect == "fd" else {8}):
            problems.append(f"{here}: {frame.size} bytes are no legal length")
        if attribute.get("E2eDataId") != str(0x600 + k):
            problems.append(f"{here}: data id {attribute.get('E2eDataId')}")
        received = here == "VehicleMotion"
        if attribute.get("GenMsgCycleTime") != ("20" if received else "100") or not frame.comment:
            problems.append(f"{here}: no cycle time or comment")
        if frame.transmitters != ["Vehicle" if received else "Semtrack"]:
            problems.append(f"{here}: sent by {frame.transmitters}")
        for signal in frame.signals:
            if not signal.comment:
                problems.append(f"{here}.{signal.name}: no comment")
            counts = signal.name in COUNTING
            start = signal.attributes.get("GenSigStartValue")
            if start != (None if counts else str((1 << signal.size) - 1)):
                problems.append(f"{here}.{signal.name}: start value {start}")
            top = float(signal.max - signal.offset) / float(signal.factor)
            if abs(top - ((1 << signal.size) - (1 if counts else 2))) > 1e-6:
                problems.append(f"{here}.{signal.name}: all ones is a value")
        used = [b for s in frame.signals for b in range(s.start_bit, s.start_bit + s.size)]
        if len(used) != len(set(used)) or max(used) >= 8 * frame.size:
            problems.append(f"{here}: signals overlap or leave the frame")
    return problems


def check_file(text, dialect, base, extended):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "list.dbc")
        path.write_text(text)
        matrix, warnings = load(path)
    problems = text_problems(text) + frame_problems(matrix, dialect, base, extended)
    return matrix, problems + ([f"loads with warnings: {warnings}"] if warnings else [])


def check_golden(matrix, dialect):
    """The fixed list of tests/support/object_lists.hpp and a VehicleMotion, read with the DBC alone."""
    problems, raws = [], {}
    log = (ROOT / "tests/publish/golden" / f"{dialect}.log").read_text()
    log += (ROOT / "tests/publish/golden/vehicle_motion.log").read_text().splitlines()[dialect != "fd"]
    frames = {f.arbitration_id.id: f for f in matrix.frames}
    for _, number, fd, data in read_log(log):
        frame = frames[number]
        if fd != (dialect == "fd") or len(data) != frame.size:
            problems.append(f"golden {dialect}: {frame.name}: another format or length than the DBC's")
        wrong = protection_problem(data, int(frame.attributes["E2eDataId"]), fd)
        if wrong:
            problems.append(f"golden {dialect}: {frame.name}: {wrong}")
        signals = frame.decode(data)
        index = next((signals[n].raw_value for n in ("PairIndex", "ObjectSlot") if n in signals), 0)
        for name, value in signals.items():
            one = re.fullmatch(r"(\w+)_([01])", name)
            slot = 2 * index + int(one[2]) if one else index
            raws[one[1] if one else name, slot] = float(value.phys_value)
    for (name, slot), wanted in GOLDEN.items():
        if abs(raws.get((name, slot), 1e9) - wanted) > 1e-9:
            problems.append(f"golden {dialect}: {name} of object {slot} is {raws.get((name, slot))}, went in as {wanted}")
    return problems


GOLDEN = {("ObjectCount", 0): 3, ("ImageAge", 0): 35.0, ("EgoSpeed", 0): 8.4, ("EgoYawRate", 0): -0.12,
          ("FramesDropped", 0): 3, ("ImageTime", 0): 1317039265123456 % 2**40, ("ObjectId", 0): 7, ("ObjectId", 1): 1,
          ("ObjectId", 2): 300, ("PositionX", 0): 12.5, ("PositionY", 1): -4.0, ("VelocityX", 2): -13.2,
          ("Movement", 2): 3, ("Class", 1): 3, ("Status", 1): 2, ("Truncated", 1): 1, ("Height", 1): 1.75,
          ("Yaw", 2): -3.2 + 0.0008 * 7875, ("VehicleSpeed", 0): -2.5, ("VehicleYawRate", 0): 0.125,
          ("SigmaVehicleSpeed", 0): 0.06}

PLANTED = [("0.01,-300", "1e-2,-300"), ("Length_1", "length_0"), ("m/s", "m\u00b2/s"), (" PositionX_0", " 1PositionX_0"),
           ("PositionX_0 : 75", "PositionX_0 : 74"), ('VAL_ 1537 Class_1', 'VAL_ 1537 PositionX_1'),
           ("BO_ 1537 ObjectPair: 64", "BO_ 1537 ObjectPair: 63"), ("Existence_0", "ExistenceOfThisObjectIsAProbability_0"),
           ("[-300|355.34]", "[-300|355.35]"), ('VFrameFormat" BO_ 1537 14', 'VFrameFormat" BO_ 1537 0'),
           ('"m" Receiver', '"" Receiver'), ("GenMsgCycleTime\" BO_ 1536 100", "GenMsgCycleTime\" BO_ 1536 0")]


def main():
    found, files = [], 0
    for dialect, name in FILES.items():
        for base, extended in IDS:
            more = ["--base-id", str(base)] if base is not None else []
            text = subprocess.run([DBC, "--can-dialect", dialect, *more, *(["--extended"] if extended else [])],
                                  capture_output=True, text=True, check=True).stdout
            matrix, problems = check_file(text, dialect, 0x600 if base is None else base, extended)
            found += [f"{dialect} {base} {extended}: {p}" for p in problems]
            files += 1
            if base is None:
                if text != (ROOT / "docs/can" / name).read_text():
                    found.append(f"docs/can/{name} is not what `semtrack-dbc --can-dialect {dialect}` writes")
                found += check_golden(matrix, dialect)
    right = (ROOT / "docs/can" / FILES["fd"]).read_text()
    for old, new in PLANTED:
        broken = right.replace(old, new, 1)
        try:
            problems = ["nothing to replace"] if broken == right else []
            problems = [] if problems else check_file(broken, "fd", 0x600, False)[1]
        except Exception as error:  # not even loadable: found as well
            problems = [str(error)]
        if not problems:
            found.append(f"planted: {old} -> {new} was not found")
    for bad in (["--base-id", "0x7F5"], ["--base-id", "0x1FFFFFF5", "--extended"], ["--base-id", "-1"]):
        result = subprocess.run([DBC, *bad], capture_output=True, text=True, check=False)
        if result.returncode != 2 or len(result.stderr.splitlines()) != 1 or result.stdout:
            found.append(f"{bad}: status {result.returncode}, {result.stderr!r}")
    print("\n".join(found[:20]) or f"ok: {files} files, {len(PLANTED)} planted violations found")
    return 1 if found else 0


sys.exit(main())
