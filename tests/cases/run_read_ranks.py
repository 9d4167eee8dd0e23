#!/usr/bin/env python3
"""What `check` reports on a mesh and what `plot` draws of it are the same bytes whatever the number of ranks.

    run_read_ranks.py --quadloop PROGRAM --case CASE.toml --ranks 1 2 3 [--type delaunay] [--flow]

The mesh of the case, and the same damaged: a node moved into another cell, a cell left out.

--flow  also a flow after two steps of the built-in solver, in colours, contours and streamlines
"""
import argparse
import subprocess
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, NativeMesh, fail, mesh_case, run

PICTURES = {"whole.png": [], "part.svg": ["--window", "-0.2,1.2,-0.3,0.3"], "quality.pdf": ["--colour-by", "quality"], "blocks.png": ["--colour-by", "block"]}
FLOWS = {"smooth.png": ["--field", "pressure", "--contours", "9", "--streamlines", "8"], "flat.svg": ["--field", "mach", "--shading", "flat", "--lines", "on"]}


def damaged(mesh, folder):
    """Two files: with the middle node moved to where the first is, and without the middle row of the first list of cells."""
    lines = mesh.read_text().splitlines()
    nodes = int(lines[1])
    moved, hole = folder / "moved.mesh", folder / "hole.mesh"
    moved.write_text("\n".join([*lines[:2 + nodes // 2], lines[2], *lines[3 + nodes // 2:], ""]))
    at = next(i for i, line in enumerate(lines) if "elements" in line and int(lines[i + 1]) > 1)
    cells = int(lines[at + 1])
    hole.write_text("\n".join([*lines[:at + 1], str(cells - 1), *lines[at + 2:at + 2 + cells // 2], *lines[at + 3 + cells // 2:], ""]))
    return [moved, hole]


def outcome(quadloop, ranks, *arguments):
    """Exit status and output, without the messages of mpirun."""
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    done = subprocess.run([str(word) for word in (*launcher, quadloop, *arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, [line for line in done.stderr.splitlines() if line.startswith("quadloop")]


def reports(args, mesh, geometry, ranks):
    """Text and record of the mesh and of the damaged ones, each with and without the geometry."""
    for path in (mesh, *damaged(mesh, mesh.parent)):
        for beside in ([], ["--geometry", geometry]):
            for form in (["--verbose"], ["--json"]):
                yield f"check {path.name} {beside} {form}", outcome(args.quadloop, ranks, "check", path, *beside, *form)


def pictures(args, path, wanted, ranks):
    for name, options in wanted.items():
        drawn = path.parent / name
        window = [] if "--window" in options and not args.airfoil else options
        run([*([MPIRUN, "-n", str(ranks)] if ranks > 1 else []), args.quadloop, "plot", path, "-o", drawn, *window])
        content = drawn.read_bytes()
        yield f"plot {path.name} {name}", b"\n".join(line for line in content.splitlines() if b"/CreationDate" not in line)


def solved(args, mesh):
    flow = mesh.parent / "flow.mesh"
    run([args.quadloop, "solve", args.case, mesh, "-o", flow, "--set", "solver.mach=0.3", "solver.iterations=2"])
    return flow


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--ranks", required=True, type=int, nargs="+")
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--flow", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_read_ranks_") as folder:
        mesh, geometry = Path(folder) / "a.mesh", Path(folder) / "a.geom"
        mesh_case(args.quadloop, args.case, Path(folder) / "a", options=["--type", args.type, "--geometry-out", geometry])
        nodes = NativeMesh(mesh).nodes
        args.airfoil = any(-0.2 < x < 1.2 and -0.3 < y < 0.3 for x, y in nodes)  # something is in the window
        flow = solved(args, mesh) if args.flow else None
        first = {}
        for ranks in args.ranks:
            results = [*reports(args, mesh, geometry, ranks), *pictures(args, mesh, PICTURES, ranks)]
            if flow is not None:
                results += pictures(args, flow, FLOWS, ranks)
            for name, result in results:
                if first.setdefault(name, result) != result:
                    fail(f"{name} on {ranks} ranks is not what it is on {args.ranks[0]}")
        if any(first[name][0] == 0 for name in first if "moved.mesh" in name or "hole.mesh" in name):
            fail("a damaged mesh passes as valid")
    print("the same on", ", ".join(map(str, args.ranks)), "ranks")


if __name__ == "__main__":
    main()
