#!/usr/bin/env python3
"""Whole replays against bounds. Usage: check_drive.py SEMTRACK_SIL world
                                        check_drive.py SEMTRACK_SIL kitti KITTI_DIR

world: the rendered street, with bounds that break when a stage is switched off (tried, one stage after the other).
kitti: drive 0039 frames 19 to 330 with a real detector's boxes, twice: bounds, and the same bytes in every file but
timing.csv."""
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

from boxes import overlap

SIL = sys.argv[1]

# name, highest value (lowest for shares); measured: see docs/testing.md
AT_LEAST = {"car_recall", "features/stereo_share", "stereo/within_2px", "stereo/within_1_5px_by_truth"}
WORLD_BOUNDS = {"ate_rmse_m": 0.05, "rpe_trans_mean_m": 0.004, "rpe_rot_mean_deg": 0.006,
                "car_position_mean_percent": 4.0, "car_heading_median_deg": 4.0, "moving_car_speed_median_mps": 0.3,
                "parked_car_speed_median_mps": 0.1, "car_recall": 0.85, "features/stereo_share": 0.75,
                "stereo/within_1_5px_by_truth": 0.95, "stereo/label_depth_median_percent": 3.0}
# Cues without one stage, and a bound that has to break.
WITHOUT_A_STAGE = {"SMG": "moving_car_speed_median_mps",      # no features
                   "SFG": "moving_car_speed_median_mps",      # no motion model
                   "SFM": "car_position_mean_percent"}        # no alignment, no ground contact
KITTI_BOUNDS = {"ate_rmse_m": 0.25, "rpe_trans_mean_m": 0.0155, "rpe_rot_mean_deg": 0.0425,
                "car_position_mean_percent": 3.5, "parked_car_speed_median_mps": 0.1, "car_recall": 0.90,
                "features/stereo_share": 0.75, "stereo/within_2px": 0.95, "stereo/label_depth_median_percent": 3.0}
MEDIAN_FRAME_TARGET_MS = 10.0
MAX_TRUCK_SPEED_ERROR = 0.6
MAX_PARKED_SPEED = 1.5
SETTLED_AGE = 8


def run(*arguments):
    result = subprocess.run([SIL, *map(str, arguments)], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: status {result.returncode}: {result.stderr}")
    return result.stdout


def value_of(metrics, name):
    for key in name.split("/"):
        metrics = metrics[key]
    return metrics


def broken(metrics, bounds):
    """Names of the bounds that do not hold."""
    def holds(name, bound):
        value = value_of(metrics, name)
        return value is not None and (value >= bound if name in AT_LEAST else value <= bound)
    return [name for name, bound in bounds.items() if not holds(name, bound)]


def show(metrics, bounds):
    for name, bound in bounds.items():
        print(f"  {name:34} {value_of(metrics, name):.4f}  bound {bound}")


def replay(out, *arguments):
    run("replay", *arguments, "--out", out)
    return json.loads((out / "metrics.json").read_text())


def check_world(folder):
    words = run("render", "--scenario", "street", "--layout", "raw", "--out", folder / "drive").split()
    drive = ["--layout", "raw", "--root", folder / "drive", "--sequence", words[words.index("--sequence") + 1],
             "--detections", words[words.index("--detections") + 1]]
    metrics = replay(folder / "all", *drive)
    show(metrics, WORLD_BOUNDS)
    problems = [f"{name} is {value_of(metrics, name)}" for name in broken(metrics, WORLD_BOUNDS)]
    for cues, name in WITHOUT_A_STAGE.items():
        metrics = replay(folder / cues, *drive, "--cues", cues)
        print(f"  cues {cues} only: {name} {value_of(metrics, name):.4f}")
        if name not in broken(metrics, WORLD_BOUNDS):
            problems.append(f"with the cues {cues} alone {name} still holds: {value_of(metrics, name)}")
    return problems


def truck_speed_error(drive, results):
    """Label track 36, frames 260 to 308: median of the published speed's error; truth from labels 0.8 s apart."""
    poses = dict(zip((int(x) for x in (drive / "frames.txt").read_text().split()),
                     ([float(v) for v in row.split()] for row in (drive / "poses.txt").open())))
    labels = {int(r[0]): [float(v) for v in r[3:]] for r in map(str.split, (drive / "label_02/0039.txt").open())
              if r[1] == "36"}
    rows = [r.split() for r in (results / "objects.txt").open()]

    def place(frame):  # in the world of poses.txt
        p = poses[frame]
        x = labels[frame][10:13]
        return [sum(p[4 * i + k] * x[k] for k in range(3)) + p[4 * i + 3] for i in range(3)]

    errors = []
    for frame in sorted(labels):
        near = [(overlap(labels[frame][3:7], [float(v) for v in r[6:10]]), float(r[18])) for r in rows
                if int(r[0]) == frame]
        best = max(near, default=(0.0, 0.0))
        if best[0] >= 0.5 and frame - 4 in labels and frame + 4 in labels:
            errors.append(abs(best[1] - math.dist(place(frame - 4), place(frame + 4)) / 0.8))
    return statistics.median(errors), len(errors)


def fastest_car(results):
    """(m/s, frame, id) among settled cars and vans, coasting ones too: on this drive all of them are parked."""
    with (results / "states.csv").open(newline="") as file:
        return max((abs(float(r["speed"])), int(r["frame"]), int(r["id"])) for r in csv.DictReader(file)
                   if r["class"] in ("Car", "Van") and int(r["age"]) >= SETTLED_AGE)


def check_kitti(folder, kitti):
    drive = kitti / "raw/2011_09_26/2011_09_26_drive_0039_sync"
    arguments = ["--layout", "raw", "--root", kitti / "raw", "--sequence", "2011_09_26_drive_0039", "--first", 19,
                 "--last", 330, "--detections", drive / "detections/detector_10hz.txt"]
    metrics = replay(folder / "one", *arguments)
    replay(folder / "two", *arguments)
    show(metrics, KITTI_BOUNDS)
    problems = [f"{name} is {value_of(metrics, name)}" for name in broken(metrics, KITTI_BOUNDS)]
    error, frames = truck_speed_error(drive, folder / "one")
    print(f"  truck: speed off by {error:.3f} m/s (median of {frames} frames)  bound {MAX_TRUCK_SPEED_ERROR}")
    if error > MAX_TRUCK_SPEED_ERROR or frames < 15:
        problems.append(f"truck: {error} m/s over {frames} frames")
    speed, frame, car = fastest_car(folder / "one")
    print(f"  parked cars: {speed:.2f} m/s at most (frame {frame}, id {car})  bound {MAX_PARKED_SPEED}")
    if speed > MAX_PARKED_SPEED:
        problems.append(f"parked car {car} seems to drive at {speed} m/s in frame {frame}")
    times = [float(row.split(",")[1]) for row in (folder / "one/timing.csv").read_text().splitlines()[1:]]
    median_ms = statistics.median(times) / 1000.0
    print(f"  time: {median_ms:.1f} ms a frame (median)  target {MEDIAN_FRAME_TARGET_MS}, reported only: a clock is no test")
    for file in sorted(p.name for p in (folder / "one").iterdir()):
        if file != "timing.csv" and (folder / "one" / file).read_bytes() != (folder / "two" / file).read_bytes():
            problems.append(f"{file} differs between two runs")
    return problems


with tempfile.TemporaryDirectory() as work:
    if sys.argv[2] == "world":
        found = check_world(pathlib.Path(work))
    else:
        found = check_kitti(pathlib.Path(work), pathlib.Path(sys.argv[3]))
print("\n".join(found) or "ok")
sys.exit(1 if found else 0)
