#!/usr/bin/env python3
"""Gate: docs/equations.md and the headers name the same equations, both ways. Usage: check_equations.py ROOT [--plant]

Every equation of the paper (1 to 17) and every label of its source has a row; the row's code and tests exist, and one of
its headers names the equation; a header that names an equation stands in a row of it. --plant: planted violations must
be found."""
import pathlib
import re
import sys

EQUATIONS = 17
LABELS = ["prior", "selection", "ego-motion2", "object-motion3", "object-motion2", "feature-factor", "semantic-factor"]
NUMBERS = re.compile(r"Eq\. ((?:\(\d+\)(?:-|, )?)+)")
LABEL = re.compile(r"\[eq:([a-z0-9-]+)\]")


def numbers_in(text):
    """'1, 2' or '3-5' or '(1)-(2)' -> {1, 2}, {3, 4, 5}, {1, 2}"""
    out = set()
    for first, last in re.findall(r"(\d+)\)?(?:-\(?(\d+))?", text):
        out.update(range(int(first), int(last or first) + 1))
    return out


def rows_of(page):
    """[(numbers, labels, code paths, test paths)] of the rows with a number."""
    rows = []
    for line in page.splitlines():
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) < 4 or not re.match(r"\d", cells[0]):
            continue
        folder, code = "", []
        for path in re.findall(r"`([^`]+)`", cells[2]):
            code.append(path if "/" in path else f"{folder}/{path}")
            folder = path if "/" in path else folder
        rows.append((numbers_in(re.sub(r"\(r_\w\)", "", cells[0])), cells[1], code, re.findall(r"`([^`]+)`", cells[3])))
    return rows


def named(text):
    """Equations and labels that a header names."""
    numbers = set()
    for group in NUMBERS.findall(text):
        numbers |= numbers_in(group)
    return numbers, set(LABEL.findall(text))


def compare(page, headers, exists):
    """headers: path under src without suffix -> text. Lines that say what is wrong."""
    rows = rows_of(page)
    problems = [f"equation {n} has no row" for n in range(1, EQUATIONS + 1) if not any(n in r[0] for r in rows)]
    problems += [f"label {label} has no row" for label in LABELS if not any(label in r[1] for r in rows)]
    for numbers, _, code, tests in rows:
        problems += [f"{path} is not there" for path in [f"src/{c}" for c in code] + tests if not exists(path)]
        texts = [text for path, text in headers.items() if any(path == c or path.startswith(c + "/") for c in code)]
        if not any(named(text)[0] & numbers for text in texts):
            problems.append(f"equations {sorted(numbers)}: no header of {', '.join(code)} names them")
    for path, text in headers.items():
        numbers, labels = named(text)
        own = [r for r in rows if any(path == c or path.startswith(c + "/") for c in r[2])]
        problems += [f"{path} names equation {n}, but stands in no row of it" for n in sorted(numbers)
                     if not any(n in r[0] for r in own)]
        problems += [f"{path} names label {label}, which the paper does not have" for label in labels - set(LABELS)]
    return problems


def main():
    root = pathlib.Path(sys.argv[1])
    if "--plant" in sys.argv:
        page = "\n".join(["| 1, 2 | prior, selection, ego-motion2 | `a/b` | `tests/a` | |",
                          "| 3-16 | object-motion3, object-motion2, feature-factor | `c/d` (`e`) | `tests/none` | |"])
        headers = {"a/b": "Eq. (1)-(2) [eq:prior] and Eq. (5)", "c/d": "nothing", "e/f": "[eq:mine]"}
        problems = compare(page, headers, lambda path: path != "tests/none")
        print("\n".join(problems))
        wanted = ["equation 17", "label semantic-factor", "tests/none", "no header of c/d", "a/b names equation 5", "mine"]
        return 0 if len(problems) == len(wanted) and all(any(w in p for p in problems) for w in wanted) else 1

    def exists(path):
        return any((root / f"{path}{suffix}").exists() for suffix in ("", ".hpp", ".cpp"))

    headers = {p.relative_to(root / "src").as_posix()[:-4]: p.read_text() for p in sorted((root / "src").rglob("*.hpp"))}
    problems = compare((root / "docs/equations.md").read_text(), headers, exists)
    print("\n".join(problems))
    print(f"{sum(bool(named(t)[0]) for t in headers.values())} headers name equations, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
