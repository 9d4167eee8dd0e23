#!/usr/bin/env python3
"""What `quadloop smooth` owes its users: the same bytes on any number of ranks, from every format to every format the same positions, connectivity
and tags as they were, a solution that stays with its nodes, blocks whose interface stands still, a Delaunay mesh that stays one. What has one cure is put
right with a warning, what has none is refused: no invalid mesh is written.

    run_smooth.py --quadloop PROGRAM --case CASE.toml [--ranks 1 2 3 5]
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, NativeMesh, fail, mesh_case, run

FORMATS = ("mesh", "qmesh", "cgns", "vtu", "su2", "msh")


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
    as_given, as_wanted = NativeMesh(given), NativeMesh(wanted)
    for form in FORMATS:
        other, back, smoothed = folder / f"other.{form}", folder / "back.mesh", folder / "smoothed.mesh"
        smooth(program, given, other, options=["--sweeps", "0"])
        smooth(program, other, back, options=["--sweeps", "0"])
        given_back = NativeMesh(back)
        require(given_back.nodes == as_given.nodes and given_back.cells == as_given.cells, f"{form} and back is another mesh")
        smooth(program, other, smoothed)
        require(NativeMesh(smoothed).nodes == as_wanted.nodes, f"from {form} the nodes come to other places")


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


def write_native(path, nodes, blocks, boundaries):
    """Blocks are lists of cells, numbered from 0."""
    lines = [str(len(nodes)), *(f"{x!r} {y!r}" for x, y in nodes), str(len(blocks))]
    for cells in blocks:
        for width in (3, 4):
            rows = [cell for cell in cells if len(cell) == width]
            lines += [str(len(rows)), *(" ".join(str(node + 1) for node in row) for row in rows)]
    lines.append(str(len(boundaries)))
    for number, (name, edges) in enumerate(boundaries.items(), 1):
        lines += [f"#Number of edges for boundary {number} ({name})", str(len(edges)), *(f"{a + 1} {b + 1}" for a, b in edges)]
    path.write_text("\n".join(lines) + "\n")


def refused(program, given, *pieces):
    """Exit status 1, each piece in the message, no output."""
    made = given.with_name("refused_out.mesh")
    done = subprocess.run([program, "smooth", given, "-o", made], capture_output=True, text=True, check=False)
    require(done.returncode == 1 and not made.exists(), f"{given.name} is not refused, but ends with {done.returncode}: {done.stderr}")
    for piece in pieces:
        require(piece in done.stderr, f"{given.name}: '{piece}' is not in: {done.stderr}")


def put_right(program, given, made, piece):
    """`check` calls the mesh invalid, `smooth` says what it has put right and makes a valid one."""
    run([program, "check", given], accept=(1,))
    done = subprocess.run([program, "smooth", given, "-o", made], capture_output=True, text=True, check=True)
    require(piece in done.stderr, f"{given.name}: '{piece}' is not in: {done.stderr}")
    run([program, "check", made])


def check_what_is_put_right(program, whole, folder):
    mesh, wanted, made = NativeMesh(whole), folder / "wanted.mesh", folder / "mended.mesh"
    smooth(program, whole, wanted)
    given = folder / "clockwise.mesh"
    write_native(given, mesh.nodes, [[cell[:1] + cell[:0:-1] for cell in mesh.cells]], mesh.boundaries)
    put_right(program, given, made, f"reversed {len(mesh.cells)} cells with clockwise nodes")
    require(made.read_bytes() == wanted.read_bytes(), "turned cells are not what they were")
    given = folder / "unused.mesh"
    write_native(given, [*mesh.nodes, (0.1, 0.2)], [mesh.cells], mesh.boundaries)
    put_right(program, given, made, "left out 1 node without a cell")
    require(made.read_bytes() == wanted.read_bytes(), "a node of no cell has changed the mesh")
    given = folder / "unbounded.mesh"
    write_native(given, mesh.nodes, [mesh.cells], {name: edges[::2] for name, edges in mesh.boundaries.items()})
    left_out = sum(len(edges) // 2 for edges in mesh.boundaries.values())
    put_right(program, given, made, f"added {left_out} outer edges without a boundary")
    listed = {node for edges in mesh.boundaries.values() for edge in edges[::2] for node in edge}
    ends = [node for edges in mesh.boundaries.values() for edge in edges[1::2] for node in edge if node in listed]
    nodes = NativeMesh(made).nodes
    require(all(nodes[node] == mesh.nodes[node] for node in ends), "a node has moved where a listed edge meets one that is not")


def check_refusals(program, whole, folder):
    mesh, given = NativeMesh(whole), folder / "refused.mesh"
    write_native(given, mesh.nodes, [[*mesh.cells, mesh.cells[5]]], mesh.boundaries)
    refused(program, given, "conforming", "two cells in the same direction at (")
    cell = mesh.cells[5]
    write_native(given, mesh.nodes, [[*mesh.cells[:5], (cell[1], *cell[1:]), *mesh.cells[6:]]], mesh.boundaries)
    refused(program, given, "conforming", f"a cell has node {cell[1] + 1} twice")
    count, aside = len(mesh.nodes), 0.01
    sheets = [*mesh.cells, *(tuple(node + count for node in cell) for cell in mesh.cells)]
    both = {name: [*edges, *((a + count, b + count) for a, b in edges)] for name, edges in mesh.boundaries.items()}
    write_native(given, [*mesh.nodes, *((x + aside, y + aside) for x, y in mesh.nodes)], [sheets], both)
    refused(program, given, "overlap")
    given.write_text(TWO_BLOCKS.replace("0.8 1.1", "2.5 1.1"))  # it stays, as it lies between two blocks
    refused(program, given, "could not be untangled, the worst at (2", "--sweeps")


def edges_between(mesh, count):
    """Those that a cell among the first so many shares with one of the others."""
    sides = [{frozenset((a, b)) for cell in cells for a, b in zip(cell, cell[1:] + cell[:1])} for cells in (mesh.cells[:count], mesh.cells[count:])]
    return sides[0] & sides[1]


def check_delaunay_blocks(program, whole, folder, ranks):
    mesh, given = NativeMesh(whole), folder / "two_blocks.mesh"
    left = [cell for cell in mesh.cells if sum(mesh.nodes[node][0] for node in cell) < 0.9]
    right = [cell for cell in mesh.cells if sum(mesh.nodes[node][0] for node in cell) >= 0.9]
    write_native(given, mesh.nodes, [left, right], mesh.boundaries)
    before, after = NativeMesh(given), NativeMesh(same_on_ranks(program, given, folder, ranks))
    require(edges_between(after, len(left)) == edges_between(before, len(left)), "the edges between two blocks have changed")
    require({frozenset(cell) for cell in after.cells} != {frozenset(cell) for cell in before.cells}, "no edge was flipped; the test means nothing")


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
            if mesh_type == "hybrid":
                check_what_is_put_right(args.quadloop, given, folder)
                check_refusals(args.quadloop, given, folder)
            else:
                check_delaunay_blocks(args.quadloop, given, folder, args.ranks)
        check_blocks(args.quadloop, folder)
    print("good")


if __name__ == "__main__":
    main()
