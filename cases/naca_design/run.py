#!/usr/bin/env python3
"""A design cycle: the first airfoil is adapted, each later one takes tree and flow over from the shape before it. Standard library only.

    python3 cases/naca_design/run.py -o design [--quadloop PROGRAM] [--ranks N] [--shapes N] [--set KEY=VALUE ...]

The folder then holds shape_00/ (an adaptive run) and of every later shape shape_KK.geom, shape_KK.tree.h5, shape_KK.mesh (the mesh with the flow carried
over) and shape_KK.flow.mesh (with its own flow). An optimiser of yours takes the place of `walk`: see README.md.
"""
import argparse
import json
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from shapes import airfoil, walk, write_geometry

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


@dataclass
class Programs:
    """How quadloop is called."""
    quadloop: str
    ranks: int
    options: list

    def run(self, *words):
        launcher = [str(ROOT / "scripts" / "mpirun"), "-n", str(self.ranks)] if self.ranks > 1 else []
        command = [*launcher, self.quadloop, *map(str, words), *self.options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        return done.stdout


def figure(table, name):
    """A row's number in a table that quadloop printed."""
    return float(re.search(rf"^ +{name} +(\S+)$", table, re.M)[1])


def without_flow(mesh, path):
    """The mesh alone: the solution stands at a native mesh's end."""
    path.write_text(mesh.read_text().partition("#Number of constants")[0])


def solve(programs, mesh, out):
    begun = time.monotonic()
    table = programs.run("solve", HERE / "case.toml", mesh, "-o", out)
    values = {name: figure(table, name) for name in ("nodes", "steps", "cl", "cd")}
    return values | {"solve": time.monotonic() - begun}


def first_shape(programs, folder):
    """Adapted by the loop: the tree and the flow of its last cycle, and what that cycle's record says."""
    begun = time.monotonic()
    programs.run("adapt", HERE / "case.toml", "-o", folder / "shape_00")
    last = max((folder / "shape_00").glob("cycle_*"))
    record = json.loads((last / "record.json").read_text())
    values = {name: record[name] for name in ("nodes", "cl", "cd")}
    return last / "mesh.tree.h5", last / "mesh.mesh", values | {"solve": time.monotonic() - begun}


def next_shape(programs, tree, flow, prefix):
    """The mesh of PREFIX.geom from the tree and the flow of the shape before, and its flow."""
    begun = time.monotonic()
    table = programs.run("remesh", "--tree", tree, "--solution", flow, "--geometry", f"{prefix}.geom", HERE / "case.toml", "-o", prefix,
                         "--set", 'output.formats=["mesh"]')
    values = {"outside": figure(table, "nodes outside the old mesh"), "remesh": time.monotonic() - begun}
    return values | solve(programs, f"{prefix}.mesh", f"{prefix}.flow.mesh")


def row(number, shape, values):
    """A line of the table; the first shape has no remeshing, and its seconds are those of the whole adaptive run."""
    def text(name, form):
        return format(values[name], form) if name in values else ""
    cells = [str(number), *(f"{100 * part:.2f}" for part in shape), text("nodes", ".0f"), text("outside", ".0f"), text("steps", ".0f"),
             text("cl", ".4f"), text("cd", ".5f"), text("remesh", ".1f"), text("solve", ".1f")]
    return f"| {' | '.join(cells)} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    parser.add_argument("-o", "--out", required=True, type=Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--shapes", type=int, default=10)
    parser.add_argument("--set", action="append", default=[])
    args = parser.parse_args()
    programs = Programs(args.quadloop, args.ranks, [word for text in args.set for word in ("--set", text)])
    shapes = walk(args.shapes)
    if len(shapes) < 2:
        parser.error("--shapes must be 2 or more")
    args.out.mkdir(parents=True)
    tree, flow, values = first_shape(programs, args.out)
    print("| shape | camber % | thickness % | nodes | outside | steps | CL | CD | s of remesh | s of solve |\n|---|---|---|---|---|---|---|---|---|---|")
    print(row(0, shapes[0], values), flush=True)
    for number, shape in enumerate(shapes[1:], 1):
        prefix = args.out / f"shape_{number:02d}"
        write_geometry(f"{prefix}.geom", airfoil(*shape))
        values = next_shape(programs, tree, flow, prefix)
        tree, flow = f"{prefix}.tree.h5", f"{prefix}.flow.mesh"
        print(row(number, shape, values), flush=True)
    bare = args.out / "free_stream.mesh"
    without_flow(Path(f"{prefix}.mesh"), bare)
    afresh = solve(programs, bare, args.out / "free_stream.flow.mesh")
    print(f"\nthe last shape from the free stream: {afresh['steps']:.0f} steps, {afresh['solve']:.1f} s, CL {afresh['cl']:.4f}, CD {afresh['cd']:.5f}")


if __name__ == "__main__":
    main()
