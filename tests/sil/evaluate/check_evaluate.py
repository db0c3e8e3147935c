#!/usr/bin/env python3
"""Results and labels made by hand, judged by `evaluate`. Usage: check_evaluate.py PROGRAM objects|overlap

Labels in KITTI's tracking layout: no images, an ego that stands, a plain calibration."""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish  # noqa: E402

PROGRAM = sys.argv[1]
POSE = "1 0 0 0 0 1 0 0 0 0 1 0"
CALIBRATION = "\n".join(f"P{i}: 721.5 0 609.5 {-721.5 * 0.54 * (i % 2):.6f} 0 721.5 172.9 0 0 0 1 0" for i in range(4))


def box2d(x, z):
    """A 2D box by place, so that objects in different places have different boxes."""
    u = 609.5 + 721.5 * x / z
    return f"{u - 30:.2f} 160 {u + 30:.2f} 210"


def label(frame, ident, x, z, ry=0.0, kind="Car", size=(1.5, 2.0, 4.0), box=None):
    return f"{frame} {ident} {kind} 0 0 0 {box or box2d(x, z)} {size[0]} {size[1]} {size[2]} {x} 1.65 {z} {ry}"


def result(frame, ident, x, z, ry=0.0, score=0.5, kind="Car", size=(1.5, 2.0, 4.0), box=None):
    return label(frame, ident, x, z, ry, kind, size, box) + f" {score} 0"


class Folder:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.count = 0

    def evaluate(self, labels, results, frames=1, ego=None):
        self.count += 1
        base = self.root / str(self.count)
        training = base / "training"
        for name in ("calib", "label_02", "ego_pose"):
            (training / name).mkdir(parents=True)
        (training / "calib" / "0001.txt").write_text(CALIBRATION + "\n")
        (training / "label_02" / "0001.txt").write_text("".join(row + "\n" for row in labels))
        (training / "ego_pose" / "0001.txt").write_text((POSE + "\n") * frames)
        out = base / "out"
        out.mkdir()
        (out / "ego.txt").write_text(ego if ego is not None else (POSE + "\n") * frames)
        (out / "frames.txt").write_text("".join(f"{i}\n" for i in range(frames)))
        (out / "objects.txt").write_text("".join(row + "\n" for row in results))
        run = subprocess.run([PROGRAM, "evaluate", "--layout", "tracking", "--root", str(base), "--sequence", "0001",
                              "--results", str(out)], capture_output=True, text=True, timeout=250, check=False)
        if run.returncode != 0:
            return run, None
        return run, json.loads((out / "metrics.json").read_text(), parse_constant=lambda c: sys.exit(f"not JSON: {c}"))


def ap(metrics, overlap="birdseye_0.5", difficulty="moderate", rules="kitti"):
    return metrics["average_precision"][rules][overlap][difficulty]


def check_objects(folder):
    four = [label(0, i, 6.0 * i - 9.0, 20.0) for i in range(4)]
    found = [result(0, i, 6.0 * i - 9.0, 20.0) for i in range(4)]

    area = label(0, -1, -1000, -1000, kind="DontCare", size=(-1, -1, -1), box="900 160 1000 210")
    _, m = folder.evaluate(four + [area], found + [result(0, 8, 20, 35, box="910 162 960 208"),
                                                   result(0, 9, 30, 40, box="1100 160 1160 210")])
    for overlap in ("birdseye_0.5", "3d_0.5"):
        check(ap(m, overlap)["false_alarms"] == 1, f"one in a DontCare area, one outside: {overlap} {ap(m, overlap)}")
    check(m["tracking"]["false_alarms"] == 1, "tracking: one false alarm")

    van = label(0, 5, 16, 20, kind="Van")
    _, m = folder.evaluate(four + [van], found + [result(0, 5, 16, 20)])
    check(ap(m)["false_alarms"] == 0 and ap(m)["hits"] == 4 and ap(m)["labels"] == 4, "a van found as car is ignored")

    run, m = folder.evaluate(four, found[:3] + [result(0, 3, 9, 20, box="-1 -1 -1 -1")])
    check(run.returncode == 2 and "objects.txt:4" in run.stderr, f"a result without 2D box: {run.stderr!r}")

    _, m = folder.evaluate(four, [])
    check(m["tracking"]["mota"] == 0 and m["tracking"]["hota"] == 0 and m["tracking"]["motp"] is None, "empty results")
    check(ap(m)["ap11"] == 0 and ap(m)["ap40"] == 0, "empty results: AP 0")
    _, m = folder.evaluate([], found)
    check(m["tracking"] is None or m["tracking"]["mota"] is None, "empty labels")
    check(m["average_precision"] is None or ap(m)["ap11"] is None, "empty labels: AP null")

    run, _ = folder.evaluate(four, found + [found[0]])
    check(run.returncode == 2 and "objects.txt:5" in run.stderr, f"the same frame and id twice: {run.stderr!r}")
    for bad in (0.0, -4.0):
        run, _ = folder.evaluate(four, found[:1] + [result(0, 7, 0, 30, size=(1.5, 2.0, bad))])
        check(run.returncode == 2 and "objects.txt:2" in run.stderr, f"length {bad}: {run.stderr!r}")

    _, m = folder.evaluate(four, found[:1])
    check(abs(ap(m)["ap11"] - 300 / 11) < 1e-9 and abs(ap(m)["ap40"] - 25) < 1e-9, f"one of four: {ap(m)}")

    lost = [result(0, 7, 0.3, 20), result(2, 7, 0.3, 20), result(2, 8, 0, 20)]
    _, m = folder.evaluate([label(f, 1, 0, 20) for f in range(3)], lost, frames=3)
    check(m["tracking"]["id_switches"] == 1, f"lost and regained while another is nearer: {m['tracking']}")


def random_cars(count):
    rng = random.Random(7)
    cars = []
    for i in range(count):
        ry = rng.choice([rng.uniform(-math.pi, math.pi), rng.randint(-4, 3) * math.pi / 4,
                         math.copysign(math.pi - 10 ** rng.uniform(-15, -6), rng.uniform(-1, 1))])
        cars.append((i // 10, i, 12.0 * (i % 10) - 54.0, rng.uniform(15, 60), ry))
    return cars


def check_overlap(folder):
    cars = random_cars(20000)
    box = "{0:.0f} 160 {1:.0f} 210"

    def boxed(i):
        return box.format(10 + 120 * (i % 10), 70 + 120 * (i % 10))

    def judged(change, name, want):
        rows = []
        for frame, ident, x, z, ry in cars:
            dx, dz, turn = change(ry)
            rows.append(result(frame, ident, x + dx, z + dz, ry + turn, box=boxed(ident)))
        labels = [label(f, i, x, z, ry, box=boxed(i)) for f, i, x, z, ry in cars]
        _, m = folder.evaluate(labels, rows, frames=2000)
        for overlap, value in want.items():
            for score in ("ap11", "ap40"):
                got = ap(m, overlap, "easy")[score]
                check(abs(got - value) < 1e-9, f"{name}: {overlap} {score} {got} instead of {value}")

    def along(metres):
        return lambda ry: (metres * math.cos(ry), -metres * math.sin(ry), 0.0)

    everything = {f"{kind}_{t}": 100.0 for kind in ("birdseye", "3d") for t in ("0.25", "0.5", "0.7")}
    nothing = {name: 0.0 for name in everything}
    third = {"birdseye_0.25": 100.0, "3d_0.25": 100.0, "birdseye_0.5": 0.0, "3d_0.5": 0.0}
    judged(lambda ry: (0.0, 0.0, 0.0), "equal", everything)
    judged(lambda ry: (0.0, 0.0, math.pi), "heading + pi", everything)
    judged(along(4.0), "moved by its own length", nothing)
    judged(along(2.0), "moved by half its length", third)
    judged(lambda ry: (0.0, 0.0, math.pi / 2), "turned by 90 degrees", third)
    judged(lambda ry: (1e-9, 1e-9, 0.0), "moved by a nanometre", everything)


def main():
    with tempfile.TemporaryDirectory() as root:
        {"objects": check_objects, "overlap": check_overlap}[sys.argv[2]](Folder(root))
    return finish()


if __name__ == "__main__":
    sys.exit(main())
