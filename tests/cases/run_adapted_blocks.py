#!/usr/bin/env python3
"""An adaptive run of a mesh with two blocks, whose solution jumps between them: the same bytes on 1, 2, 3 and 5 ranks, a resumed run goes on
alike, cells at the interface are not refined, and no value of one block reaches the other.

    run_adapted_blocks.py --quadloop PROGRAM
"""
import argparse
import math
import shutil
import sys
import tempfile
from pathlib import Path

from quadloop_runs import digest, fail, run

CASE = """
[[shape]]
name = "box"
kind = "rectangle"
box = [0, 2, 0, 1]

[[shape]]
name = "ring"
kind = "circle"
centre = [0.8, 0.5]
radius = 0.25

[[block]]
name = "fluid"
loop = "box"

[[block]]
name = "solid"
loop = "ring"

[spacing]
max = 0.1

[boundary.ring]
spacing = 0.05

[adapt]
cycles = 2
variable = "T"
indicator = "difference"
min = 0.01

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""


class Cells:
    """The cells of a native file, with their centres and blocks, and the values of its cell variable T."""

    def __init__(self, path):
        text = Path(path).read_text()
        self.mesh_text = text.split("#Number of constants")[0].rstrip("\n") + "\n"
        rows = iter(line.split() for line in text.splitlines() if line.strip() and not line.startswith("#"))
        points = [tuple(map(float, next(rows))) for _ in range(int(next(rows)[0]))]
        kinds = ([], [])
        for block in range(int(next(rows)[0])):
            for cells in kinds:
                for _ in range(int(next(rows)[0])):
                    corners = [points[int(n) - 1] for n in next(rows)]
                    centre = [sum(c) / len(corners) for c in zip(*corners)]
                    cells.append((centre, block, corners))
        self.cells = kinds[0] + kinds[1]
        values = text.split("#Number of cell variables")
        self.values = [float(line) for line in values[1].splitlines()[3:] if line.strip()] if len(values) > 1 else []


def temperature(centre, block):
    return math.tanh(20 * (centre[0] - 1.3)) if block == 0 else 100 + math.tanh(20 * (centre[0] - 0.75))


def solve(mesh, solution):
    cells = Cells(mesh)
    rows = "".join(f"{temperature(centre, block)!r}\n" for centre, block, _ in cells.cells)
    Path(solution).write_text(cells.mesh_text + "#Number of constants\n0\n#Number of variables\n0\n"
                              "#Number of cell variables\n1\n#names: T\n" + rows)


def size_of(corners):
    return max(max(axis) - min(axis) for axis in zip(*corners))


def check_meshes(folder):
    last = Cells(folder / "cycle_02" / "mesh.mesh")
    if not last.cells or {block for _, block, _ in last.cells} != {0, 1}:
        fail("the mesh has not two blocks")
    for (centre, block, corners), value in zip(last.cells, last.values):
        low, high = (-1, 1) if block == 0 else (99, 101)
        if not low <= value <= high:
            fail(f"block {block + 1} has the value {value} at {centre}")
        away = abs(centre[0] - 1.3) > 0.4 and abs(centre[0] - 0.75) > 0.28  # from both fronts
        if away and size_of(corners) < 0.02:
            fail(f"a cell at {centre} is refined, although the solution changes only across the interface")
    if min(size_of(corners) for (centre, _, corners) in last.cells if abs(centre[0] - 1.3) < 0.05) > 0.04:
        fail("the front is not refined")


def check_starts(folder):
    """The transferred solution before a solver run: no value of the other block."""
    for (centre, block, _), value in zip(Cells(folder / "start.mesh").cells, Cells(folder / "start.mesh").values):
        low, high = (-1.01, 1.01) if block == 0 else (98.99, 101.01)
        if not low <= value <= high:
            fail(f"the transfer gives block {block + 1} the value {value} at {centre}")


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapted_blocks_") as name:
        work = Path(name)
        case = work / "case.toml"
        case.write_text(CASE.format(python=sys.executable, script=Path(__file__).resolve()))
        for mesh_type in ("hybrid", "delaunay"):
            first = work / f"{mesh_type}_1"
            for ranks in (1, 2, 3, 5):
                other = work / f"{mesh_type}_{ranks}"
                run(["mpirun", "-n", str(ranks), args.quadloop, "adapt", case, "-o", other, "--set", f'mesh.type="{mesh_type}"'])
                for cycle in range(3):
                    for file in ("mesh.mesh", "mesh.tree.h5"):
                        if digest(first / f"cycle_0{cycle}" / file) != digest(other / f"cycle_0{cycle}" / file):
                            fail(f"{mesh_type}, cycle {cycle}: {file} differs on {ranks} ranks")
            check_meshes(first)
            shutil.rmtree(work / f"{mesh_type}_2" / "cycle_02")
            run([args.quadloop, "adapt", case, "-o", work / f"{mesh_type}_2", "--resume", "--set", f'mesh.type="{mesh_type}"'])
            if digest(first / "cycle_02" / "mesh.mesh") != digest(work / f"{mesh_type}_2" / "cycle_02" / "mesh.mesh"):
                fail(f"{mesh_type}: a resumed run differs")
            run([args.quadloop, "remesh", "--tree", first / "cycle_00" / "mesh.tree.h5", "--solution", first / "cycle_00" / "mesh.mesh", case,
                 "-o", work / "start", "--set", f'mesh.type="{mesh_type}"', "--set", 'output.formats=["mesh"]'])
            check_starts(work)
    print("good")
    return None


if __name__ == "__main__":
    main()
