#!/usr/bin/env python3
"""Gate: the core's archive imports no allocator, exception, stdio or libm-transcendental symbol, and has no weak symbol
of Eigen's own namespace, which a consumer's object would replace at the link.
Usage: check_imports.py NM ARCHIVE | check_imports.py NM OBJECT --plant (an object that does must be caught)."""
import re
import subprocess
import sys

FORBIDDEN = re.compile(
    r"^(malloc|calloc|realloc|free|aligned_alloc|posix_memalign|mmap|_Zn[wa]|_Zd[la]|__cxa_throw|__cxa_allocate"
    r"|__cxa_begin_catch|_Unwind_|__gxx_personality|printf|puts|fopen|fwrite|fprintf|_ZNSt8ios_base"
    r"|(sin|cos|tan|asin|acos|atan|atan2|exp|exp2|log|log2|log10|pow|hypot|cbrt|sincos)f?$)")

EIGEN = re.compile(r"_ZN?[KVR]*5Eigen")


def main():
    nm, target = sys.argv[1:3]
    out = subprocess.run([nm, "--undefined-only", "--format=posix", target], check=True, capture_output=True, text=True)
    symbols = {row.split()[0] for row in out.stdout.splitlines() if row and not row.rstrip().endswith(":")}
    bad = sorted(s for s in symbols if FORBIDDEN.match(s))
    print(f"{len(symbols)} imports; forbidden: {' '.join(bad) if bad else 'none'}")
    out = subprocess.run([nm, "--defined-only", "--format=posix", target], check=True, capture_output=True, text=True)
    weak = {row.split()[0] for row in out.stdout.splitlines() if len(row.split()) > 2 and row.split()[1] in "WVu"}
    replaceable = sorted(s for s in weak if EIGEN.match(s))
    print(f"{len(weak)} weak symbols; Eigen's: {' '.join(replaceable) if replaceable else 'none'}")
    if "--plant" in sys.argv:
        return 0 if len(bad) >= 3 and replaceable else 1
    return 1 if bad or replaceable or not symbols else 0


if __name__ == "__main__":
    sys.exit(main())
