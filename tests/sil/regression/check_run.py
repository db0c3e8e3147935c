#!/usr/bin/env python3
"""`semtrack-sil run` as CI uses it. Usage: check_run.py PROGRAM"""
import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from checks import check, finish  # noqa: E402

PROGRAM = sys.argv[1]
REPLAY = {"layout": "world", "sequence": "empty", "last": 3}


def run(folder, cases, *more):
    (folder / "s.json").write_text(json.dumps({"cases": cases}))
    result = subprocess.run([PROGRAM, "run", "--scenarios", str(folder / "s.json"), "--out", str(folder / "out"), *more],
                            capture_output=True, text=True, timeout=250, check=False)
    suite = xml.etree.ElementTree.parse(folder / "out" / "junit.xml").getroot()[0] if result.returncode < 2 else None
    return result, suite


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        held = {"name": "held", "replay": REPLAY, "bounds": {"/ate_rmse_m": {"max": 0.1}}, "golden": "rows"}
        broken = {"name": "broken", "replay": REPLAY, "bounds": {"/ate_rmse_m": {"max": 1e-12}}}
        absent = {"name": "absent", "replay": {"layout": "odometry", "root": "nowhere", "sequence": "06"}}
        fails = {"name": "fails", "replay": {**REPLAY, "sequence": "no_such_street"}}

        result, suite = run(folder, [held, absent])
        check(result.returncode == 0, f"held and absent: status {result.returncode} {result.stderr}")
        check(suite.get("failures") == "0" and suite.get("skipped") == "1", "JUnit counts the skipped case")
        check("absent" in result.stdout and "skipped" in result.stdout, "a case without data is skipped by name")

        result, suite = run(folder, [held, broken, fails], "--jobs", "1")
        check(result.returncode == 1 and suite.get("failures") == "2", "a broken bound and a failed replay: status 1")
        check("bound /ate_rmse_m" in result.stdout and "no_such_street" in result.stdout, "both are named")

        baseline = ("--baseline", str(folder / "golden"))
        check(run(folder, [held], *baseline)[0].returncode == 1, "no baseline yet: status 1")
        check(run(folder, [held], *baseline, "--update-baseline")[0].returncode == 0, "the baseline is written")
        check(run(folder, [held], *baseline, "--jobs", "4")[0].returncode == 0, "the same run equals it")
        rows = folder / "golden" / "held" / "rows.txt"
        lines = rows.read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("ego.txt 2 "))
        lines[at] = "ego.txt 2 -1 0"
        rows.write_text("\n".join(lines) + "\n")
        result = run(folder, [held], *baseline)[0]
        check(result.returncode == 1 and "ego.txt: frame 2" in result.stdout, f"the planted difference: {result.stdout}")

        check(run(folder, [{"name": "x"}])[0].returncode == 2, "a case without replay: status 2")
    return finish()


if __name__ == "__main__":
    sys.exit(main())
