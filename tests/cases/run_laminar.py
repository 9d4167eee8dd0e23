#!/usr/bin/env python3
"""Laminar flow on layered meshes against what is known. A table of figures with their bounds; status 1 where one fails.

    run_laminar.py --quadloop PROGRAM

Drag of the NACA 0012 at Mach 0.5 and Reynolds number 5000 and where its boundary layer comes off, as published, on a mesh by hand and on an adapted one; a flat plate's friction as of Blasius.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from quadloop_runs import ROOT, run
from run_forces import Figures


def walls(path, name):
    """The nodes (x, y) of a boundary along x, and wall_shear at them."""
    lines = Path(path).read_text().splitlines()
    points = [tuple(map(float, line.split())) for line in lines[2:2 + int(lines[1])]]
    start = next(i for i, line in enumerate(lines) if line.startswith("#Number of edges") and line.endswith(f"({name})"))
    edges = [line.split() for line in lines[start + 2:start + 2 + int(lines[start + 1])]]
    nodes = sorted({int(node) - 1 for edge in edges for node in edge}, key=lambda node: points[node])
    shear = [float(line.split()[4]) for line in lines[-len(points):]]
    return [(*points[node], shear[node]) for node in nodes]


def separation(nodes, way=1):
    """Where the friction on one side of the airfoil changes its sign behind the middle; None where it does not, or more than once."""
    side = [(x, shear) for x, y, shear in nodes if way * y > 0 and 0.5 < x < 0.98]
    signs = [(x, shear, to, then) for (x, shear), (to, then) in zip(side, side[1:]) if shear > 0 >= then]
    if len(signs) != 1:
        return None
    (x, shear, to, then), = signs
    return round(x + shear / (shear - then) * (to - x), 4)


def solve(quadloop, name, folder):
    """What the solver tells, and the file that it leaves."""
    case, flow = ROOT / "cases" / name / "case.toml", folder / f"{name}_flow.mesh"
    run([quadloop, "mesh", case, "-o", folder / name, "--set", 'output.formats=["mesh"]'])
    told = subprocess.run([quadloop, "-q", "solve", case, folder / f"{name}.mesh", "-o", flow, "--json"], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(told.stdout), flow


def airfoil(quadloop, folder, figures):
    told, flow = solve(quadloop, "naca0012_laminar", folder)
    figures.add("airfoil: nodes", told["nodes"], 0, 10000)
    figures.add("airfoil: residual", told["residual"], 0, 1e-6)
    figures.add("airfoil: CD, published 0.0554 to 0.0556", told["cd"], 0.0554 * 0.99, 0.0556 * 1.01)
    figures.add("airfoil: CD by friction", told["cd_friction"], 0.031, 0.033)
    figures.add("airfoil: CL", told["cl"], -2e-4, 2e-4)
    figures.add("airfoil: the flow separates at, published 0.81 to 0.82", separation(walls(flow, "airfoil")), 0.805, 0.825)


def adapted(quadloop, folder, figures):
    """The last mesh of the loop."""
    made = folder / "adapted"
    run([quadloop, "adapt", ROOT / "cases" / "naca0012_laminar" / "adapt.toml", "-o", made])
    last = sorted(made.glob("cycle_*"))[-1]
    record = json.loads((last / "record.json").read_text())
    figures.add("adapted: cycles", int(last.name[-2:]), 1, 3)
    figures.add("adapted: nodes", record["nodes"], 9500, 10000)
    figures.add("adapted: residual", record["residual"], 0, 1e-6)
    figures.add("adapted: CD, published 0.0554 to 0.0556", record["cd"], 0.0554 * 0.99, 0.0556 * 1.01)
    figures.add("adapted: the flow separates at, published 0.81 to 0.82", separation(walls(last / "mesh.mesh", "airfoil")), 0.805, 0.825)


def plate(quadloop, folder, figures):
    told, flow = solve(quadloop, "flat_plate_laminar", folder)
    figures.add("plate: residual", told["residual"], 0, 1e-6)
    figures.add("plate: CD over Blasius'", told["cd"] / (1.328 / math.sqrt(1e5)), 0.98, 1.02)
    for x, _, shear in walls(flow, "plate"):
        if not 0.25 < x < 0.95:
            continue
        figures.add(f"plate: friction over Blasius' at {x:.3f}", shear / (0.5 * 0.2**2) * math.sqrt(1e5 * x) / 0.664, 0.98, 1.02)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quadloop", required=True)
    arguments = parser.parse_args()
    figures = Figures()
    with tempfile.TemporaryDirectory() as folder:
        airfoil(arguments.quadloop, Path(folder), figures)
        adapted(arguments.quadloop, Path(folder), figures)
        plate(arguments.quadloop, Path(folder), figures)
    return 1 if figures.missed else 0


if __name__ == "__main__":
    sys.exit(main())
