#!/usr/bin/env python3
"""The program as a user runs it. Usage: check_cli.py PROGRAM bad_input|bad_usage|results|repeat

Base data is a rendered street of a few frames, in KITTI's layouts."""
import json
import math
import pathlib
import shutil
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish, refused  # noqa: E402
from program import FRAMES, Drive, contents, edit, grey_png, raw_base, replace_word, run, same_but_timing  # noqa: E402

FILES = ["can.log", "ego.csv", "ego.txt", "frames.txt", "list.csv", "metrics.json", "objects.txt", "states.csv",
         "timing.csv"]


def bad_input(tmp):
    base = raw_base(tmp)

    def case(name, spoil, *names, more=()):
        drive = Drive(base, tmp / name)
        spoil(drive)
        out = tmp / (name + "_out")
        refused(drive.replay(out, *more), name, *names)
        check(not out.exists(), f"{name}: the output folder was left behind")
        shutil.rmtree(drive.folder)

    case("missing_calibration", lambda d: d.calibration.unlink(), "calib_cam_to_cam.txt")
    case("other_size_right", lambda d: d.right(2).write_bytes(grey_png(640, 200)), "0000000002.png")
    case("other_size_left", lambda d: d.left(1).write_bytes(grey_png(1242, 374)), "0000000001.png")
    case("truncated_png", lambda d: d.left(2).write_bytes(d.left(2).read_bytes()[:20000]), "0000000002.png")
    case("empty_png", lambda d: d.right(3).write_bytes(b""), "0000000003.png")
    case("text_in_detections", lambda d: edit(d.detections, 2, replace_word(4, "abc")), d_name(base) + ":2")
    case("nan_in_detections", lambda d: edit(d.detections, 3, replace_word(3, "nan")), d_name(base) + ":3")
    case("infinity_in_detections", lambda d: edit(d.detections, 1, replace_word(2, "inf")), d_name(base) + ":1")
    case("missing_detections", lambda d: d.detections.unlink(), d_name(base))
    case("time_backwards", lambda d: edit(d.times, 3, lambda _: d.times.read_text().splitlines()[0]),
         "timestamps.txt:3")
    case("text_as_time", lambda d: edit(d.times, 2, lambda _: "2026-01-01 noon"), "timestamps.txt:2")
    calibration_line = next(i for i, row in enumerate(
        (base["root"] / base["id"][:10] / "calib_cam_to_cam.txt").read_text().splitlines(), 1)
        if row.startswith("P_rect_01"))
    case("nan_in_calibration", lambda d: edit(d.calibration, calibration_line, replace_word(3, "nan")),
         f"calib_cam_to_cam.txt:{calibration_line}")
    case("no_left_folder", lambda d: shutil.rmtree(d.left(0).parent), "image_00")

    ego = tmp / "ego_poses.txt"
    ego.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1\n")
    case("short_pose_row", lambda d: None, "ego_poses.txt:2", more=("--ego", ego))
    short = tmp / "too_few.txt"
    short.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n")
    case("too_few_poses", lambda d: None, "too_few.txt", more=("--ego", short))
    mount = tmp / "mount.txt"
    mount.write_text("1 0 0 0\n0 1 0 0\n0 0 2 0\n")
    case("mount_is_no_rotation", lambda d: None, "mount.txt:1", more=("--mount", mount))
    mount11 = tmp / "mount11.txt"
    mount11.write_text("0 0 1 0 -1 0 0 0 0 -1 0\n")
    case("mount_with_11_values", lambda d: None, "mount11.txt", more=("--mount", mount11))


def d_name(base):
    return base["detections"].name


def bad_usage(tmp):
    base = raw_base(tmp)
    drive = Drive(base, tmp / "drive")
    out = tmp / "out"

    def case(name, *arguments, names=()):
        refused(drive.replay(out, *arguments), name, *names)
        check(not out.exists(), f"{name}: the output folder was left behind")

    case("first above last", "--first", 3, "--last", 1, names=("--first 3",))
    case("first above the drive's last", "--first", FRAMES, names=(f"--first {FRAMES}",))
    case("last beyond the drive", "--last", FRAMES, names=(f"--last {FRAMES}", f"0 to {FRAMES - 1}"))
    case("negative first", "--first=-1")
    case("number with a tail", "--last", "3x")
    case("cues with other letters", "--cues", "SX", names=("--cues",))
    case("cues without S", "--cues", "M", names=("--cues",))
    case("features without images", "--images", "none", "--ego", drive.sync / "poses.txt", "--cues", "SF",
         names=("--cues",))
    case("simulated features", "--features", "simulated", names=("--features simulated",))
    case("delay of 4", "--detection-delay", 4, names=("--detection-delay",))
    case("no poses without images", "--images", "none", names=("--ego",))
    case("image size that is none", "--images", "none", "--ego", drive.sync / "poses.txt", "--image-size", "12a",
         names=("--image-size",))
    case("image size beyond the capacity", "--images", "none", "--ego", drive.sync / "poses.txt", "--image-size",
         "4000x4000", names=("--image-size",))
    case("CAN ids beyond 11 bits", "--base-id", "0x7F5", names=("--base-id",))
    case("no worker", "--workers", "0", names=("--workers",))
    case("too many workers", "--workers", "9", names=("--workers",))
    case("camera below the road", "--camera-height", "-1", names=("--camera-height",))
    case("camera height that is no number", "--camera-height", "nan", names=("--camera-height",))
    case("simulated sensors of a recorded drive", "--vehicle-motion", "simulated", names=("--vehicle-motion",))
    case("a motion file that is not there", "--vehicle-motion", tmp / "no_motion.txt", names=("no_motion.txt",))
    case("unknown option", "--speed", "3")
    case("camera 1 of the detections", "--detections-camera", "1", names=("--detections-camera",))
    refused(run(), "no command")
    refused(run("drive"), "unknown command")
    refused(run("replay", "--layout", "nuscenes", "--sequence", "1", "--out", out), "unknown layout", "--layout")
    refused(run("replay", "--layout", "raw", "--sequence", base["id"], "--out", out), "no root", "--root")
    refused(run("replay", "--layout", "raw", "--root", drive.folder, "--sequence",
                "2026_01_01_drive_0077", "--out", out), "unknown sequence", "2026_01_01_drive_0077")
    refused(run("replay", "--layout", "world", "--sequence", "moon", "--out", out), "unknown scenario", "moon")
    refused(run("render", "--scenario", "moon", "--layout", "raw", "--out", out), "unknown scenario to render", "moon")
    check(not out.exists(), "the output folder was left behind")

    file_in_the_way = tmp / "file"
    file_in_the_way.write_text("mine")
    refused(drive.replay(file_in_the_way), "a file as output folder", "file")
    refused(drive.replay(file_in_the_way / "out"), "an output folder below a file", "file")
    refused(drive.replay("/proc/semtrack_out"), "an output folder in /proc", "/proc/semtrack_out")
    check(file_in_the_way.read_text() == "mine", "the file in the way was changed")

    help_text = run("replay", "--help")
    check(help_text.returncode == 0 and "--detection-delay" in help_text.stdout, "--help shows the options")


def results(tmp):
    base = raw_base(tmp)
    drive = Drive(base, tmp / "drive")
    out = tmp / "some" / "where" / "out"
    done = drive.replay(out, "--points", "--pictures")
    check(done.returncode == 0, f"replay: {done.stderr}")
    check(done.stderr == "", f"replay is silent on stderr: {done.stderr!r}")
    check(sorted(p.name for p in out.iterdir()) == sorted(FILES + ["points.csv", "pictures"]),
          f"files: {sorted(p.name for p in out.iterdir())}")
    ego = (out / "ego.txt").read_text().splitlines()
    check([len(row.split()) for row in ego] == [12] * FRAMES, "ego.txt: 12 values a row, a row a frame")
    check([float(x) for x in ego[0].split()] == [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], "ego.txt starts at the identity")
    check((out / "frames.txt").read_text().split() == [str(n) for n in range(FRAMES)], "frames.txt")
    for name, columns in (("ego.csv", 10), ("states.csv", 21), ("timing.csv", 15), ("points.csv", 5)):
        rows = (out / name).read_text().splitlines()
        check(len(rows) > 1 and all(len(row.split(",")) == columns for row in rows), f"{name}: {columns} columns")
    metrics = json.loads((out / "metrics.json").read_text(), parse_constant=lambda c: sys.exit(f"metrics: {c}"))
    check(metrics["frames"] == FRAMES and metrics["ate_rmse_m"] < 0.2, "metrics.json")
    check("/" not in (out / "metrics.json").read_text(), "metrics.json holds no path")
    keys = []
    for row in (out / "objects.txt").read_text().splitlines():
        words = row.split()
        check(len(words) == 19, "objects.txt: 19 columns")
        keys.append((int(words[0]), int(words[1])))
        alpha, x, z, rotation_y = (float(words[i]) for i in (5, 13, 15, 16))
        off = alpha - (rotation_y - math.atan2(x, z))
        check(abs(off - round(off / (2 * math.pi)) * 2 * math.pi) < 1e-12, "alpha = rotation_y - atan2(x, z)")
        check(-math.pi <= alpha < math.pi and -math.pi <= rotation_y < math.pi, "angles are wrapped")
    check(keys and keys == sorted(set(keys)), "objects.txt is sorted by frame and id")

    # A failed run leaves everything as it is; a good one leaves nothing old beside its own.
    (out / "notes.md").write_text("mine")
    before = contents(out)
    spoiled = Drive(base, tmp / "spoiled")
    spoiled.right(3).write_bytes(b"no png")
    refused(spoiled.replay(out), "a broken image at the end", "0000000003.png")
    check(contents(out) == before, "a failed run changed old results")
    check(not any(p.name.startswith(".") for p in out.iterdir()), "a failed run left its working folder")
    check(drive.replay(out).returncode == 0, "second run")
    check(sorted(p.name for p in out.iterdir()) == sorted(FILES + ["notes.md"]),
          f"old results stayed: {sorted(p.name for p in out.iterdir())}")

    # The vehicle's own sensors.
    done = drive.replay(tmp / "sensors", "--vehicle-motion", drive.sync / "vehicle_motion.txt")
    check(done.returncode == 0, f"vehicle motion: {done.stderr}")
    metrics = json.loads((tmp / "sensors" / "metrics.json").read_text())
    check(metrics["run"]["vehicle_motions"] == FRAMES and metrics["ate_rmse_m"] < 0.2, "every image had its motion")

    # A frame that was dropped in the middle is predicted.
    gap = Drive(base, tmp / "gap")
    gap.left(2).unlink()
    gap.right(2).unlink()
    done = gap.replay(tmp / "gap_out")
    check(done.returncode == 0 and "1 of them dropped" in done.stdout, f"dropped frame: {done.stdout}{done.stderr}")
    check((tmp / "gap_out" / "frames.txt").read_text().split() == [str(n) for n in range(FRAMES)],
          "a dropped frame has its row")
    metrics = json.loads((tmp / "gap_out" / "metrics.json").read_text())
    check(metrics["run"]["frames_dropped"] == 1, "metrics.json counts the dropped frame")
    rows = (tmp / "gap_out" / "ego.csv").read_text().splitlines()
    check(rows[3].split(",")[2] == "predicted", f"status of a dropped frame: {rows[3]}")

    # Boxes only, and a part of the drive.
    done = drive.replay(tmp / "boxes", "--images", "none", "--ego", drive.sync / "poses.txt", "--first", "1")
    check(done.returncode == 0, f"boxes only: {done.stderr}")
    metrics = json.loads((tmp / "boxes" / "metrics.json").read_text())
    check(metrics["frames"] == FRAMES - 1 and metrics["ate_rmse_m"] < 1e-9, "given poses are taken as they are")
    for delay in range(4):
        done = drive.replay(tmp / "late", "--detection-delay", delay, "--no-progress")
        metrics = json.loads((tmp / "late" / "metrics.json").read_text())
        check(done.returncode == 0 and metrics["run"]["detection_lists"] == FRAMES - delay, f"delay {delay}")
        check(metrics["run"]["detection_lists_too_late"] == 0, f"delay {delay}: no list is too late")


def repeat(tmp):
    # Twice the same bytes, whatever the surroundings say.
    base = raw_base(tmp)
    drive = Drive(base, tmp / "drive with blanks")
    check(drive.replay(tmp / "a", "--points").returncode == 0, "first run")
    check(drive.replay(tmp / "b", "--points", env={"TZ": "Asia/Kolkata", "LC_ALL": "de_DE.UTF-8",
                                                   "MALLOC_PERTURB_": "85"}).returncode == 0, "second run")
    a = contents(tmp / "a")
    same_but_timing(a, contents(tmp / "b"), "second run")
    check(len(a["objects.txt"]) > 1000 and len(a["can.log"]) > 100, "the runs found something")

    # evaluate gives the bytes that replay gave.
    result = run("evaluate", "--results", tmp / "a", "--layout", "raw", "--root", drive.folder, "--sequence", drive.id)
    check(result.returncode == 0, f"evaluate: {result.stderr}")
    same_but_timing(contents(tmp / "a"), contents(tmp / "b"), "evaluate")

    # Text forms that must not matter.
    crlf = Drive(base, tmp / "crlf")
    for path in (crlf.times, crlf.detections, crlf.calibration, crlf.sync / "poses.txt"):
        path.write_bytes(path.read_bytes().replace(b"\n", b" \t\r\n"))
    (crlf.left(0).parent / "._0000000001.png").write_bytes(b"foreign")
    (crlf.left(0).parent / "Thumbs.db").write_bytes(b"foreign")
    check(crlf.replay(tmp / "c", "--points").returncode == 0, "CRLF")
    same_but_timing(contents(tmp / "b"), contents(tmp / "c"), "CRLF")

    # The rendered street itself, twice.
    for name in ("w1", "w2"):
        done = run("replay", "--layout", "world", "--sequence", "street", "--detections", "labels", "--last", "3",
                   "--out", tmp / name)
        check(done.returncode == 0, f"world: {done.stderr}")
    same_but_timing(contents(tmp / "w1"), contents(tmp / "w2"), "world")
    # On disk its calibration and detections are rounded.
    disk, memory = ([float(x) for x in (tmp / name / "ego.txt").read_text().split()] for name in ("a", "w1"))
    check(len(disk) == len(memory) and all(abs(p - q) < 0.01 for p, q in zip(disk, memory)),
          "the street on disk and in memory give one path")


def main():
    with tempfile.TemporaryDirectory() as folder:
        {"bad_input": bad_input, "bad_usage": bad_usage, "results": results,
         "repeat": repeat}[sys.argv[2]](pathlib.Path(folder))
    return finish()


if __name__ == "__main__":
    sys.exit(main())
