"""The program under test, and a rendered drive in KITTI's raw layout to spoil.

The program is the script's first argument."""
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import zlib

from checks import check

PROGRAM = sys.argv[1]
FRAMES = 4


def run(*arguments, env=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **(env or {})}, timeout=250, check=False)


def render(layout, folder, frames=FRAMES):
    result = run("render", "--scenario", "street", "--layout", layout, "--out", folder, "--frames", frames)
    if result.returncode != 0:
        sys.exit(f"render failed: {result.stderr}")
    words = result.stdout.split()
    return words[words.index("--sequence") + 1], pathlib.Path(words[words.index("--detections") + 1])


def contents(folder):
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir()) if p.is_file()}


def same_but_timing(a, b, what):
    for name in sorted(set(a) | set(b)):
        if name != "timing.csv":
            check(a.get(name) == b.get(name), f"{what}: {name} differs")


class Drive:
    """A fresh copy of the rendered raw drive."""

    def __init__(self, base, folder):
        self.folder = folder
        shutil.copytree(base["root"], folder)
        self.id = base["id"]
        self.date = folder / self.id[:10]
        self.sync = self.date / (self.id + "_sync")
        self.detections = folder / base["detections"].relative_to(base["root"])
        self.calibration = self.date / "calib_cam_to_cam.txt"
        self.times = self.sync / "image_00" / "timestamps.txt"

    def left(self, frame):
        return self.sync / "image_00" / "data" / f"{frame:010d}.png"

    def right(self, frame):
        return self.sync / "image_01" / "data" / f"{frame:010d}.png"

    def replay(self, out, *more, env=None, detections=None):
        return run("replay", "--layout", "raw", "--root", self.folder, "--sequence", self.id, "--detections",
                   detections or self.detections, "--out", out, *more, env=env)


def raw_base(tmp):
    root = tmp / "base"
    drive_id, detections = render("raw", root)
    return {"root": root, "id": drive_id, "detections": detections}


def edit(path, line, change):
    """Changes line `line` (from 1)."""
    rows = path.read_text().split("\n")
    rows[line - 1] = change(rows[line - 1])
    path.write_text("\n".join(rows))


def grey_png(width, height):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + bytes(width) for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def replace_word(index, word):
    def change(row):
        words = row.split()
        words[index] = word
        return " ".join(words)
    return change
