#!/usr/bin/env python3
"""Errors over nodes with and without nodes that gather at fronts (smooth.targets = "solution"), and with triangles that stretch (mesh.type = "metric").

    fronts.py --quadloop PROGRAM [--nodes N ...] [--only ring|wedge|airfoil] [--kind TEXT] [--update docs/notes/adaptation-studies.md]

ring      a step of width 0.01 across a circle (cases/ring), no flow: L1 error of its linear interpolation
wedge     the oblique shock of cases/wedge: L1 error of the density against the exact flow
airfoil   the NACA 0012 at Mach 0.8 and 1.25 degrees: lift and drag

Wanted sizes (adapt.norm) for so many nodes, six cycles; each flow has to come to 1e-8. "iso. nodes" is how many nodes isotropic cells take for the same error, by
linear interpolation of log error over log nodes among the isotropic meshes of the table; where it lies beyond these, the slope of the last two goes on.
Ring and wedge also with BAMG's meshes where it is on the PATH, adapted as often to the same variable within the same bounds of sizes; for the airfoil
stretched.py compares with it. --kind: only kinds of cells whose name contains the text.
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
import bamg  # noqa: E402
from figures import add_update, tell  # noqa: E402
from front_error import l1_error, read_native  # noqa: E402
from wedge_error import exact_density  # noqa: E402

KINDS = {
    "hybrid": ["mesh.type=\"hybrid\""],
    "delaunay": ["mesh.type=\"delaunay\""],
    "hybrid, gathered": ["mesh.type=\"hybrid\"", "smooth.targets=\"solution\""],
    "delaunay, gathered": ["mesh.type=\"delaunay\"", "smooth.targets=\"solution\""],
    "metric": ["mesh.type=\"metric\""],
}
CYCLES = 5


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
    return f"[adapt]\ncycles = {CYCLES}\nvariable = {variable}\nnorm = {norm}\nmax_nodes = 1000\nmin = {least}\n\n"


CASES = {
    "ring": (("ring", adapt_table('"height"', 1, 0.0005)), lambda cycle: l1_error(cycle / "mesh.mesh", "height", step)[1]),
    "wedge": (("wedge", adapt_table('"density"', 1, 0.0005),
               [("min = 0.015", "min = 0.05"), ("max = 0.034", "max = 0.2"), ("iterations = 1000", "iterations = 1500"), ("1e-6", "1e-8")]),
              lambda cycle: l1_error(cycle / "mesh.mesh", "density", exact_density)[1]),
    "airfoil": (("naca0012_m08", adapt_table('"y_velocity"', 100, 0.0007), [("tolerance = 1e-5", "tolerance = 1e-8")]), None),
}

LEAST_NODES = {"airfoil": 4000}  # its own sizes take 3600
OUTLINES = {  # for BAMG: corners, a boundary for each edge or one for all, bounds of sizes
    "ring": ([(-1, -1), (1, -1), (1, 1), (-1, 1)], ("frame",), bamg.Bounds(least=0.0005, largest=0.13, ratio=1.5, error=1e3)),
    "wedge": ([(-0.5, 1.2), (-0.5, 0), (0, 0), (1, 0.17632698070846498), (1, 1.2)], ("inlet", "floor", "ramp", "outlet", "top"),
              bamg.Bounds(least=0.0005, largest=0.2, ratio=1.5, error=1e3, corner=5)),
}


def told_if_far(name, residual):
    if residual > 1e-8:
        print(f"{name}: the flow came to {residual:.1e}", flush=True)


def last_cycle(program, case, folder, nodes, settings):
    assignments = [word for setting in [*settings, f"adapt.max_nodes={nodes}"] for word in ("--set", setting)]
    subprocess.run([program, "-q", "adapt", case, "-o", folder, *assignments], check=True, stderr=subprocess.DEVNULL)
    cycle = sorted(folder.glob("cycle_*"))[-1]
    record = json.loads((cycle / "record.json").read_text())
    told_if_far(folder.name, record.get("residual", 0))
    return cycle, record


# --- BAMG

def solved(program, case, folder):
    """The case's flow on the folder's bamg.mesh, as its mesh.mesh; the residual that it came to."""
    if case.parent.name == "ring":
        bamg.run(sys.executable, case.parent / "solver.py", "bamg.mesh", "mesh.mesh", where=folder).check_returncode()
        return 0.0
    done = bamg.run(program, "--json", "solve", case, "bamg.mesh", "-o", "mesh.mesh", where=folder)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["residual"]


def smallest_angle(path):
    points, triangles, _ = read_native(path)
    corners = points[triangles]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross, dot = ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0], (ahead * back).sum(axis=2)
    return float(np.degrees(np.arctan2(cross, dot)).min())


def last_of_bamg(program, name, case, folder, wanted):
    """BAMG's mesh with its flow after as many cycles, in the folder, and what last_cycle's record tells of a mesh."""
    folder.mkdir()
    (corners, names, bounds), (_, adapt) = OUTLINES[name], CASES[name][0][:2]
    variable = adapt.split('"')[1]
    count = len(corners)
    edges = [(i, (i + 1) % count, i % len(names) + 1) for i in range(count)]
    mesh = bamg.first_mesh(bamg.Outline(np.array(corners, dtype=float), edges, names, [bounds.largest] * count, [*range(count)]), bounds, folder)
    for cycle in range(CYCLES + 1):
        if cycle > 0:
            mesh = bamg.adapted(mesh, [read_native(folder / "mesh.mesh")[2][variable]], wanted, bounds, folder)
        bamg.write_native(mesh, names, folder / "bamg.mesh")
        told_if_far(folder.name, solved(program, case, folder))
    return folder, {"nodes": len(mesh[0]), "worst_angle": smallest_angle(folder / "mesh.mesh")}


# --- the table

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
            of_type = found.get("delaunay" if kind.startswith("delaunay") else "hybrid", [])
            equal = "" if kind in ("hybrid", "delaunay") or len(of_type) < 2 else f"{isotropic_nodes([m[:2] for m in of_type], error):.0f}"
            rows.append(f"| {name} | {kind} | {nodes} | {error:.2e} | {equal} | {angle:.1f} |")
    return rows


def measure(program, name, nodes, text, folder):
    make, error_of = CASES[name]
    case = case_of(folder / name, *make)
    meshes = {kind: lambda out, wanted, settings=settings: last_cycle(program, case, out, wanted, settings) for kind, settings in KINDS.items()}
    if bamg.PROGRAM and name in OUTLINES:
        meshes["BAMG"] = lambda out, wanted: last_of_bamg(program, name, case, out, wanted)
    found, rows = {}, []
    for kind in (kind for kind in meshes if text in kind):
        found[kind] = []
        for wanted in (n for n in nodes if n >= LEAST_NODES.get(name, 0)):
            cycle, record = meshes[kind](folder / f"{name}_{kind.replace(', ', '_')}_{wanted}", wanted)
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
    parser.add_argument("--kind", default="")
    add_update(parser)
    args = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in [args.only] if args.only else CASES:
            rows += measure(args.quadloop.resolve(), name, args.nodes, args.kind, Path(folder))
    tell("\n".join(["last cycle of six.", "", "| case | cells | nodes | error | iso. nodes | smallest angle |", "|---|---|---|---|---|---|", *rows]), "fronts.py",
         args.update)


main()
