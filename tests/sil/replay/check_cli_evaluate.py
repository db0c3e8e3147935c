#!/usr/bin/env python3
"""`semtrack-sil evaluate` as a user runs it, on written paths and rows. Usage: check_cli_evaluate.py PROGRAM"""
import json
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish, refused  # noqa: E402
from program import contents, run  # noqa: E402


def pose(z, x=0.0):
    return f"1 0 0 {x!r} 0 1 0 0 0 0 1 {z!r}\n"


STRAIGHT = [pose(float(n)) for n in range(101)]


class Written:
    """A sequence's true path and a folder of results, both as text."""

    def __init__(self, tmp):
        self.root = tmp / "root"
        self.results = tmp / "results"
        (self.root / "poses").mkdir(parents=True)
        self.results.mkdir()

    def put(self, truth, ego, frames):
        (self.root / "poses" / "00.txt").write_text("".join(truth))
        (self.results / "ego.txt").write_text("".join(ego))
        (self.results / "frames.txt").write_text("".join(f"{n}\n" for n in frames))

    def evaluate(self, *more, results=None):
        return run("evaluate", "--results", results or self.results, "--layout", "odometry", "--root", self.root,
                   "--sequence", "00", *more)

    def metrics(self, what, *more):
        result = self.evaluate(*more)
        check(result.returncode == 0, f"{what}: {result.stderr}")
        return json.loads((self.results / "metrics.json").read_text(),
                          parse_constant=lambda c: sys.exit(f"{what}: {c}"))


def paths(written):
    written.put(STRAIGHT, [pose(1.01 * n) for n in range(101)], range(101))
    m = written.metrics("scale 1.01")
    check(abs(m["ate_rmse_m"] - 0.29155) < 5e-6 and abs(m["rpe_trans_mean_m"] - 0.01) < 1e-9, f"scale 1.01: {m}")
    written.put([pose(0.0)] * 30, [pose(0.0)] * 30, range(30))
    m = written.metrics("standing")
    check(m["ate_rmse_m"] == 0 and m["rpe_trans_mean_m"] == 0 and m["segment_trans_percent"] is None, "standing")
    turned = [f"0 0 1 {5 + n!r} 0 1 0 7 -1 0 0 {0.01 * n * n!r}\n" for n in range(61)]
    own = [f"1 0 0 {-0.01 * n * n!r} 0 1 0 0 0 0 1 {float(n)!r}\n" for n in range(61)]
    written.put(turned, own, range(61))
    m = written.metrics("turned and moved")
    check(m["ate_rmse_m"] < 1e-9, f"turned and moved: {m['ate_rmse_m']}")
    check(m["segment_trans_percent"] is None and m["segment_rot_deg_per_100m"] is None, "60 m have no segments")
    written.put(STRAIGHT, [pose(3.0)], [3])
    m = written.metrics("one row")
    check(m["ate_rmse_m"] == 0 and m["rpe_trans_mean_m"] is None, f"one row: {m}")
    kept = [n for n in range(101) if not 40 <= n < 50]
    written.put(STRAIGHT, [pose(float(n)) for n in kept], kept)
    m = written.metrics("gap")
    check(m["ate_rmse_m"] < 1e-9 and m["rpe_trans_mean_m"] < 1e-9 and m["ego_frames_compared"] == 91, f"gap: {m}")


def other_odometries(written, tmp):
    written.put(STRAIGHT, [pose(float(n), 0.003 * (n % 2)) for n in range(101)], range(101))
    others = []
    for name, rhythm in (("b.txt", 2), ("c.txt", 4)):
        (tmp / name).write_text("".join(pose(float(n), 0.01 * ((n // rhythm) % 2)) for n in range(101)))
        others += ["--other", tmp / name]
    agreement = written.metrics("two other odometries", *others)["agreement"]
    check(len(agreement["rpe_trans_mean_m"]) == 2, f"two other odometries: {agreement}")
    check(abs(agreement["own_error_rms_m"] - 0.003) < 1e-3, f"own part of the error: {agreement}")
    (tmp / "b.txt").write_text("".join(STRAIGHT[:100]))
    refused(written.evaluate(*others), "another odometry with a row too few", "b.txt")


def refusals(written, tmp):
    before = contents(written.results)
    for what, frames in (("doubled", [0, 1, 1]), ("falling", [0, 2, 1])):
        written.put(STRAIGHT, STRAIGHT[:3], frames)
        refused(written.evaluate(), what, "frames.txt:3")
    written.put(STRAIGHT, STRAIGHT[:3], [0, 1])
    refused(written.evaluate(), "more poses than frames", "ego.txt")
    written.put(STRAIGHT, STRAIGHT[:2], [0, 1, 2])
    refused(written.evaluate(), "fewer poses than frames", "ego.txt")
    check(contents(written.results)["metrics.json"] == before["metrics.json"], "a refusal left metrics.json alone")
    written.put(STRAIGHT, STRAIGHT[:2], [0, 1])
    objects = written.results / "objects.txt"
    good = "0 1 Car 0 0 0 100 100 150 140 1.5 1.6 3.9 1 1.6 20 0 0.9 0\n"
    objects.write_text(good + good)
    refused(written.evaluate(), "the same frame and id twice", "objects.txt:2")
    objects.write_text(good.replace("3.9", "-3.9"))
    refused(written.evaluate(), "negative length", "objects.txt:1")
    objects.write_text(good)
    check(written.evaluate().returncode == 0, "a good objects.txt")
    (written.results / "frames.txt").unlink()
    refused(written.evaluate(), "no frames.txt", "frames.txt")
    refused(written.evaluate(results=tmp / "nowhere"), "no results", "nowhere")


def main():
    with tempfile.TemporaryDirectory() as folder:
        tmp = pathlib.Path(folder)
        written = Written(tmp)
        paths(written)
        other_odometries(written, tmp)
        refusals(written, tmp)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
