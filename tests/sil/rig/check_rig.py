#!/usr/bin/env python3
"""Boxes only, against exact truth. Usage: check_rig.py PROGRAM which_camera|reversing|time_width|duplicates|calibration"""
import json
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish, refused  # noqa: E402
from rig import CAMERA_HEIGHT_M, FRAME_S, SIZE, STANDING, Rig, angle, detection, objects, table, visible_faces

PROGRAM = sys.argv[1]
CARS = [(-4.0, 10.0, -1.5), (3.5, 15.0, -1.6), (-6.0, 22.0, 1.5), (6.0, 30.0, 0.3), (0.5, 40.0, 1.65)]  # x, z, ry
X_LIMIT_M = 0.02
# Short of that today, by camera and z, when the ego stands: an oblique car has two headings with boxes of the same width
# (30 degrees off). The figure may not grow, and a car that is right by now fails the check, so that the row goes.
SHORT_M = {(0, 30.0): 0.07}
FRAMES = 20


def done(result, what):
    check(result.returncode == 0, f"{what}: status {result.returncode}: {result.stderr}")
    return result.returncode == 0


def drive_past(step_m, camera=0):
    """Detections and poses: the ego drives straight on, `step_m` a frame, past the standing cars."""
    rows = [detection(f, x, z - step_m * f, ry, camera) for f in range(FRAMES) for x, z, ry in CARS
            if z - step_m * f > 5.0]
    return rows, [f"1 0 0 0 0 1 0 0 0 0 1 {step_m * f!r}" for f in range(FRAMES)]


def which_camera(tmp):
    for layout in FRAME_S:
        for camera in (0, 2):
            for step_m in (0.0, 0.5):
                what = f"{layout}, boxes of camera {camera}, {step_m} m a frame"
                rig = Rig(PROGRAM, tmp / f"{layout}{camera}{step_m}", layout)
                rows, poses = drive_past(step_m, camera)
                rig.write(rows, FRAMES, poses)
                out = tmp / f"out_{layout}{camera}{step_m}"
                if not done(rig.replay(out, "--detections-camera", camera), what):
                    continue
                last = [o for o in objects(out) if o["frame"] == FRAMES - 1]
                moved = step_m * (FRAMES - 1)
                seen = [c for c in CARS if c[1] - moved > 5.0]
                check(len(last) == len(seen), f"{what}: {len(last)} objects instead of {len(seen)}")
                for o in last:
                    x, z, _ = min(seen, key=lambda c, o=o: math.dist((c[0], c[1] - moved), (o["x"], o["z"])))
                    off = abs(o["x"] - x)
                    short = SHORT_M.get((camera, z)) if step_m == 0.0 else None
                    check(off <= (short or X_LIMIT_M), f"{what}: x {o['x']} instead of {x}")
                    if short:
                        check(off > X_LIMIT_M, f"{what}: the car at {z} m is right by now: {off}")
                        print(f"short: {what}: x is {off:.4f} m off at {z} m, wanted {X_LIMIT_M}")
                    off = angle(o["alpha"] - (o["rotation_y"] - math.atan2(o["x"], o["z"])))
                    check(abs(off) < 1e-12, f"{what}: alpha is off by {off}")


def backing_out(x, z, ry, frames, frame_s):
    """(x, z, ry, speed) a frame: parked for 3 s, backs out on an arc of 10 m with 1.5 m/s, stops, drives off.
    The rear axle runs along the heading."""
    to_middle = 0.31 * SIZE[0]
    x, z = x - to_middle * math.cos(ry), z + to_middle * math.sin(ry)
    speed, path, pieces = 0.0, [], 20
    for i in range(frames * pieces):
        if i % pieces == 0:
            path.append((x + to_middle * math.cos(ry), z - to_middle * math.sin(ry), ry, speed))
        t = i * frame_s / pieces
        acceleration = -2.0 if 3.0 <= t < 3.75 else 2.0 if 6.0 <= t < 6.75 or t >= 7.75 else 0.0
        speed = 0.0 if 6.75 <= t < 7.75 else speed + acceleration * frame_s / pieces
        step = speed * frame_s / pieces
        x, z = x + step * math.cos(ry), z - step * math.sin(ry)
        ry += step * 0.1 if t < 7.75 else 0.0
    return path


def check_backing(what, out, path):
    rows = {o["frame"]: o for o in objects(out)}
    check(len({o["id"] for o in rows.values()}) == 1, f"{what}: one id")
    jumps = [abs(angle(rows[f]["rotation_y"] - rows[f - 1]["rotation_y"])) for f in rows if f > 10 and f - 1 in rows]
    check(math.degrees(max(jumps)) <= 20.0, f"{what}: a heading jump of {math.degrees(max(jumps)):.1f} degrees")
    parked = [angle(rows[f]["rotation_y"] - path[0][2]) for f in range(10, 29)]
    check(math.degrees(max(parked) - min(parked)) <= 3.0, f"{what}: the parked heading spreads")
    check(math.degrees(max(map(abs, parked))) <= 5.0, f"{what}: parked heading {math.degrees(parked[0]):.1f} degrees off")
    backing = [f for f, place in enumerate(path) if place[3] < -1.4]
    slow = [f for f in backing[3:] if rows[f]["speed"] > -0.7]
    check(len(backing) > 15 and not slow, f"{what}: speeds while it backs out: {[rows[f]['speed'] for f in backing]}")
    movement = [row["Movement"] for row in table(out, "list.csv") if row["object"] and row["Movement"] != "0"]  # known
    states = [m for i, m in enumerate(movement) if i == 0 or m != movement[i - 1]]
    # 1 standing, 4 reversing, 1 standing, then 2 moving or 3 oncoming
    check(states[:3] == ["1", "4", "1"] and states[3:] in (["2"], ["3"]), f"{what}: states of movement {states}")


def reversing(tmp):
    frames = 110
    # Without viewpoints one image leaves several headings with the same box, and nothing moves while the car is parked:
    # headings along the road come first, so the car across it starts 49 degrees off, and the one at the right 40.
    for name, (x, z, ry), kinds in (("right", (4.0, 12.0, -math.pi / 2), ("true", "wrong")),
                                    ("left", (-5.0, 14.0, math.pi / 2), ("true", "wrong", "none")),
                                    ("across", (5.0, 14.0, math.pi - 0.2), ("true", "wrong"))):
        path = backing_out(x, z, ry, frames, FRAME_S["tracking"])
        for kind in kinds:
            rig = Rig(PROGRAM, tmp / f"{name}_{kind}")
            rows = []
            for f, (px, pz, heading, _) in enumerate(path):
                h, v = visible_faces(px, pz, heading, 0.0)
                views = (-1, -1) if kind == "none" else ((h + 4) % 8, v) if kind == "wrong" and f < 3 else (h, v)
                rows.append(detection(f, px, pz, heading, 0, views))
            rig.write(rows, frames)
            out = tmp / f"{name}_{kind}_out"
            if done(rig.replay(out, "--detections-camera", 0), f"{name}, {kind} viewpoints"):
                check_backing(f"{name}, {kind} viewpoints", out, path)


def without_times(out):
    """Everything but time columns, the header's stamp and what protects it."""
    files = {n: pathlib.Path(out, n).read_bytes() for n in ("ego.txt", "frames.txt", "objects.txt", "metrics.json")}
    for name in ("ego.csv", "states.csv", "list.csv"):
        files[name] = [{k: v for k, v in row.items() if k not in ("time_us", "ImageTime")} for row in table(out, name)]
    log = [row.split(" ", 1)[1] for row in pathlib.Path(out, "can.log").read_text().splitlines()]
    header = log[0].split("#")[0]
    files["can.log"] = [row for row in log if not row.startswith(header)]
    return files


def time_width(tmp):
    rows, poses = drive_past(0.5)
    seconds = {"zero": 0, "2^31 us": 2146, "2^32 us": 4294, "2^31 s": 2**31 - 1, "2^32 s": 2**32 - 1, "2^33 s": 2**33 - 1}
    stamps = {"1970": "1970-01-01 00:00:00", "2012": "2012-02-29 23:59:59", "2038": "2038-01-19 03:14:07",
              "2106": "2106-02-07 06:28:15"}
    first = {}
    for layout, starts in (("odometry", seconds), ("raw", stamps)):
        for name, start in starts.items():
            rig = Rig(PROGRAM, tmp / f"{layout}_{name}".replace(" ", "_"), layout)
            rig.write(rows, FRAMES, poses)
            if layout == "odometry":
                rig.times.write_text("".join(f"{start + n // 10}.{n % 10}\n" for n in range(FRAMES)))
            else:
                rig.times.write_text("".join(stamp(start, n) for n in range(FRAMES)))
            out = tmp / f"out_{layout}_{name}".replace(" ", "_")
            if done(rig.replay(out), f"{layout} from {name}"):
                found = without_times(out)
                first.setdefault(layout, found)
                for file, content in found.items():
                    check(content == first[layout][file], f"{layout} from {name}: {file} differs")
    check(len(first["raw"]["objects.txt"]) > 5000 and len(first["raw"]["can.log"]) > 50, "the runs found something")


def stamp(start, n):
    import datetime
    at = datetime.datetime.fromisoformat(start) + datetime.timedelta(milliseconds=100 * n)
    return at.strftime("%Y-%m-%d %H:%M:%S.%f") + "000\n"


def duplicates(tmp):
    def run(name, change):
        rig = Rig(PROGRAM, tmp / name)
        rows = [(f, *car, detection(f, *car)) for f in range(FRAMES) for car in CARS]
        rig.write(change(rows), FRAMES)
        out = tmp / (name + "_out")
        result = rig.replay(out, "--detections-camera", 0)
        return objects(out) if done(result, name) else [], json.loads((out / "metrics.json").read_text())["run"]

    def others(rows):  # not the car at 15 m
        return [{k: v for k, v in o.items() if k != "id"} for o in rows if math.dist((o["x"], o["z"]), (3.5, 15)) > 2]

    def ids(rows):
        return {o["id"] for o in rows if math.dist((o["x"], o["z"]), (3.5, 15)) <= 2}

    def plain(rows):
        return [r[-1] for r in rows]

    clean, counts = run("clean", plain)
    check(len(ids(clean)) == 1 and len(others(clean)) > 50, "the clean run has each car")
    second = CARS[1]
    for name, extra in (("twice", lambda f: detection(f, *second)),
                        ("car and van", lambda f: detection(f, *second, kind="Van", score=0.4)),
                        ("van first", lambda f: detection(f, *second, kind="Van", score=0.95))):
        rows, more = run(name, lambda all_rows, extra=extra: plain(all_rows) + [extra(f) for f in range(FRAMES)])
        check(len(ids(rows)) == 1, f"{name}: ids {ids(rows)}")
        check(others(rows) == others(clean), f"{name}: rows of other objects changed")
    odd = {"no width": "3 Car 0.9 400 100 400 150 -1 -1", "inverted": "3 Car 0.9 500 150 400 100 -1 -1",
           "outside": "3 Car 0.9 -90 100 -50 150 -1 -1"}
    for name, row in odd.items():
        rows, more = run(name, lambda all_rows, row=row: plain(all_rows) + [row])
        check(rows == clean, f"{name}: rows changed")
        check(more["detections_dropped_reading"] == counts["detections_dropped_reading"] + 1, f"{name}: counted")
    for name, frame in (("frame -1", -1), ("frame 10^9", 10**9)):
        rows, more = run(name, lambda all_rows, f=frame: plain(all_rows) + [detection(f, *second)])
        check(rows == clean and more["detections_of_no_frame"] == 1, f"{name}: counted, nothing else")
    rows, more = run("empty file", lambda all_rows: [])
    check(rows == [] and more["detection_lists"] == 0, "a file without rows: no lists")


def calibration(tmp):
    def case(name, line, change):
        rig = Rig(PROGRAM, tmp / name)
        rig.write(*([drive_past(0.5)[0], FRAMES]))
        rows = rig.calibration.read_text().splitlines()
        words = rows[line - 1].split()
        change(words)
        rows[line - 1] = " ".join(words)
        rig.calibration.write_text("".join(row + "\n" for row in rows if row.strip()))
        out = tmp / (name + "_out")
        refused(rig.replay(out), name, rig.calibration.name)
        check(not out.exists(), f"{name}: leaves results")

    def put(index, value):
        def change(words):
            words[index] = value
        return change
    # The tracking layout's pair is P2 (row 3), P3 (row 4).
    case("baseline_zero", 4, put(4, repr(float(721.5377 * 0.06))))
    case("baseline_of_wrong_sign", 4, put(4, "400"))
    case("baseline_missing", 4, lambda words: words.pop())
    case("baseline_nan", 4, put(4, "nan"))
    case("no_right_camera", 4, lambda words: words.clear())
    case("focal_lengths_unequal", 4, put(1, "700"))
    case("focal_length_negative", 3, put(1, "-721.5377"))


def main():
    check(CAMERA_HEIGHT_M > SIZE[2] and STANDING.split().count("1") == 3, "the rig itself")
    parts = {"which_camera": which_camera, "reversing": reversing, "time_width": time_width,
             "duplicates": duplicates, "calibration": calibration}
    with tempfile.TemporaryDirectory() as folder:
        parts[sys.argv[2]](pathlib.Path(folder))
    return finish()


if __name__ == "__main__":
    sys.exit(main())
