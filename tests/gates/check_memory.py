#!/usr/bin/env python3
"""Gate: docs/budgets.md says what a Tracker's bytes are spent on, and the totals stay within the budgets.
Usage: check_memory.py ROOT PRINT_DEFAULT PRINT_SMALL [--write | --plant]
--write renews the table; --plant: a stale page and a state over its budget must be caught."""
import pathlib
import subprocess
import sys

BUDGET_KIB = (8 * 1024, 2 * 1024)  # default, small capacities
BEGIN, END = "<!-- memory: tests/gates/check_memory.py --write -->", "<!-- end of memory -->"


def parts(program):
    out = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    return [(name, int(size)) for size, name in (row.split(" ", 1) for row in out.splitlines())]


def table(default, small):
    rows = ["| part | default, KiB | small, KiB |", "|---|---|---|"]
    rows += [f"| {name} | {size / 1024:.1f} | {other / 1024:.1f} |" for (name, size), (_, other) in zip(default, small)]
    return "\n".join(rows)


def faults(text, rows, sizes):
    found = []
    if f"{BEGIN}\n{rows}\n{END}" not in text:
        found.append("docs/budgets.md: the table of memory is stale (check_memory.py --write renews it)")
    for size, budget in zip(sizes, BUDGET_KIB):
        if size > budget * 1024:
            found.append(f"a Tracker takes {size / 1024:.1f} KiB, the budget is {budget}")
    return found


def main():
    root, default, small = pathlib.Path(sys.argv[1]), parts(sys.argv[2]), parts(sys.argv[3])
    page = root / "docs/budgets.md"
    text, rows, sizes = page.read_text(), table(default, small), [default[-1][1], small[-1][1]]
    if "--write" in sys.argv:
        head, rest = text.split(BEGIN)
        page.write_text(f"{head}{BEGIN}\n{rows}\n{END}{rest.split(END)[1]}")
        return 0
    if "--plant" in sys.argv:
        stale = faults(text.replace("| whole state | ", "| whole state | 1"), rows, sizes)
        large = faults(text, rows, [sizes[0], 2 * 1024 * 1024 + 1])
        print(f"stale page: {len(stale)} found, over the budget: {len(large)} found")
        return 0 if len(stale) == 1 and len(large) == 1 else 1
    found = faults(text, rows, sizes)
    print("\n".join(found) if found else f"{sizes[0]} and {sizes[1]} bytes; the page is right")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
