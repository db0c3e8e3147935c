#!/usr/bin/env python3
"""Draws docs/pictures/load.png: cost of a frame against objects and against features of the background.
Usage: load.py BUILD_DIR (needs python3-matplotlib and valgrind)

Scenes of semtrack-budget-scene; milliseconds: each frame's minimum over five runs, median of the frames;
instructions: callgrind, mean of the same frames. Prints the rows, and how far they lie from a straight line."""
import pathlib
import statistics
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "tests/gates"))
import check_instructions as instructions  # noqa: E402

FRAMES, FIRST, RUNS = 14, 8, 5  # windows are full from frame 8 on
OBJECTS = (0, 1, 2, 4, 8, 16, 32)
FEATURES = (64, 128, 192, 256, 320, 384, 448, 512)
OBJECT_FEATURES = 100


def measure(build, scene, background):
    """(ms, million instructions, objects, background features, object features) of a frame"""
    arguments = [str(scene), str(background), str(OBJECT_FEATURES)]
    out = subprocess.run([build / "bin/semtrack-time-run", *arguments, str(RUNS), str(FIRST)], check=True,
                         capture_output=True, text=True).stdout
    rows = {row.split()[0]: float(row.split()[1]) for row in out.splitlines()}
    frames = instructions.by_frame(instructions.callgrind(build / "bin/semtrack-count-run", arguments))[FIRST:]
    counted = statistics.mean(sum(f.values()) for f in frames) / 1e6
    return rows["frame"], counted, rows["measured_objects"], rows["background_features"], rows["object_features"]


def line(x, y):
    slope = statistics.covariance(x, y) / statistics.variance(x)
    return statistics.mean(y) - slope * statistics.mean(x), slope


def draw(axis, x, rows, label):
    ms, counted = [r[0] for r in rows], [r[1] for r in rows]
    offset, slope = line(x, counted)
    off = max(abs(offset + slope * a - b) for a, b in zip(x, counted)) / max(counted)
    print(f"{label}: {offset:.1f} + {slope:.3f} x million instructions, at most {100 * off:.1f} % of the largest off")
    axis.plot(x, counted, "o", color="tab:blue", label="instructions")
    axis.plot(x, [offset + slope * a for a in x], "-", color="tab:blue", linewidth=0.8, label="straight line")
    axis.set_xlabel(label)
    axis.set_ylabel("instructions a frame [million]", color="tab:blue")
    axis.set_ylim(0, 1.1 * max(counted))
    time = axis.twinx()
    time.plot(x, ms, "x", color="tab:red")
    time.set_ylabel("time a frame [ms]", color="tab:red")
    time.set_ylim(0, 1.1 * max(ms))
    axis.legend(loc="upper left", frameon=False)


def main():
    build = pathlib.Path(sys.argv[1])
    by_objects, by_features, filled = [], [], []
    with tempfile.TemporaryDirectory() as place:
        for objects in OBJECTS:
            scene = pathlib.Path(place) / f"{objects}"
            subprocess.run([build / "bin/semtrack-budget-scene", "load", scene, str(FRAMES), str(objects)], check=True)
            by_objects.append(measure(build, scene, 200))
            print(f"{objects} objects: %.2f ms, %.1f M instructions; measured: %.0f objects, %.0f + %.0f features" %
                  by_objects[-1], flush=True)
        for features in FEATURES:
            by_features.append(measure(build, pathlib.Path(place) / "4", features))
            filled.append(by_features[-1][3])
            print(f"{features} features: %.2f ms, %.1f M instructions; measured: %.0f objects, %.0f + %.0f features" %
                  by_features[-1], flush=True)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    draw(left, OBJECTS, by_objects, f"objects, up to {OBJECT_FEATURES} features each (200 of the background)")
    draw(right, filled, by_features, "features of the background (4 objects)")
    figure.tight_layout()
    figure.savefig(HERE / "load.png", dpi=80, metadata={"Software": None})


if __name__ == "__main__":
    main()
