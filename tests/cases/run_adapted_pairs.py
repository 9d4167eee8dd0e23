#!/usr/bin/env python3
"""Adaptive runs of a box with two periodic pairs: the same bytes on every number of ranks, nodes that match after each cycle, with the built-in
solver equal values at partners, and with an external one cells that are refined on both sides, although its solution is steep on one only.

    run_adapted_pairs.py --quadloop PROGRAM [--ranks 1 2 3 5 8]
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, digest, fail, run
from run_adapted_blocks import Cells, size_of
from run_pairs import partners, read_mesh

SIDE = 6.0
OUTLINE = """4
bottom open
2
0 0
6 0
right open
2
6 0
6 6
top open
2
6 6
0 6
left open
2
0 6
0 0
"""
CASE = """
[geometry]
file = "box.geom"

[[pair]]
from = "left"
to = "right"
translation = [6.0, 0.0]

[[pair]]
from = "bottom"
to = "top"
translation = [0.0, 6.0]

[spacing]
max = 0.75

[adapt]
cycles = 2
indicator = "gradient"
min = 0.05
"""
BUILT_IN = """variable = "density"

[solver]
kind = "euler"
mach = 0.5
alpha = 45
time = "accurate"
end_time = 6.0
initial = "vortex"
"""
EXTERNAL = """variable = "T"

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""
PAIRS = ({"from": "left", "to": "right", "translation": (SIDE, 0.0)}, {"from": "bottom", "to": "top", "translation": (0.0, SIDE)})


def solve(mesh, solution):
    """A solution that is steep at the left side."""
    cells = Cells(mesh)
    rows = "".join(f"{math.tanh(5 * centre[0])!r}\n" for centre, _, _ in cells.cells)
    Path(solution).write_text(cells.mesh_text + "#Number of constants\n0\n#Number of variables\n0\n"
                              "#Number of cell variables\n1\n#names: T\n" + rows)


def node_rows(path):
    lines = Path(path).read_text().split("#Number of variables\n")[1].splitlines()
    return [line for line in lines[2:] if line.strip() and not line.startswith("#")]


def check_built_in(path):
    rows, mesh = node_rows(path), read_mesh(path)
    for pair in PAIRS:
        for one, other in partners(mesh, pair):
            if rows[one] != rows[other]:
                fail(f"{path}: the partners {one} and {other} have the values {rows[one]} and {rows[other]}")


def check_external(path):
    largest = max(size_of(corners) for centre, _, corners in Cells(path).cells if centre[0] > SIDE - 0.1)
    if largest > 0.2:
        fail(f"{path}: a cell at the right side has the size {largest}, although those at the left side are refined")


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 3])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapted_pairs_") as name:
        work = Path(name)
        (work / "box.geom").write_text(OUTLINE)
        external = EXTERNAL.format(python=sys.executable, script=Path(__file__).resolve())
        for kind, solver, check in (("built_in", BUILT_IN, check_built_in), ("external", external, check_external)):
            case = work / f"{kind}.toml"
            case.write_text(CASE + solver)
            first = work / f"{kind}_{args.ranks[0]}"
            for ranks in args.ranks:
                other = work / f"{kind}_{ranks}"
                run([MPIRUN, "-n", str(ranks), args.quadloop, "adapt", case, "-o", other])
                for cycle in range(3):
                    for file in ("mesh.mesh", "mesh.tree.h5"):
                        if digest(first / f"cycle_0{cycle}" / file) != digest(other / f"cycle_0{cycle}" / file):
                            fail(f"{kind}, cycle {cycle}: {file} differs on {ranks} ranks")
            for cycle in range(3):
                mesh = first / f"cycle_0{cycle}" / "mesh.mesh"
                print([len(partners(read_mesh(mesh), pair)) for pair in PAIRS])
            check(first / "cycle_02" / "mesh.mesh")
    print("good")
    return None


if __name__ == "__main__":
    main()
