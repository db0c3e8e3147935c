#!/usr/bin/env python3
"""Time of a frame and of its stages: each frame's minimum over several replays of one drive, ms.
Usage: frame_times.py SEMTRACK_SIL RUNS replay-option... (without --out)
The minimum is what the work takes when nothing else disturbs the core; results of all runs have to be the same bytes."""
import csv
import filecmp
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile


def times(folder):
    with (folder / "timing.csv").open() as file:
        return [{k[:-3]: float(v) / 1e3 for k, v in row.items() if k.endswith("_us")} for row in csv.DictReader(file)]


def minima(runs):
    return [{k: min(row[k] for row in rows) for k in rows[0]} for rows in zip(*runs)]


def main():
    program, count, options = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    runs = []
    with tempfile.TemporaryDirectory() as place:
        for k in range(count):
            folder = pathlib.Path(place) / str(k)
            subprocess.run([program, "replay", *options, "--no-progress", "--out", folder], check=True,
                           stdout=subprocess.DEVNULL)
            runs.append(times(folder))
            for file in os.listdir(folder):
                same = file == "timing.csv" or filecmp.cmp(folder / file, pathlib.Path(place) / "0" / file, shallow=False)
                if not same:
                    sys.exit(f"{file} of run {k} differs from the first run's")
    rows = minima(runs)
    print(f"{len(rows)} frames, each frame's minimum over {count} runs, ms\nstage      median     max  (frame of the maximum)")
    for stage in rows[0]:
        values = [row[stage] for row in rows]
        print(f"{stage:9} {statistics.median(values):7.3f} {max(values):7.3f}  ({values.index(max(values))})")


if __name__ == "__main__":
    main()
