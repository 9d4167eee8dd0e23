#!/usr/bin/env python3
"""What `quadloop smooth` owes its users: the same bytes on any number of ranks, from every format to every format the same positions, connectivity
and tags as they were, a solution that stays with its nodes, blocks whose interface stands still, a Delaunay mesh that stays one.

    run_smooth.py --quadloop PROGRAM --case CASE.toml [--ranks 1 2 3 5]
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, NativeMesh, fail, mesh_case, run

FORMATS = ("mesh", "cgns", "vtu", "su2", "msh")


def smooth(program, given, made, ranks=1, options=()):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    return run([*launcher, program, "smooth", given, "-o", made, *options])


def require(holds, message):
    if not holds:
        fail(message)


def same_on_ranks(program, given, folder, ranks, options=()):
    made = {}
    for count in ranks:
        made[count] = folder / f"on_{count}.mesh"
        smooth(program, given, made[count], count, options)
        require(made[count].read_bytes() == made[ranks[0]].read_bytes(), f"{given.name}: other bytes on {count} ranks than on {ranks[0]}")
    return made[ranks[0]]


def check_better(program, given, made, geometry):
    before, after = (json.loads(run([program, "check", path, "--geometry", geometry, "--json"])) for path in (given, made))
    require(after["min_angle"] > before["min_angle"] and after["worst_quality"] > before["worst_quality"], "the worst cell is no better")
    old, new = NativeMesh(given), NativeMesh(made)
    require(old.cells == new.cells and old.boundaries == new.boundaries, "cells or boundaries are not what they were")
    moved = sum(a != b for a, b in zip(old.nodes, new.nodes))
    require(0 < moved < len(old.nodes), f"{moved} of {len(old.nodes)} nodes have moved")


def check_formats(program, given, folder):
    """sweeps = 0 only rewrites the mesh: each format gives back the same text; smoothed, each the same positions."""
    wanted = folder / "wanted.mesh"
    smooth(program, given, wanted)
    for form in FORMATS:
        other, back, smoothed = folder / f"other.{form}", folder / "back.mesh", folder / "smoothed.mesh"
        smooth(program, given, other, options=["--sweeps", "0"])
        smooth(program, other, back, options=["--sweeps", "0"])
        require(NativeMesh(back).nodes == NativeMesh(given).nodes and NativeMesh(back).cells == NativeMesh(given).cells, f"{form} and back is another mesh")
        smooth(program, other, smoothed)
        require(NativeMesh(smoothed).nodes == NativeMesh(wanted).nodes, f"from {form} the nodes come to other places")


def check_solution(program, given, folder):
    text, count = given.read_text(), len(NativeMesh(given).nodes)
    rows = [f"{node} {node / 7!r}" for node in range(count)]
    carrying, made = folder / "carrying.mesh", folder / "carried.mesh"
    carrying.write_text(text + "#Number of constants\n1\n0.5\n#Number of variables\n2\n#names: density pressure\n" + "\n".join(rows) + "\n")
    done = subprocess.run([program, "smooth", carrying, "-o", made], capture_output=True, text=True, check=True)
    require("solution" in done.stderr, f"no warning that the solution is that of the old mesh: {done.stderr}")
    kept = made.read_text().splitlines()[-count:]
    require([[float(v) for v in row.split()] for row in kept] == [[float(v) for v in row.split()] for row in rows], "the solution's rows have changed")


TWO_BLOCKS = """#Number of grid points
9
0 0
1.1 0
2 0
0 1
0.8 1.1
2 1
0 2
1.2 2
2 2
#Number of blocks
2
#Number of triangular elements
0
#Number of quadrilateral elements
2
1 2 5 4
4 5 8 7
#Number of triangular elements
4
2 3 5
3 6 5
5 6 8
6 9 8
#Number of quadrilateral elements
0
#Number of boundaries
1
#Number of edges for boundary 1 (side)
8
1 2
2 3
3 6
6 9
9 8
8 7
7 4
4 1
"""


def check_blocks(program, folder):
    given, made = folder / "blocks.mesh", folder / "blocks_smoothed.mesh"
    given.write_text(TWO_BLOCKS)
    smooth(program, given, made)
    require(NativeMesh(made).nodes[4] == (0.8, 1.1), "a node between two blocks has moved")
    sections = [line for line in made.read_text().splitlines() if not line.startswith("#")]
    require(sections[10] == "2", "the blocks are gone")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 3, 5])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_smooth_") as name:
        folder = Path(name)
        geometry = folder / "whole.geom"
        for mesh_type in ("hybrid", "delaunay"):
            prefix = folder / mesh_type
            mesh_case(args.quadloop, args.case, prefix, options=["--type", mesh_type, "--set", "smooth.sweeps=0", "--geometry-out", geometry])
            given = Path(f"{prefix}.mesh")
            same_on_ranks(args.quadloop, given, folder, args.ranks)
            made = same_on_ranks(args.quadloop, given, folder, args.ranks, ["--geometry", geometry])
            if mesh_type == "hybrid":
                check_better(args.quadloop, given, made, geometry)
                same_on_ranks(args.quadloop, given, folder, args.ranks[:2], ["--method", "nlopt", "--objective", "thesis"])
            check_formats(args.quadloop, given, folder)
            check_solution(args.quadloop, given, folder)
        check_blocks(args.quadloop, folder)
    print("good")


if __name__ == "__main__":
    main()
