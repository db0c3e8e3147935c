#!/usr/bin/env python3
"""Do objects keep their ids? Usage: check_ids.py SEMTRACK_SIL KITTI_DIR

Twelve tracking sequences by their boxes alone, no images, ego poses given. With the labels' own boxes at most one
switch in 500 object-frames, over all classes and whatever the occlusion; with RRC's boxes the figure is printed."""
import collections
import pathlib
import subprocess
import sys
import tempfile

from boxes import overlap

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish  # noqa: E402

SIL = sys.argv[1]
KITTI = pathlib.Path(sys.argv[2]) / "tracking/training"
SEQUENCES = ["0001", "0002", "0003", "0004", "0005", "0006", "0008", "0009", "0010", "0011", "0012", "0013"]
MOST_SWITCHES_IN = 500  # object-frames
LEAST_FOUND = 0.85      # of all labels: a tracker that says little switches little
OVERLAP = 0.5


def run(*arguments):
    result = subprocess.run([SIL, *map(str, arguments)], capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{arguments[0]}: status {result.returncode}: {result.stderr}")


def rows_of(path):
    """frame -> [(id, type, box)]; labels and results have the same columns."""
    out = collections.defaultdict(list)
    for row in map(str.split, path.open()):
        if row[2] != "DontCare":
            out[int(row[0])].append((int(row[1]), row[2], [float(v) for v in row[6:10]]))
    return out


def count(labels, results):
    """Label's id -> result's id, kept while they overlap; a switch is another id than the last one, also after a gap.
    Counters by class: switches, object-frames that were found, labels."""
    last, switches, found, total = {}, collections.Counter(), collections.Counter(), collections.Counter()
    for frame in sorted(labels):
        pairs = []
        for i, label in enumerate(labels[frame]):
            total[label[1]] += 1
            for j, result in enumerate(results.get(frame, [])):
                common = overlap(label[2], result[2])
                if common >= OVERLAP:
                    pairs.append((last.get(label[0]) == result[0], common, i, j))
        used_labels, used_results = set(), set()
        for _, _, i, j in sorted(pairs, reverse=True):
            if i in used_labels or j in used_results:
                continue
            used_labels.add(i)
            used_results.add(j)
            label, result = labels[frame][i], results[frame][j]
            found[label[1]] += 1
            switches[label[1]] += last.get(label[0], result[0]) != result[0]
            last[label[0]] = result[0]
    return switches, found, total


def the_count_sees_a_switch():
    """Two labels whose results swap ids half way, and one that is lost and comes back as another."""
    box = {1: [0, 0, 100, 50], 2: [300, 0, 400, 50], 3: [600, 0, 700, 50]}
    labels = {f: [(k, "Car", b) for k, b in box.items()] for f in range(10)}
    results = {f: [(10 + (k if f < 5 else 3 - k), "Car", box[k]) for k in (1, 2)] for f in range(10)}
    for frame in range(10):
        if not 3 <= frame < 6:
            results[frame].append((20 if frame < 3 else 21, "Car", box[3]))
    switches, found, total = count(labels, results)
    check(switches["Car"] == 3 and found["Car"] == 27 and total["Car"] == 30, f"planted switches: {switches}, {found}")


def replay(folder, kind, sequence):
    detections = "labels"
    if kind == "RRC":
        detections = folder / f"rrc_{sequence}.txt"
        run("convert-detections", "--format", "rrc", "--in", KITTI / f"det_02/rrc_Car/{sequence}.txt", "--labels",
            KITTI / f"label_02/{sequence}.txt", "--labels-viewpoints", KITTI / f"labels_viewpoints/{sequence}.txt",
            "--out", detections)
    out = folder / f"{kind}_{sequence}"
    run("replay", "--layout", "tracking", "--root", KITTI.parent, "--sequence", sequence, "--images", "none", "--cues",
        "SMG", "--ego", KITTI / f"ego_pose/{sequence}.txt", "--detections", detections, "--no-progress", "--out", out)
    return count(rows_of(KITTI / f"label_02/{sequence}.txt"), rows_of(out / "objects.txt"))


def per_500(switches, found):
    return 500.0 * sum(switches.values()) / max(1, sum(found.values()))


the_count_sees_a_switch()
with tempfile.TemporaryDirectory() as work:
    for kind in ("labels", "RRC"):
        parts = [collections.Counter(), collections.Counter(), collections.Counter()]
        for sequence in SEQUENCES:
            one = replay(pathlib.Path(work), kind, sequence)
            print(f"  {kind} {sequence}: {sum(one[0].values())} switches in {sum(one[1].values())} object-frames")
            for whole, part in zip(parts, one):
                whole.update(part)
        switches, found, total = parts
        print(f"{kind}: {per_500(switches, found):.2f} switches in 500 object-frames;",
              ", ".join(f"{c} {switches[c]}/{found[c]}" for c in sorted(found)))
        if kind == "labels":
            check(sum(found.values()) > 10000, "the sequences are there")
            share = sum(found.values()) / sum(total.values())
            check(share >= LEAST_FOUND, f"{share:.3f} of the labels found")
            check(sum(switches.values()) * MOST_SWITCHES_IN <= sum(found.values()), "too many switches on ideal boxes")
            check(switches["Car"] * MOST_SWITCHES_IN <= found["Car"], "too many switches of cars on ideal boxes")
sys.exit(finish())
