#!/usr/bin/python3 -B
"""Lift and drag over nodes with cells that stretch: NACA 0012 at Mach 0.8 and 1.25 degrees (cases/naca0012_m08), one loop with metric meshes, one
with equal sides by wanted sizes, and, where it is on the PATH (`ffbamg` or `bamg`), one with BAMG's meshes from the same variables, all with the
built-in solver. One row a cycle. Needs numpy.

    stretched.py --quadloop PROGRAM [--nodes N ...] [--cycles N] [--only TEXT] [--update docs/notes/adaptation-studies.md]

--nodes   wanted, of every mesh but the first
--only    loops whose name contains the text
--update  puts the figures into the file, between this script's two markers

BAMG's loop begins with its own mesh of 620 nodes and takes the level of error that leads to 95 to 100 % of the nodes wanted; least size and growth
are those of the case. Stretch is the median over the cells of the upper shock, over which the density changes by more than 0.08 of the free stream's,
of the root of the ratio of the moments of their edges.
"""
import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np

import bamg
from bamg import run
from figures import add_update, tell

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cases"))
from front_error import read_native  # noqa: E402

CASE = ROOT / "cases" / "naca0012_m08" / "metric.toml"
VARIABLES, FAR, NAMES = ("density", "y_velocity"), 50.0, ("airfoil", "farfield")
BOUNDS = bamg.Bounds(least=0.002, largest=20.0, ratio=1.6)


def stretch_at_shock(path):
    """The median of the cells' ratio of axes; nan where no cell is that steep."""
    points, triangles, values = read_native(path)
    corners, density = points[triangles], values["density"][triangles]
    edges = np.roll(corners, -1, axis=1) - corners
    moments = np.linalg.eigvalsh(np.einsum("tki,tkj->tij", edges, edges))
    centre = corners.mean(axis=1)
    steep = (np.ptp(density, axis=1) > 0.08) & (abs(centre[:, 0] - 0.6) < 0.3) & (centre[:, 1] > 0.08)
    return float(np.median(np.sqrt(moments[steep, 1] / moments[steep, 0]))) if steep.any() else float("nan")


def row(name, cycle, nodes, record, path):
    return f"| {name} | {cycle} | {nodes} | {record['cl']:.4f} | {record['cd']:.5f} | {record['residual']:.0e} | {stretch_at_shock(path):.1f} |"


# --- quadloop

def own_loop(program, name, settings, nodes, cycles, folder):
    out = folder / "run"
    sets = [f"adapt.max_nodes={nodes}", f"adapt.cycles={cycles}", *settings]
    done = run(program, "-q", "adapt", CASE, "-o", out, *(word for text in sets for word in ("--set", text)), where=folder)
    if done.returncode != 0:
        sys.exit(done.stderr)
    for cycle in sorted(out.glob("cycle_*")):
        record = json.loads((cycle / "record.json").read_text())
        yield row(name, record["cycle"], record["nodes"], record, cycle / "mesh.mesh")
    shutil.rmtree(out)


# --- BAMG

def outline_of_case():
    """The airfoil of the case, clockwise from its trailing edge, and the far field, with sizes for a first mesh."""
    x = 0.5 * (1 - np.cos(np.pi * np.arange(401) / 400))
    y = 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    y[-1] = 0
    airfoil = np.vstack([np.c_[x, -y][::-1][:-1], np.c_[x, y][:-1]])
    count = len(airfoil)
    from_ends = np.minimum(np.hypot(*airfoil.T), np.hypot(airfoil[:, 0] - 1, airfoil[:, 1]))
    edges = [(i, (i + 1) % count, 1) for i in range(count)] + [(count + i, count + (i + 1) % 4, 2) for i in range(4)]
    return bamg.Outline(np.vstack([airfoil, [[-FAR, -FAR], [FAR, -FAR], [FAR, FAR], [-FAR, FAR]]]), edges, NAMES,
                        [*np.minimum(0.05, 0.008 + 0.1 * from_ends), *[BOUNDS.largest] * 4], [0, *range(count, count + 4)])


def bamg_loop(program, nodes, cycles, folder):
    mesh = bamg.first_mesh(outline_of_case(), BOUNDS, folder)
    for cycle in range(cycles + 1):
        bamg.write_native(mesh, NAMES, folder / "mesh.mesh")
        done = run(program, "--json", "solve", CASE, "mesh.mesh", "-o", "flow.mesh", where=folder)
        if done.returncode != 0:
            sys.exit(done.stderr)
        yield row("BAMG", cycle, len(mesh[0]), json.loads(done.stdout), folder / "flow.mesh")
        if cycle < cycles:
            flow = read_native(folder / "flow.mesh")[2]
            mesh = bamg.adapted(mesh, [flow[name] for name in VARIABLES], nodes, BOUNDS, folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", type=Path, required=True)
    parser.add_argument("--nodes", type=int, nargs="+", default=[2000, 4000])
    parser.add_argument("--cycles", type=int, default=4)
    parser.add_argument("--only", default="")
    add_update(parser)
    args = parser.parse_args()
    program = args.quadloop.resolve()
    loops = {"metric": lambda nodes, folder: own_loop(program, "metric", [], nodes, args.cycles, folder),
             "equal sides": lambda nodes, folder: own_loop(program, "equal sides", ['mesh.type="delaunay"'], nodes, args.cycles, folder)}
    if bamg.PROGRAM:
        loops["BAMG"] = lambda nodes, folder: bamg_loop(program, nodes, args.cycles, folder)
    rows = ["flows to a residual of 1e-8", "",
            "| mesh | cycle | nodes | CL | CD | residual | stretch at the shock |", "| --- " * 7 + "|"]
    for nodes in args.nodes:
        for name, loop in loops.items():
            if args.only not in name:
                continue
            with tempfile.TemporaryDirectory(prefix="quadloop_stretched_") as folder:
                for line in loop(nodes, Path(folder)):
                    print(line, flush=True)
                    rows.append(line)
    tell("\n".join(rows), Path(__file__).name, args.update)


main()
