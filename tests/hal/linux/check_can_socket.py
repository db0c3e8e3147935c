#!/usr/bin/env python3
"""The whole program on a played CAN socket. Usage: check_can_socket.py PROGRAM LIBRARY faults|names

The preloaded library (played_can_socket.cpp) returns what a plan says and logs every call. Lists on the bus are whole or
absent, the program never spins, after an outage the first list is the current one, and drops are counted."""
import json
import os
import pathlib
import sys
import tempfile

SIL_TESTS = pathlib.Path(__file__).resolve().parents[2] / "sil"
sys.path[:0] = [str(SIL_TESTS), str(SIL_TESTS / "rig")]
from checks import check, finish, refused  # noqa: E402
from rig import Rig, detection  # noqa: E402

PROGRAM, LIBRARY = sys.argv[1:3]
LAST = 59
LIST_COUNTER = 3  # byte in every frame's data


def eight_cars(tmp):
    """A standing ego and eight parked cars: lists of five frames."""
    rig = Rig(PROGRAM, tmp / "drive", "odometry")
    places = [(-4.0, 12.0), (4.0, 14.0), (-4.0, 20.0), (4.0, 22.0), (-4.0, 28.0), (4.0, 30.0), (0.0, 18.0), (0.0, 34.0)]
    rig.write([detection(n, x, z, -1.57) for n in range(LAST + 1) for x, z in places], LAST + 1)
    return rig


def replay(rig, out, plan="", interface="can0", more=(), env=None, preload=True):
    env = {**os.environ, "PLAYED_CAN_LOG": str(out) + ".calls", "PLAYED_CAN_PLAN": plan, **(env or {})}
    if preload:
        env["LD_PRELOAD"] = LIBRARY
    return rig.replay(out, "--can", interface, "--no-progress", *more, env=env)


def logged_lists(out):
    """Frames (id, data) by list counter, in order, from can.log."""
    lists = {}
    for row in (out / "can.log").read_text().splitlines():
        frame = row.split()[2]
        name, data = frame.split("##1") if "##" in frame else frame.split("#")
        lists.setdefault(int(data[2 * LIST_COUNTER:2 * LIST_COUNTER + 2], 16), []).append((int(name, 16), data))
    return lists


def calls_of(out):
    """(name, result, frame) of every call in the log."""
    calls = []
    for row in pathlib.Path(str(out) + ".calls").read_text().splitlines():
        words = row.split()
        if words[0] == "write":
            data = bytes.fromhex(words[3])
            length = data[4]
            frame = (int.from_bytes(data[0:4], "little") & 0x1FFFFFFF, data[8:8 + length].hex().upper())
            calls.append(("write", int(words[1]), frame))
        else:
            calls.append((words[1], 0, None))
    return calls


def judge(what, out, may_break=0):
    """The lists that got onto the bus, by counter, and the run's counts."""
    logged = logged_lists(out)
    check(sorted(logged) == list(range(LAST + 1)), f"{what}: can.log has every list")
    bus = {}
    order = []
    calls = [c for c in calls_of(out) if c[0] not in ("socket", "bind", "setsockopt", "close")]
    for name, result, frame in calls:
        if name != "write" or result != 0:
            continue
        counter = int(frame[1][2 * LIST_COUNTER:2 * LIST_COUNTER + 2], 16)
        bus.setdefault(counter, []).append(frame)
        if not order or order[-1] != counter:
            order.append(counter)
    frames = sum(len(f) for f in bus.values())
    check(len(calls) - frames <= 10 * (LAST + 1), f"{what}: {len(calls)} calls for {frames} frames")
    broken = [n for n in bus if bus[n] != logged[n]]
    check(len(broken) <= may_break, f"{what}: lists {broken} on the bus are not those of can.log")
    check(all(bus[n] == logged[n][:len(bus[n])] for n in broken), f"{what}: a broken list is the start of one")
    check(order == sorted(set(order)), f"{what}: the order on the bus: {order}")
    run = json.loads((out / "metrics.json").read_text())["run"]
    whole = len(bus) - len(broken)
    check(run["can_lists"] == whole, f"{what}: {run['can_lists']} lists counted, {whole} are on the bus")
    check(run["can_lists_dropped"] == LAST + 1 - whole, f"{what}: {run['can_lists_dropped']} dropped are counted")
    return bus, run


def faults(tmp):
    rig = eight_cars(tmp)
    clean = tmp / "clean"
    done = replay(rig, clean)
    check(done.returncode == 0 and done.stderr == "", f"good bus: {done.stderr}")
    bus, run = judge("good bus", clean)
    check(len(bus) == LAST + 1 and run["can_lists_dropped"] == 0, "good bus: every list is there")
    frames = [len(bus[n]) for n in sorted(bus)]
    check(max(frames) >= 4, f"lists of several frames: {frames}")
    before_list = [sum(frames[:n]) for n in range(LAST + 1)]
    log = (clean / "can.log").read_bytes()

    def case(what, plan, more=(), may_break=0, lost=None):
        out = tmp / what.replace(" ", "_")
        done = replay(rig, out, plan, more=more)
        check(done.returncode == 0, f"{what}: status {done.returncode} {done.stderr}")
        bus, run = judge(what, out, may_break)
        check((LAST in bus) and len(bus[LAST]) == frames[LAST], f"{what}: the last list is on the bus")
        if lost is not None:
            check(run["can_lists_dropped"] in lost, f"{what}: {run['can_lists_dropped']} lists dropped, not {lost}")
        if run["can_lists_dropped"] > 0:
            check(len(done.stderr.splitlines()) == 1 and "can0" in done.stderr, f"{what}: one line says so")
        if not run["can_lists_dropped"]:
            check((out / "can.log").read_bytes() == log, f"{what}: can.log is as ever")
        return run

    at = before_list[20]
    run = case("EAGAIN within a list", f"ok*{at + 2} EAGAIN*2 ok*1", lost=[0])
    check(run["can_busy"] == 2, f"EAGAIN is counted: {run['can_busy']}")
    run = case("ENOBUFS within a list", f"ok*{at + 1} ENOBUFS*2", lost=[0])
    check(run["can_no_buffers"] == 2, f"ENOBUFS is counted: {run['can_no_buffers']}")
    run = case("a short write", f"ok*{at + 1} short*1", lost=[0])
    check(run["can_short_writes"] == 1, "a short write is counted")
    case("a burst of EAGAIN at a list's start", f"ok*{at} EAGAIN*40", lost=range(1, 20))
    case("a burst of ENOBUFS within a list", f"ok*{at + 1} ENOBUFS*40", may_break=1, lost=range(1, 20))
    run = case("down for ten lists", f"ok*{at} ENETDOWN*10", lost=[10])
    check(run["can_downs"] == 1, f"down is counted once: {run['can_downs']}")
    run = case("down within a list", f"ok*{at + 1} ENETDOWN*10", may_break=1, lost=[10])
    run = case("bus-off", f"ok*{at} busoff", more=("--realtime",), lost=range(1, 5))
    check(run["can_bus_offs"] == 1, "bus-off is counted")
    run = case("one after the other", f"ok*{before_list[5]} EAGAIN*6 ok*20 ENOBUFS*6 ok*20 short*1 ok*20 ENETDOWN@3 ok*5 "
               "busoff", more=("--realtime",), may_break=3, lost=range(25, 40))
    rows = (tmp / "one_after_the_other" / "ego.csv").read_text().splitlines()[1:]
    healths = " ".join(row.split(",")[-1] for row in rows)
    check("can_down" in healths and "can_bus_off" in healths, f"Health says so: {healths}")


def names(tmp):
    rig = eight_cars(tmp)
    out = tmp / "out"
    refused(replay(rig, out, interface="can1"), "an interface that is not there", "--can can1", "no such CAN interface")
    refused(replay(rig, out, interface="abcdefghijklmnop"), "a name of 16 characters", "abcdefghijklmnop", "15")
    refused(replay(rig, out, interface=""), "an empty name", "--can")
    refused(replay(rig, out, env={"PLAYED_CAN_CLASSIC": "1"}), "CAN FD on a classic interface", "can0", "classic")
    check(not out.exists(), "a refused interface leaves no folder behind")
    done = replay(rig, out, more=("--can-dialect", "classic"), env={"PLAYED_CAN_CLASSIC": "1"})
    check(done.returncode == 0, f"the classic dialect there: {done.stderr}")
    real = replay(rig, tmp / "real", interface="nosuchcan0", preload=False)
    refused(real, "the machine's own kernel", "--can nosuchcan0")


def main():
    with tempfile.TemporaryDirectory() as folder:
        {"faults": faults, "names": names}[sys.argv[3]](pathlib.Path(folder))
    return finish()


if __name__ == "__main__":
    sys.exit(main())
