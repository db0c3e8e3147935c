#!/usr/bin/env python3
"""Gate: the core's worst stack by gcc's call graphs (-fcallgraph-info=su) stays within 64 KiB, and nothing recurses.
Usage: check_stack.py ROOT CXX BUILD_DIR [--write] | check_stack.py ROOT CXX BUILD_DIR --plant
Builds the core alone twice: at -O3 for the sizes, at -O0 for the calls (inlining hides recursion). --write renews
docs/budgets.md; --plant: a planted file with a recursion, a frame too large, one of unknown size and an unknown
indirect call must be caught."""
import pathlib
import re
import subprocess
import sys

LIMIT = 64 * 1024
BEGIN, END = "<!-- stack: tests/gates/check_stack.py --write -->", "<!-- end of stack -->"
# Virtual calls of the core, by the function that makes them: what they reach in the core; None: the caller's own code.
INDIRECT = [
    (r"OrbMatcher::extract", r"OrbExtractor::extract"),
    (r"ObjectTeam::run", r"SolveJobs::run"),
    (r"(TrackerCore|PatchMatcher|OrbMatcher)::", None),  # StageObserver
    (r"Cycle::", None),  # sources, clock and bus
]
ENTRIES = [
    ("Tracker::process", r"semtrack::default_capacities::Tracker::process\("),
    ("Tracker::init", r"semtrack::default_capacities::Tracker::init\("),
    ("Cycle::step", r"semtrack::Cycle::step\("),
    ("CanEncoder::encode", r"semtrack::CanEncoder::encode\("),
    ("CanReceiver::take", r"semtrack::CanReceiver::take\("),
]


class Graph:
    def __init__(self, files):
        self.name, self.bytes, self.calls, self.faults = {}, {}, {}, []
        for file in files:
            for row in file.read_text(errors="replace").splitlines():
                self.read(row)

    def read(self, row):
        if row.startswith("node:"):
            title, label = re.search(r'title: "(.*?)" label: "(.*?)"', row).groups()
            lines = label.split("\\n")
            self.name.setdefault(title, lines[0])
            size = re.match(r"(\d+) bytes \((.*)\)", lines[2]) if len(lines) > 2 else None
            if size:
                self.bytes[title] = max(self.bytes.get(title, 0), int(size[1]))
                if size[2] not in ("static", "dynamic,bounded"):
                    self.faults.append(f"{lines[0]}: a stack of unknown size")
        elif row.startswith("edge:"):
            source, target = re.search(r'sourcename: "(.*?)" targetname: "(.*?)"', row).groups()
            self.calls.setdefault(source, set()).add(target)

    def resolve_indirect(self):
        for source, targets in self.calls.items():
            if "__indirect_call" not in targets:
                continue
            targets.discard("__indirect_call")
            rule = next((to for of, to in INDIRECT if re.search(of, self.name[source])), "unknown")
            if rule == "unknown":
                self.faults.append(f"{self.name[source]}: an indirect call that check_stack.py does not know")
            elif rule is not None:
                targets.update(t for t, name in self.name.items() if re.search(rule, name) and t in self.bytes)

    def depths(self):
        """Stack from each function on; a cycle is a fault."""
        depth, path, on_path = {}, [], set()

        def visit(title):
            if title in on_path:
                ring = path[path.index(title):]
                self.faults.append("recursion: " + " -> ".join(self.name.get(t, t) for t in ring))
                return 0
            if title not in depth:
                path.append(title)
                on_path.add(title)
                below = max((visit(t) for t in sorted(self.calls.get(title, ()))), default=0)
                depth[title] = self.bytes.get(title, 0) + below
                on_path.discard(path.pop())
            return depth[title]

        sys.setrecursionlimit(10000)
        for title in sorted(self.name):
            visit(title)
        return depth

    def chain(self, title, depth):
        out = []
        while title is not None:
            out.append((self.name[title], self.bytes.get(title, 0)))
            title = max(self.calls.get(title, ()), key=lambda t: (depth.get(t, 0), t), default=None)
        return out


def call_graphs(root, cxx, build, level):
    folder = build / f"stack{level}"
    for command in (
        ["cmake", "-S", str(root), "-B", str(folder), "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={cxx}",
         f"-DCMAKE_CXX_FLAGS={level} -DNDEBUG -fcallgraph-info=su", "-DSEMTRACK_SIL=OFF", "-DSEMTRACK_TESTS=OFF"],
        ["cmake", "--build", str(folder)],
    ):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout[-2000:] + done.stderr[-2000:])
    return sorted(folder.rglob("*.ci"))


def examine(files_o3, files_o0):
    graph, calls = Graph(files_o3), Graph(files_o0)
    graph.resolve_indirect()
    calls.resolve_indirect()
    depth = graph.depths()
    calls.depths()
    faults = graph.faults + [f for f in calls.faults if f.startswith("recursion")]
    worst = max(depth, key=depth.get)
    if depth[worst] > LIMIT:
        faults.append(f"{graph.name[worst]}: {depth[worst]} bytes of stack, the limit is {LIMIT}")
    return graph, depth, faults


def short_name(name):
    plain = re.sub(r"semtrack::|default_capacities::|\(anonymous namespace\)::|\{anonymous\}::", "", name)
    return re.sub(r"<.*>", "", plain.split("(")[0]).split(" ")[-1]


def table(graph, depth):
    rows = ["| entry | stack, bytes | most of it |", "|---|---|---|"]
    for label, pattern in ENTRIES:
        found = [t for t, name in graph.name.items() if re.search(pattern, name) and t in graph.bytes]
        if not found:
            sys.exit(f"{label}: not in the call graph")
        title = max(found, key=depth.get)
        largest = sorted(graph.chain(title, depth), key=lambda c: -c[1])[:3]
        short = [f"`{short_name(name)}` {size}" for name, size in largest]
        rows.append(f"| `{label}` | {depth[title]} | {', '.join(short)} |")
    return "\n".join(rows)


def planted(root, cxx, build):
    files = []
    for level in ("-O3", "-O0"):
        folder = build / f"stack_planted{level}"
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run([cxx, "-std=c++17", level, "-fcallgraph-info=su", "-c", str(root / "tests/gates/planted_stack.cpp"),
                        "-o", str(folder / "planted.o")], check=True)
        files.append(sorted(folder.glob("*.ci")))
    found = examine(*files)[2]
    print("\n".join(found))
    wanted = ("recursion", "unknown size", "indirect call", "the limit is")
    return 0 if all(any(w in f for f in found) for w in wanted) else 1


def main():
    root, cxx, build = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    if "--plant" in sys.argv:
        return planted(root, cxx, build)
    graph, depth, faults = examine(*(call_graphs(root, cxx, build, level) for level in ("-O3", "-O0")))
    rows = table(graph, depth)
    page = root / "docs/budgets.md"
    text = page.read_text()
    if "--write" in sys.argv:
        head, rest = text.split(BEGIN)
        page.write_text(f"{head}{BEGIN}\n{rows}\n{END}{rest.split(END)[1]}")
    elif f"{BEGIN}\n{rows}\n{END}" not in text:
        faults.append("docs/budgets.md: the table of stacks is stale (check_stack.py --write renews it)\n" + rows)
    print("\n".join(faults) if faults else f"{len(depth)} functions, no recursion\n{rows}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
