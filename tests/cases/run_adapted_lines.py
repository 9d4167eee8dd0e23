#!/usr/bin/env python3
"""An adaptive run of a mesh with a bent baffle, on which another one ends, and a measuring line across a front: the same bytes on several
numbers of ranks, a resumed run goes on alike, the baffle is not refined for the jump across it, and no value of one side reaches the other.

    run_adapted_lines.py --quadloop PROGRAM [--ranks 1,2,3]
"""
import argparse
import math
import shutil
import sys
import tempfile
from pathlib import Path

from quadloop_runs import digest, fail, run

# The plate stands on the wall, ends in the flow, and bends to and fro by less than a corner, so that the chords of two meshes differ.
# The shelf begins at the plate.
PLATE = [(0.75 + 0.005 * (-1) ** k, 0.05 * k) for k in range(13)]
SHELF = [PLATE[6], (1.00, 0.32)]

CASE = """
[[shape]]
name = "box"
kind = "rectangle"
box = [0, 2, 0, 1]

[[line]]
name = "plate"
path = {plate}
kind = "baffle"

[[line]]
name = "shelf"
path = {shelf}
kind = "baffle"

[[line]]
name = "section"
path = [[1.5, 0.0], [1.3, 0.7]]

[spacing]
max = 0.1

[boundary.plate]
spacing = 0.1

[adapt]
cycles = 2
variable = "T"
indicator = "difference"
threshold = "fraction"
refine = 0.1
coarsen = 0.0
min = 0.01
{transfer}

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""


class Native:
    """The nodes and cells of a native file, its node variable T and its cell variable C."""

    def __init__(self, path):
        text = Path(path).read_text()
        self.mesh_text = text.split("#Number of constants")[0].rstrip("\n") + "\n"
        rows = iter(line.split() for line in text.splitlines() if line.strip() and not line.startswith("#"))
        self.points = [tuple(map(float, next(rows))) for _ in range(int(next(rows)[0]))]
        next(rows)  # one block
        self.cells = []
        for _ in range(2):
            self.cells += [[int(n) - 1 for n in next(rows)] for _ in range(int(next(rows)[0]))]
        at_nodes, _, in_cells = text.partition("#Number of cell variables")
        lines = at_nodes.partition("#Number of variables")[2].splitlines()
        self.T = [float(line) for line in lines[2:] if line and not line.startswith("#")]
        self.C = [float(line) for line in in_cells.splitlines()[3:] if line.strip()]
        self.lines = [line for line in text.splitlines() if line.startswith("# inner line")]

    def corners(self, cell):
        return [self.points[n] for n in cell]

    def centre(self, cell):
        return tuple(sum(c) / len(cell) for c in zip(*self.corners(cell)))

    def cells_of_nodes(self):
        cells = [[] for _ in self.points]
        for cell in self.cells:
            for node in cell:
                cells[node].append(cell)
        return cells

    def sides(self):
        """The side of each node: that of its cells, by the nearest of their centres."""
        of_nodes = []
        for point, cells in zip(self.points, self.cells_of_nodes()):
            centres = sorted((self.centre(cell) for cell in cells), key=lambda c: -abs(c[0] - plate_at(c[1])))
            of_nodes.append(side_of(centres[0]) if abs(point[0] - plate_at(point[1])) < 0.1 else side_of(point))
        return of_nodes


def plate_at(y):
    for (x0, y0), (x1, y1) in zip(PLATE, PLATE[1:]):
        if y <= y1:
            return x0 + (x1 - x0) * (y - y0) / (y1 - y0)
    return PLATE[-1][0]


def side_of(point):
    return -1 if point[0] < plate_at(point[1]) else 1


def value(point, side):
    """Jumps by up to 8 across the plate, and by nothing above it; a front far behind."""
    return 4 * side * max(0, 1 - point[1] / 0.6) + math.tanh(20 * (point[0] - 1.4))


def solve(mesh, solution):
    mesh = Native(mesh)
    nodes = "".join(f"{value(point, side)!r}\n" for point, side in zip(mesh.points, mesh.sides()))
    cells = "".join(f"{value(c, side_of(c))!r}\n" for c in map(mesh.centre, mesh.cells))
    Path(solution).write_text(mesh.mesh_text + "#Number of constants\n0\n#Number of variables\n1\n#names: T\n" + nodes +
                              "#Number of cell variables\n1\n#names: C\n" + cells)


def size_of(corners):
    return max(max(axis) - min(axis) for axis in zip(*corners))


def check_cycles(folder):
    first, second, last = (Native(folder / f"cycle_0{cycle}" / "mesh.mesh") for cycle in range(3))
    if not last.lines or not last.T:
        fail(f"{folder} has no inner line, or no solution")
    at_plate = [sum(abs(mesh.centre(c)[0] - 0.75) < 0.15 for c in mesh.cells) for mesh in (first, second)]
    if at_plate[0] != at_plate[1]:
        fail(f"cells at the plate are refined, from {at_plate[0]} to {at_plate[1]}, although the solution changes only across it")
    if min(size_of(last.corners(c)) for c in last.cells if abs(last.centre(c)[0] - 1.4) < 0.05) > 0.04:
        fail("the front is not refined")


def check_start(path):
    """The transferred solution before a solver run: near the plate, that of the own side up to the interpolation error."""
    start = Native(path)
    worst = 0
    for point, side, found in zip(start.points, start.sides(), start.T):
        if point[0] < 1.1:
            worst = max(worst, abs(found - value(point, side)))
    if worst > 0.3:
        fail(f"{path}: nodes at the plate differ from their side by {worst}")
    of_cells = max(abs(found - value(c, side_of(c))) for c, found in zip(map(start.centre, start.cells), start.C) if c[0] < 1.1)
    if of_cells > 0.7:
        fail(f"{path}: cells at the plate differ from their side by {of_cells}")
    print(f"largest error at the plate: {worst:.3f} at nodes, {of_cells:.3f} in cells")


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", default="1,2,3")
    parser.add_argument("--keep", help="folder for the results")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapted_lines_") as name:
        work = Path(args.keep or name)
        for mesh_type, transfer in (("hybrid", ""), ("delaunay", 'transfer = "conservative"')):
            case = work / f"{mesh_type}.toml"
            lists = [[list(p) for p in line] for line in (PLATE, SHELF)]
            case.write_text(f'[mesh]\ntype = "{mesh_type}"\n' + CASE.format(
                python=sys.executable, script=Path(__file__).resolve(), plate=lists[0], shelf=lists[1], transfer=transfer))
            first = None
            for ranks in args.ranks.split(","):
                other = work / f"{mesh_type}_{ranks}"
                first = first or other
                run(["mpirun", "-n", str(ranks), args.quadloop, "adapt", case, "-o", other])
                for cycle in range(3):
                    for file in ("mesh.mesh", "mesh.tree.h5"):
                        if digest(first / f"cycle_0{cycle}" / file) != digest(other / f"cycle_0{cycle}" / file):
                            fail(f"{mesh_type}, cycle {cycle}: {file} differs on {ranks} ranks")
            check_cycles(first)
            shutil.rmtree(other / "cycle_02")
            run([args.quadloop, "adapt", case, "-o", other, "--resume"])
            for file in ("mesh.mesh", "mesh.tree.h5"):
                if digest(first / "cycle_02" / file) != digest(other / "cycle_02" / file):
                    fail(f"{mesh_type}: {file} of a resumed run differs")
            start = {}
            for spacing in (0.1, 0.03, 0.012):  # of the plate in the next mesh
                for ranks in (1, 3):
                    start[ranks] = work / f"{mesh_type}_start_{ranks}"
                    solved = first / "cycle_00"
                    run(["mpirun", "-n", str(ranks), args.quadloop, "remesh", "--tree", solved / "mesh.tree.h5",
                         "--solution", solved / "mesh.mesh", case, "-o", start[ranks], "--set", 'output.formats=["mesh"]',
                         "--set", f"boundary.plate.spacing={spacing}", "--set", "spacing.min=0.01"])
                check_start(start[1].with_suffix(".mesh"))
                if digest(start[1].with_suffix(".mesh")) != digest(start[3].with_suffix(".mesh")):
                    fail(f"{mesh_type}: the transferred solution differs on 3 ranks")
    print("good")
    return None


if __name__ == "__main__":
    main()
