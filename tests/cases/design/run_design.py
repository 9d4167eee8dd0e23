#!/usr/bin/env python3
"""The design cycle of cases/naca_design with three shapes on coarse meshes: every mesh valid and on its own outline, the root that of the first tree,
points outside the old mesh counted, the same bytes on any number of ranks. Then again with morphed meshes, whose cells stay; where their quality is said to
be too low, with meshes made anew.

    run_design.py --quadloop PROGRAM [--ranks 1 3]
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, NativeMesh, fail, run

CASE = ROOT / "cases" / "naca_design"
COARSE = [word for text in ("adapt.cycles=1", "adapt.min=0.012", "spacing.min=0.012", "spacing.max=7", "spacing.curvature=20",
                            "boundary.airfoil.spacing=0.05", "adapt.max_nodes=4000") for word in ("--set", text)]


def design(program, out, ranks, options=()):
    return run([sys.executable, "-B", CASE / "run.py", "-o", out, "--quadloop", program, "--ranks", ranks, "--shapes", "3", *COARSE, *options])


def frame(mesh):
    xs, ys = zip(*(mesh.nodes[node] for edge in mesh.boundaries["farfield"] for node in edge))
    return min(xs), max(xs), min(ys), max(ys)


def geometry_as_meshed(program, out, number):
    """The shape with the far field where the saved root has it."""
    whole = out / f"whole_{number}.geom"
    run([program, "-q", "mesh", CASE / "case.toml", "--tree", out / f"shape_{number:02d}.tree.h5", "-o", out / "again", "--geometry-out", whole, *COARSE,
         "--set", f"geometry.file={out / f'shape_{number:02d}.geom'}"])
    return whole


def check_shapes(program, out):
    first = frame(NativeMesh(max((out / "shape_00").glob("cycle_*")) / "mesh.mesh"))
    for number in (1, 2):
        mesh = out / f"shape_{number:02d}.mesh"
        run([program, "-q", "check", mesh, "--geometry", geometry_as_meshed(program, out, number)])
        if frame(NativeMesh(mesh)) != first:
            fail(f"{mesh.name}: the far field has moved from {first} to {frame(NativeMesh(mesh))}")


def check_table(table):
    """Nodes outside the old mesh (the changed outline leaves some), and lift that grows with the camber."""
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if line[:3] in ("| 0", "| 1", "| 2")]
    if len(rows) != 3:
        fail(f"three rows were to come:\n{table}")
    if min(int(row[4]) for row in rows[1:]) < 1:
        fail("no node is counted outside the old mesh")
    lift = [float(row[6]) for row in rows]
    if not lift[0] < lift[1] < lift[2]:
        fail(f"the lift does not grow with the camber: {lift}")


def require_same(one, other):
    names = sorted(path.name for path in one.glob("shape_*.*"))
    if len(names) != 12:
        fail(f"twelve files were to be compared, there are {names}")
    for name in names:
        if (one / name).read_bytes() != (other / name).read_bytes():
            fail(f"{name}: {other} has other bytes than {one}")


def cells_of(path):
    mesh = NativeMesh(path)
    return mesh.cells, mesh.boundaries


def check_morphed(program, out, ranks):
    """The cells of all shapes are those of the first; with a quality that no mesh has they are not."""
    folders = [out / f"morphed_on_{number}" for number in ranks]
    for folder, number in zip(folders, ranks):
        design(program, folder, number, ["--set", "design.morph_to=0.2"])
        require_same(folders[0], folder)
    check_shapes(program, folders[0])
    first = cells_of(max((folders[0] / "shape_00").glob("cycle_*")) / "mesh.mesh")
    for number in (1, 2):
        if cells_of(folders[0] / f"shape_{number:02d}.mesh") != first:
            fail(f"shape {number}: its cells are not those of the first")
    design(program, out / "anew", 1, ["--set", "design.morph_to=1"])
    if cells_of(out / "anew" / "shape_02.mesh") == first:
        fail("no cells have the quality 1, but they were kept")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 3])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_design_") as name:
        folders = [Path(name) / f"on_{ranks}" for ranks in args.ranks]
        for folder, ranks in zip(folders, args.ranks):
            table = design(args.quadloop, folder, ranks)
            require_same(folders[0], folder)
        check_table(table)
        check_shapes(args.quadloop, folders[0])
        check_morphed(args.quadloop, Path(name), args.ranks)
    print("good")


if __name__ == "__main__":
    main()
