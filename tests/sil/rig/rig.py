"""Boxes only: exact 3D boxes of cars, projected into detections, with given ego poses and no images. Truth is exact.

Frames and axes are KITTI's: camera 0 is rectified, x right, y down, z ahead; a car is (x, z) of its bottom's middle on
the level road below the camera, and rotation_y."""
import csv
import math
import pathlib
import subprocess

SIZE = (3.88, 1.63, 1.53)  # length, width, height, m
CAMERA_HEIGHT_M = 1.65
F, CU, CV = 721.5377, 609.5593, 172.854
WIDTH, HEIGHT = 1242, 375
BASELINE_M = 0.54
CAMERA2_M = 0.06  # camera 2 stands so far to the left of camera 0
FRAME_S = {"raw": 0.1, "odometry": 0.1, "tracking": 0.1036}
STANDING = "1 0 0 0 0 1 0 0 0 0 1 0"
FACES = {("right",): 0, ("front", "right"): 1, ("front",): 2, ("front", "left"): 3, ("left",): 4, ("rear", "left"): 5,
         ("rear",): 6, ("rear", "right"): 7}


def visible_faces(x, z, ry, camera_x):
    """The h_view that a camera at (camera_x, 0) sees; the v_view."""
    dx, dz = camera_x - x, -z
    along = dx * math.cos(ry) - dz * math.sin(ry)
    across = dx * math.sin(ry) + dz * math.cos(ry)
    faces = []
    if abs(along) > SIZE[0] / 2:
        faces.append("front" if along > 0 else "rear")
    if abs(across) > SIZE[1] / 2:
        faces.append("left" if across > 0 else "right")
    return FACES[tuple(faces)], 1 if CAMERA_HEIGHT_M > SIZE[2] else 0


def box(x, z, ry, camera=0):
    """left, top, right, bottom of the projected corners, clipped; None: not in the image."""
    camera_x = -CAMERA2_M if camera == 2 else 0.0
    us, vs = [], []
    for a in (-0.5, 0.5):
        for b in (-0.5, 0.5):
            cx = x + a * SIZE[0] * math.cos(ry) + b * SIZE[1] * math.sin(ry) - camera_x
            cz = z - a * SIZE[0] * math.sin(ry) + b * SIZE[1] * math.cos(ry)
            if cz < 0.5:
                return None
            us.append(CU + F * cx / cz)
            for y in (CAMERA_HEIGHT_M, CAMERA_HEIGHT_M - SIZE[2]):
                vs.append(CV + F * y / cz)
    left, right = max(min(us), 0.0), min(max(us), WIDTH - 1.0)
    top, bottom = max(min(vs), 0.0), min(max(vs), HEIGHT - 1.0)
    return (left, top, right, bottom) if left < right and top < bottom else None


def detection(frame, x, z, ry, camera=0, views=None, kind="Car", score=0.9):
    """A row of the detection file; views: None for the true ones."""
    b = box(x, z, ry, camera)
    if b is None:
        return None
    h, v = views or visible_faces(x, z, ry, -CAMERA2_M if camera == 2 else 0.0)
    return f"{frame} {kind} {score} " + " ".join(repr(value) for value in b) + f" {h} {v}"


def calibration_rows():
    def row(shift):
        return f"{F} 0 {CU} {F * shift!r} 0 {F} {CV} 0 0 0 1 0"
    return [row(0.0), row(-BASELINE_M), row(CAMERA2_M), row(CAMERA2_M - BASELINE_M)]


class Rig:
    """One drive on disk in one of KITTI's layouts."""

    def __init__(self, program, root, layout="tracking"):
        self.program, self.root, self.layout = program, pathlib.Path(root), layout
        self.sequence = {"raw": "2026_01_01_drive_0001", "odometry": "00", "tracking": "0000"}[layout]
        self.root.mkdir(parents=True)
        self.poses = self.root / "ego.txt"
        self.detections = self.root / "detections.txt"
        rows = calibration_rows()
        if layout == "raw":
            date = self.root / "2026_01_01"
            sync = date / (self.sequence + "_sync")
            sync.mkdir(parents=True)
            text = "".join(f"S_rect_0{i}: {WIDTH}.0 {HEIGHT}.0\nP_rect_0{i}: {row}\n" for i, row in enumerate(rows))
            self.calibration = date / "calib_cam_to_cam.txt"
            self.calibration.write_text(text)
            self.times = sync / "image_00" / "timestamps.txt"
            self.times.parent.mkdir()
        else:
            folder = self.root / ("sequences/00" if layout == "odometry" else "training/calib")
            folder.mkdir(parents=True)
            self.calibration = folder / ("calib.txt" if layout == "odometry" else "0000.txt")
            self.calibration.write_text("".join(f"P{i}: {row}\n" for i, row in enumerate(rows)))
            self.times = folder / "times.txt"

    def write(self, rows, frames, poses=None):
        """Detection rows (None: left out), number of frames, pose rows (None: the ego stands)."""
        self.detections.write_text("".join(f"{row}\n" for row in rows if row))
        self.poses.write_text("".join(f"{row}\n" for row in (poses or [STANDING] * frames)))
        if self.layout == "raw":
            self.times.write_text("".join(f"2026-01-01 12:00:{n // 10:02d}.{n % 10}00000000\n" for n in range(frames)))
        elif self.layout == "odometry":
            self.times.write_text("".join(f"{0.1 * n:e}\n" for n in range(frames)))

    def replay(self, out, *more, env=None):
        return subprocess.run(
            [self.program, "replay", "--layout", self.layout, "--root", str(self.root), "--sequence", self.sequence,
             "--images", "none", "--ego", str(self.poses), "--detections", str(self.detections), "--out", str(out),
             *map(str, more)], capture_output=True, text=True, timeout=250, check=False, env=env)


def objects(out):
    """Rows of objects.txt as dicts."""
    names = ("frame id type truncated occluded alpha left top right bottom h w l x y z rotation_y score speed").split()
    rows = []
    for line in pathlib.Path(out, "objects.txt").read_text().splitlines():
        row = dict(zip(names, line.split()))
        rows.append({k: (v if k == "type" else int(v) if k in ("frame", "id", "occluded") else float(v))
                     for k, v in row.items()})
    return rows


def table(out, name):
    with open(pathlib.Path(out, name), newline="") as file:
        return list(csv.DictReader(file))


def angle(a):
    """Wrapped to [-pi, pi)."""
    return (a + math.pi) % (2 * math.pi) - math.pi
