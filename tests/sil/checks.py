"""Counts what a script checks and says what failed."""
_failed = []
_checks = 0


def check(condition, what):
    global _checks
    _checks += 1
    if not condition:
        _failed.append(what)
        print("FAILED:", what)


def refused(result, what, *names):
    """Status 2, one line on stderr that holds the names."""
    lines = result.stderr.splitlines()
    check(result.returncode == 2, f"{what}: status {result.returncode} instead of 2; {result.stderr!r}")
    check(len(lines) == 1, f"{what}: {len(lines)} lines on stderr: {result.stderr!r}")
    for name in names:
        check(name in result.stderr, f"{what}: {name!r} is not in {result.stderr!r}")


def finish():
    """The script's exit status: a script that checked nothing has failed."""
    print(f"{_checks} checks, {len(_failed)} failed")
    return 1 if _failed or _checks == 0 else 0
