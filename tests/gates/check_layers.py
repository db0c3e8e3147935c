#!/usr/bin/env python3
"""Gate: includes follow one direction, and the core keeps the core's rules.

include <- math <- model <- {front, estimate, track, publish} <- pipeline <- {hal, sil} <- tests
The four stages never include each other. Usage: check_layers.py ROOT [--plant]; --plant checks that planted
violations are caught."""
import pathlib
import re
import sys

ALLOWED = {
    "include": {"include"},
    "math": {"include", "math"},
    "model": {"include", "math", "model"},
    "front": {"include", "math", "model", "front"},
    "estimate": {"include", "math", "model", "estimate"},
    "track": {"include", "math", "model", "track"},
    "publish": {"include", "math", "model", "publish"},
    "pipeline": {"include", "math", "model", "front", "estimate", "track", "publish", "pipeline"},
}
FREESTANDING = {"array", "cstddef", "cstdint", "cstring", "cmath", "cfenv", "limits", "new", "type_traits", "utility", "variant",
                "xmmintrin.h", "emmintrin.h", "arm_neon.h", "Eigen/Core", "Eigen/LU"}
FORBIDDEN = [
    (re.compile(r"std::(sin|cos|tan|asin|acos|atan2?|exp2?|log(2|10|1p)?|pow|hypot|cbrt|sinh|cosh|tanh)\s*\("), "libm transcendental"),
    (re.compile(r"\b(malloc|calloc|realloc|free|aligned_alloc)\s*\("), "heap"),
    (re.compile(r"(?<!::)\bnew\s+[A-Za-z]"), "heap"),
    (re.compile(r"\bthrow\b|\btry\s*\{|\bcatch\s*\("), "exception"),
    (re.compile(r"\bdynamic_cast\b|\btypeid\b"), "RTTI"),
    (re.compile(r"std::sort\b"), "std::sort recurses"),
    (re.compile(r"\bwhile\s*\(true\)|\bfor\s*\(;;\)"), "loop without bound"),
]


def code_of(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r"//[^\n]*", "", text)
    return re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)


def layer_of(include):
    if include.startswith("semtrack/"):
        return "include"
    return include.split("/")[0]


def check_file(name, layer, text):
    problems = []
    for line, row in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', row)
        if not match:
            continue
        kind, target = match.groups()
        if kind == "<":
            if target not in FREESTANDING:
                problems.append(f"{name}:{line}: <{target}> is not for the core")
            elif target.startswith("Eigen/") and name != "src/math/eigen.hpp":
                problems.append(f"{name}:{line}: Eigen comes through math/eigen.hpp")
        elif layer_of(target) not in ALLOWED[layer]:
            problems.append(f"{name}:{line}: {layer} must not include {target}")
        elif layer == "include" and not target.startswith("semtrack/"):
            problems.append(f"{name}:{line}: a public header includes {target}")
    for line, row in enumerate(code_of(text).splitlines(), 1):
        for pattern, what in FORBIDDEN:
            if pattern.search(row):
                problems.append(f"{name}: {what}: {row.strip()[:80]}")
    return problems


def check(root):
    problems = []
    files = 0
    for base in ("include", "src"):
        for path in sorted((root / base).rglob("*")):
            if path.suffix not in (".hpp", ".cpp"):
                continue
            name = path.relative_to(root).as_posix()
            layer = "include" if base == "include" else name.split("/")[1]
            files += 1
            if layer not in ALLOWED:
                problems.append(f"{name}: unknown layer {layer}")
                continue
            problems += check_file(name, layer, path.read_text())
    return files, problems


PLANTED = [
    ("math", '#include "model/feature.hpp"\n'),
    ("front", '#include "estimate/ego/ego_estimator.hpp"\n'),
    ("track", '#include "pipeline/tracker_core.hpp"\n'),
    ("include", '#include "math/pose.hpp"\n'),
    ("model", "#include <vector>\n"),
    ("model", "#include <Eigen/Core>\n"),
    ("math", "double f(double x) { return std::sin(x); }\n"),
    ("front", "int* f() { return new int(3); }\n"),
    ("estimate", "void f() { throw 1; }\n"),
    ("publish", "void f() { while (true) {} }\n"),
]


def main():
    root = pathlib.Path(sys.argv[1])
    if "--plant" in sys.argv:
        missed = [text for layer, text in PLANTED if not check_file("planted.cpp", layer, text)]
        print(f"{len(PLANTED) - len(missed)} of {len(PLANTED)} planted violations caught")
        return 1 if missed else 0
    files, problems = check(root)
    print("\n".join(problems))
    print(f"{files} files, {len(problems)} problems")
    return 1 if problems or files < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
