#!/usr/bin/env python3
"""What surrounds the program changes no byte of its results. Usage: check_surroundings.py PROGRAM FLUSHING_LIBRARY

A rendered street with cars, read from files; every run but the first has other surroundings."""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish  # noqa: E402

PROGRAM, LIBRARY = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
FRAMES = 12
SCENARIOS = """{"about": "two of a kind", "defaults": {"replay": {"layout": "world", "detections": "labels", "last": 4}},
 "cases": [{"name": "one", "replay": {"sequence": "street"}, "bounds": {"/frames": {"min": 1}}},
           {"name": "two", "replay": {"sequence": "turning"}, "bounds": {"/frames": {"min": 1}}}]}
"""


def contents(folder):
    """Everything but times and pictures, by name."""
    return {path.name: path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != "timing.csv" and path.suffix != ".png"}


def replay(drive, out, prefix=(), env=None, options=()):
    command = [*prefix, PROGRAM, "replay", "--layout", "odometry", "--root", drive, "--sequence", "00", "--detections",
               drive / "detections/00.txt", "--first", "4", "--no-progress", "--out", out, *options]
    done = subprocess.run([str(word) for word in command], env=env, capture_output=True, text=True, timeout=500)
    check(done.returncode == 0, f"{out.name}: {done.stderr}")
    return contents(out)


def same(wanted, got, what):
    differ = sorted(name for name in wanted.keys() | got.keys() if wanted.get(name) != got.get(name))
    check(not differ, f"{what}: {', '.join(differ)} differ")


def main():
    with tempfile.TemporaryDirectory() as folder:
        tmp = pathlib.Path(folder)
        drive = tmp / "drive"
        done = subprocess.run([PROGRAM, "render", "--scenario", "street", "--layout", "odometry", "--frames",
                               str(FRAMES + 4), "--out", drive], capture_output=True, text=True)
        check(done.returncode == 0, done.stderr)
        wanted = replay(drive, tmp / "plain")
        check(len(wanted["can.log"]) > 2000 and wanted["objects.txt"].count(b"\n") > 20, "the run found something")

        here = os.environ
        flushed = replay(drive, tmp / "flushed", env={**here, "LD_PRELOAD": str(LIBRARY)})
        same(wanted, flushed, "flush to zero, set by a library")
        same(wanted, replay(drive, tmp / "perturbed", env={**here, "MALLOC_PERTURB_": "85"}), "MALLOC_PERTURB_")
        same(wanted, replay(drive, tmp / "bare", env={}), "an empty environment")
        same(wanted, replay(drive, tmp / "full", env={**here, **{f"WORD_{i}": "x" * 1000 for i in range(1000)}}),
             "an environment of a megabyte")
        same(wanted, replay(drive, tmp / "one", prefix=["taskset", "-c", "0"]), "one core")
        deep = tmp.joinpath(*["a folder with a long name and blanks " + "x" * 150] * 5)
        deep.mkdir(parents=True)
        (deep / "drive").symlink_to(drive)
        same(wanted, replay(deep / "drive", deep / "out"), "long paths")
        for workers in (2, 4):
            same(wanted, replay(drive, tmp / f"workers{workers}", options=["--workers", workers]), f"{workers} workers")
        # The check itself: other detections must not pass for the same bytes.
        other = replay(drive, tmp / "other", options=["--detection-delay", "1"])
        check(other["objects.txt"] != wanted["objects.txt"], "late lists change the results")

        scenarios = tmp / "scenarios.json"
        scenarios.write_text(SCENARIOS)
        runs = []
        for jobs in ("1", "4"):
            done = subprocess.run([PROGRAM, "run", "--scenarios", scenarios, "--out", tmp / f"jobs{jobs}", "--jobs", jobs],
                                  capture_output=True, text=True, timeout=500)
            check(done.returncode == 0, f"--jobs {jobs}: {done.stdout} {done.stderr}")
            runs.append({str(path.relative_to(tmp / f"jobs{jobs}")): path.read_bytes()
                         for path in sorted((tmp / f"jobs{jobs}").rglob("*"))
                         if path.name in ("can.log", "ego.txt", "objects.txt", "states.csv")})
        check(len(runs[0]) == 8, f"results of two scenarios: {sorted(runs[0])}")
        same(*runs, "1 and 4 jobs")
    return finish()


if __name__ == "__main__":
    sys.exit(main())
