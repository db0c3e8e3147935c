#!/usr/bin/env python3
"""Detectors that are less than perfect. Usage: check_detectors.py SEMTRACK_SIL KITTI_DIR

Drive 0039 with lists of every other frame, with lists three frames late, and without viewpoints: each keeps at least
70 % of the rows of objects.txt that complete lists on time give, and of the cars found."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish  # noqa: E402

SIL = sys.argv[1]
RAW = pathlib.Path(sys.argv[2]) / "raw"
DETECTIONS = RAW / "2011_09_26/2011_09_26_drive_0039_sync/detections"
LEAST_SHARE = 0.70
DELAY = 3


def replay(folder, name, detections, *options):
    """Rows of objects.txt, and metrics.json."""
    out = folder / name
    result = subprocess.run([SIL, "replay", "--layout", "raw", "--root", RAW, "--sequence", "2011_09_26_drive_0039",
                             "--first", "19", "--last", "330", "--detections", detections, "--no-progress", "--out", out,
                             *options], capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{name}: status {result.returncode}: {result.stderr}")
    if result.returncode != 0:
        return 0, {}
    return len((out / "objects.txt").read_text().splitlines()), json.loads((out / "metrics.json").read_text())


def without_viewpoints(source, target):
    rows = [row.split() for row in source.read_text().splitlines()]
    target.write_text("".join(" ".join([*r[:7], "-1", "-1"]) + "\n" for r in rows))
    return target


with tempfile.TemporaryDirectory() as work:
    folder = pathlib.Path(work)
    complete = DETECTIONS / "detector_10hz.txt"
    rows, metrics = replay(folder, "on_time", complete)
    check(rows > 1000, f"on time: {rows} rows only")
    print(f"on time: {rows} rows, {metrics['car_recall']:.3f} of the cars")
    for name, arguments in {
            "every other frame": (DETECTIONS / "detector_5hz.txt",),
            f"{DELAY} frames late": (complete, "--detection-delay", str(DELAY)),
            "no viewpoints": (without_viewpoints(complete, folder / "no_viewpoints.txt"),)}.items():
        here, found = replay(folder, name.replace(" ", "_"), *arguments)
        share, recall = here / max(1, rows), found.get("car_recall", 0.0) / metrics["car_recall"]
        print(f"{name}: {here} rows, {share:.3f} of them; cars {recall:.3f} of those found on time")
        check(share >= LEAST_SHARE, f"{name}: {share:.3f} of the rows")
        check(recall >= LEAST_SHARE, f"{name}: {recall:.3f} of the cars")
        check(here <= 1.1 * rows, f"{name}: {here} rows, more than there are objects")
    nothing, _ = replay(folder, "none", "none")  # so that the bound can break
    check(nothing < LEAST_SHARE * rows, f"without detections there are {nothing} rows")
sys.exit(finish())
