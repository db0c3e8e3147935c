#!/usr/bin/env python3
"""Gate: each public header compiles alone, strictly, with each compiler at hand, as C++17 and C++20.
Usage: check_headers.py ROOT [--plant]; --plant: headers that need another first, or warn, must be caught."""
import concurrent.futures
import pathlib
import shutil
import subprocess
import sys
import tempfile

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wsign-conversion", "-Wold-style-cast",
          "-Wdouble-promotion", "-Wnon-virtual-dtor", "-Wno-pragma-once-outside-header", "-Werror"]
PLANTED = {"needs_another.hpp": "inline std::uint8_t planted() { return 0; }\n",
           "narrows.hpp": "inline int planted(long x) { return x; }\n",
           "leaves_unused.hpp": "inline int planted(int x) { return 0; }\n"}


def complaint(job):
    compiler, standard, header, include = job
    done = subprocess.run([compiler, f"-std={standard}", *STRICT, "-fsyntax-only", "-x", "c++", "-I", str(include),
                           "-include", str(header), "/dev/null"], capture_output=True, text=True)
    return f"{compiler} {standard}: {header}\n{done.stderr[:600]}" if done.returncode != 0 else ""


def check(headers, include):
    compilers = [c for c in ("g++", "clang++") if shutil.which(c)]
    jobs = [(c, s, h, include) for c in compilers for s in ("c++17", "c++20") for h in headers]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        bad = [c for c in pool.map(complaint, jobs) if c]
    print(f"{len(jobs)} compilations with {' and '.join(compilers)}, {len(bad)} failed")
    print("".join(bad), end="")
    return len(jobs), len(bad)


def main():
    include = pathlib.Path(sys.argv[1]) / "include"
    if "--plant" in sys.argv:
        with tempfile.TemporaryDirectory() as folder:
            headers = [pathlib.Path(folder) / name for name in PLANTED]
            for header in headers:
                header.write_text(PLANTED[header.name])
            jobs, bad = check(headers, include)
        return 0 if jobs and bad == jobs else 1
    jobs, bad = check(sorted(include.rglob("*.hpp")), include)
    return 1 if bad or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
