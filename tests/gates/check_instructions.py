#!/usr/bin/env python3
"""Gate: instructions a frame and stage, exactly repeatable, stay within 3 % of what docs/budgets.md says.
Usage: check_instructions.py ROOT TARGET COMPILER COUNT_RUN SCENE [PLUGIN SYSROOTS] [--write | --plant]
TARGET: x86-64 (counted by callgrind), aarch64 or armv7 (qemu-user with PLUGIN, tests/budget/count_stages.c). COMPILER
is written into the page with the counts; another compiler makes other counts, so they are compared only with the same.
Counted twice: both have to agree to the instruction. --write renews the target's column; --plant: a run with a tenth
fewer features, and counts that are 4 % off in one stage, must be caught."""
import pathlib
import re
import subprocess
import sys
import tempfile

LIMIT = 0.03
BEGIN, END = "<!-- instructions: tests/gates/check_instructions.py --write -->", "<!-- end of instructions -->"
TARGETS = ("x86-64", "aarch64", "armv7")
STAGES = ("infer", "associate", "mask", "match", "extract", "reject", "ego", "objects", "align", "lifecycle", "encode",
          "between")
ROWS = STAGES + ("frame", "largest frame")
FEATURES = ("500", "100")  # Config's own
PLANTED_FEATURES = ("450", "90")
EMULATORS = {"aarch64": ("qemu-aarch64", "arm64"), "armv7": ("qemu-arm", "armhf")}


def run(command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: status {done.returncode}\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done


def callgrind(program, arguments):
    """(marker, instructions since the marker before) in order: callgrind dumps its counts at each marker."""
    with tempfile.TemporaryDirectory() as place:
        # The C library chooses its copy loops by the processor: the plainest ones are there on every x86-64.
        environment = {"PATH": "/usr/bin:/bin", "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-AVX,-ERMS,-FSRM,-SSSE3"}
        run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={place}/out", "--dump-before=semtrack_count_*",
             "--dump-instr=no", program, *arguments], env=environment)
        dumps = sorted(pathlib.Path(place).glob("out.*"), key=lambda file: int(file.suffix[1:]))
        for dump in dumps:
            text = dump.read_text()
            trigger = re.search(r"^desc: Trigger: --dump-before=semtrack_count_(\w+)", text, re.M)
            total = re.search(r"^summary: (\d+)", text, re.M)
            if trigger and total:
                yield trigger[1], int(total[1])


def emulated(target, program, arguments, plugin, sysroot):
    emulator, arch = EMULATORS[target]
    with tempfile.NamedTemporaryFile("r") as log:
        run([emulator, "-L", sysroot / arch, "-plugin", plugin, "-d", "plugin", "-D", log.name, program, *arguments],
            env={"PATH": "/usr/bin:/bin"})
        for row in log.read().splitlines():
            name, total = row.split()
            yield name, int(total)


def by_frame(marks):
    """One dictionary a frame: instructions of each stage. What runs outside of the frames is left out."""
    frames, stage = [], "outside"
    for following, instructions in marks:
        if stage == "outside" and following == "between":
            frames.append(dict.fromkeys(STAGES, 0))
        elif stage != "outside":
            frames[-1][stage] += instructions
        stage = following
    return frames


def counts(frames):
    out = {stage: round(sum(f[stage] for f in frames) / len(frames)) for stage in STAGES}
    totals = [sum(f.values()) for f in frames]
    return {**out, "frame": round(sum(totals) / len(totals)), "largest frame": max(totals)}


def read_page(text):
    """target -> (compiler, row -> instructions)"""
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in text.split(BEGIN)[1].split(END)[0].strip().splitlines()]
    page = {}
    for k, head in enumerate(rows[0][1:], 1) if rows else ():
        target, compiler = head.split(", ", 1)
        page[target] = (compiler, {row[0]: int(row[k].replace(",", "")) for row in rows[2:] if row[k] != "-"})
    return page


def table(page):
    present = [t for t in TARGETS if t in page]
    rows = ["| stage | " + " | ".join(f"{t}, {page[t][0]}" for t in present) + " |", "|---" * (len(present) + 1) + "|"]
    for name in ROWS:
        rows.append(f"| {name} | " + " | ".join(f"{page[t][1][name]:,}" for t in present) + " |")
    return "\n".join(rows)


def faults(now, recorded):
    """A stage of less than a thousandth of the frame does not count on its own."""
    found = []
    for name in ROWS:
        off = now[name] / recorded[name] - 1.0 if recorded[name] > 0 else float(now[name] > 0)
        if abs(off) > LIMIT and max(now[name], recorded[name]) > 1e-3 * recorded["frame"]:
            found.append(f"{name}: {now[name]:,} instructions, the page says {recorded[name]:,} ({100 * off:+.1f} %)")
    return found


class Counter:
    def __init__(self, target, program, scene, plugin=None, sysroots=None):
        self.target, self.program, self.scene, self.plugin = target, program, scene, plugin
        self.sysroots = pathlib.Path(sysroots) if sysroots else None

    def count(self, features):
        if self.target == "x86-64":
            marks = callgrind(self.program, [self.scene, *features])
        else:
            marks = emulated(self.target, self.program, [self.scene, *features], self.plugin, self.sysroots)
        frames = by_frame(marks)
        if not frames:
            sys.exit("no frame was counted")
        return counts(frames)


def planted(counter, recorded):
    wrong = [faults({**recorded, name: round(recorded[name] * f)}, recorded) for name in ("ego", "match", "objects")
             for f in (1.04, 0.96)]
    fewer = faults(counter.count(PLANTED_FEATURES), recorded)
    print(f"one stage 4 % off: {[len(w) for w in wrong]} found; a tenth fewer features:\n" + "\n".join(fewer))
    return 0 if not faults(recorded, recorded) and all(len(w) == 1 for w in wrong) and len(fewer) > 2 else 1


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    root, target, compiler = pathlib.Path(arguments[0]), arguments[1], arguments[2]
    counter = Counter(target, *arguments[3:])
    page_file = root / "docs/budgets.md"
    text = page_file.read_text()
    page = read_page(text)
    if "--write" not in sys.argv and (target not in page or page[target][0] != compiler):
        have = page[target][0] if target in page else "nothing"
        print(f"SKIPPED: {target}: the page has the counts of {have}, this is {compiler}")
        return 0
    if "--plant" in sys.argv:
        return planted(counter, page[target][1])
    now = counter.count(FEATURES)
    if now != counter.count(FEATURES):
        sys.exit("two runs of the same program differ")
    if "--write" in sys.argv:
        page[target] = (compiler, now)
        head, rest = text.split(BEGIN)
        page_file.write_text(f"{head}{BEGIN}\n{table(page)}\n{END}{rest.split(END)[1]}")
        return 0
    found = faults(now, page[target][1])
    print("\n".join(found) if found else f"{target}: {now['frame']:,} instructions a frame; the page is right")
    if found:
        print("a change that is meant: renew the page with --write")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
