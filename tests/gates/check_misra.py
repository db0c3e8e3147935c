#!/usr/bin/env python3
"""Gate: every deviation marked in the code (MISRA deviation D-NN) has its row in MISRA_deviations.md, and the other
way round. Usage: check_misra.py ROOT [--plant]"""
import pathlib
import re
import sys

MARK = re.compile(r"MISRA deviation (D-\d+)")
ROW = re.compile(r"^\|\s*(D-\d+)\s*\|", re.M)


def compare(code, page):
    rows = ROW.findall(page)
    marks = set(MARK.findall(code))
    problems = [f"{d} is in the code but not on the page" for d in sorted(marks - set(rows))]
    problems += [f"{d} is on the page but not in the code" for d in sorted(set(rows) - marks)]
    problems += [f"{d} has two rows" for d in sorted(set(rows)) if rows.count(d) > 1]
    return len(marks), problems


def main():
    root = pathlib.Path(sys.argv[1])
    if "--plant" in sys.argv:
        page = "| D-01 | x |\n| D-02 | y |\n| D-02 | y |\n"
        problems = compare("// MISRA deviation D-01\n// MISRA deviation D-07\n", page)[1]
        print("\n".join(problems))
        return 0 if len(problems) == 3 else 1
    code = ""
    for base in ("include", "src", "hal"):
        for path in sorted((root / base).rglob("*")):
            if path.suffix in (".hpp", ".cpp"):
                code += path.read_text()
    marks, problems = compare(code, (root / "MISRA_deviations.md").read_text())
    print("\n".join(problems))
    print(f"{marks} deviations, {len(problems)} problems")
    return 1 if problems or marks == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
