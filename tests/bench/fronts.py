#!/usr/bin/env python3
"""Errors over nodes with and without nodes that gather at fronts (smooth.targets = "solution"), and with triangles that stretch (mesh.type = "metric").

    fronts.py --quadloop PROGRAM [--nodes N ...] [--only ring|wedge|airfoil] [--update docs/adaptation.md]

ring      a step of width 0.01 across a circle (cases/ring), no flow: L1 error of its linear interpolation
wedge     the oblique shock of cases/wedge: L1 error of the density against the exact flow
airfoil   the NACA 0012 at Mach 0.8 and 1.25 degrees: lift and drag

Wanted sizes (adapt.norm) for so many nodes, six cycles; each flow has to come to 1e-8. "iso. nodes" is how many nodes isotropic cells take for the same error, by
linear interpolation of log error over log nodes among the isotropic meshes of the table; where it lies beyond these, the slope of the last two goes on.
"""
import argparse
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cases"))
from figures import add_update, tell  # noqa: E402
from front_error import l1_error  # noqa: E402
from wedge_error import exact_density  # noqa: E402

KINDS = {
    "hybrid": ["mesh.type=\"hybrid\""],
    "delaunay": ["mesh.type=\"delaunay\""],
    "hybrid, gathered": ["mesh.type=\"hybrid\"", "smooth.targets=\"solution\""],
    "delaunay, gathered": ["mesh.type=\"delaunay\"", "smooth.targets=\"solution\""],
    "metric": ["mesh.type=\"metric\""],
}


def step(x, y):
    return np.tanh((np.hypot(x, y) - 0.6) / 0.01)


def case_of(folder, case, adapt, keep=()):
    """The case with another table [adapt], and lines of it replaced."""
    shutil.copytree(ROOT / "cases" / case, folder)
    text = (folder / "case.toml").read_text()
    text = text[:text.index("[adapt]")] + adapt + text[text.index("[solver]"):]
    for before, after in keep:
        assert before in text, before
        text = text.replace(before, after)
    (folder / "case.toml").write_text(text.replace("../naca0012/", f"{ROOT}/cases/naca0012/"))
    return folder / "case.toml"


def adapt_table(variable, norm, least):
    return f"[adapt]\ncycles = 5\nvariable = {variable}\nnorm = {norm}\nmax_nodes = 1000\nmin = {least}\n\n"


CASES = {
    "ring": (("ring", adapt_table('"height"', 1, 0.0005)), lambda cycle: l1_error(cycle / "mesh.mesh", "height", step)[1]),
    "wedge": (("wedge", adapt_table('"density"', 1, 0.0005),
               [("min = 0.015", "min = 0.05"), ("max = 0.034", "max = 0.2"), ("iterations = 1000", "iterations = 1500"), ("1e-6", "1e-8")]),
              lambda cycle: l1_error(cycle / "mesh.mesh", "density", exact_density)[1]),
    "airfoil": (("naca0012_m08", adapt_table('"y_velocity"', 100, 0.0007), [("tolerance = 1e-5", "tolerance = 1e-8")]), None),
}

LEAST_NODES = {"airfoil": 4000}  # its own sizes take 3600


def last_cycle(program, case, folder, nodes, settings):
    assignments = [word for setting in [*settings, f"adapt.max_nodes={nodes}"] for word in ("--set", setting)]
    subprocess.run([program, "-q", "adapt", case, "-o", folder, *assignments], check=True, stderr=subprocess.DEVNULL)
    cycle = sorted(folder.glob("cycle_*"))[-1]
    record = json.loads((cycle / "record.json").read_text())
    if record.get("residual", 0) > 1e-8:
        print(f"{folder.name}: the flow came to {record['residual']:.1e}", flush=True)
    return cycle, record


def isotropic_nodes(points, error):
    """For this error, by the isotropic meshes' (nodes, error)."""
    points = sorted(points)
    spans = list(zip(points, points[1:]))
    inside = [span for span in spans if span[1][1] <= error <= span[0][1]]
    (n0, e0), (n1, e1) = (inside or spans[-1:])[0]
    return n0 * (error / e0) ** (math.log(n1 / n0) / math.log(e1 / e0))


def rows_of_errors(name, found):
    rows = []
    for kind, meshes in found.items():
        for nodes, error, angle in meshes:
            of_type = found["delaunay"] if kind.startswith("delaunay") else found["hybrid"]
            equal = "" if kind in ("hybrid", "delaunay") else f"{isotropic_nodes([m[:2] for m in of_type], error):.0f}"
            rows.append(f"| {name} | {kind} | {nodes} | {error:.2e} | {equal} | {angle:.1f} |")
    return rows


def measure(program, name, nodes, folder):
    make, error_of = CASES[name]
    case = case_of(folder / name, *make)
    found, rows = {}, []
    for kind, settings in KINDS.items():
        found[kind] = []
        for wanted in (n for n in nodes if n >= LEAST_NODES.get(name, 0)):
            cycle, record = last_cycle(program, case, folder / f"{name}_{kind.replace(', ', '_')}_{wanted}", wanted, settings)
            if error_of is None:
                rows.append(f"| {name} | {kind} | {record['nodes']} | CL {record['cl']:.4f}, CD {record['cd']:.5f} | | {record['worst_angle']:.1f} |")
            else:
                found[kind].append((record["nodes"], error_of(cycle), record["worst_angle"]))
            print(name, kind, record["nodes"], rows[-1] if error_of is None else found[kind][-1][1], flush=True)
    return rows if error_of is None else rows_of_errors(name, found)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--nodes", type=int, nargs="+", default=[1000, 2000, 4000, 8000])
    parser.add_argument("--only", choices=CASES)
    add_update(parser)
    args = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in [args.only] if args.only else CASES:
            rows += measure(args.quadloop.resolve(), name, args.nodes, Path(folder))
    tell("\n".join(["last cycle of six.", "", "| case | cells | nodes | error | iso. nodes | smallest angle |", "|---|---|---|---|---|---|", *rows]), "fronts.py",
         args.update)


main()
