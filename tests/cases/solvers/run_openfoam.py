#!/usr/bin/env python3
"""OpenFOAM in the loop, from one command: a table of figures with their bounds; status 1 where one fails, 77 where OpenFOAM is not installed.

    run_openfoam.py --quadloop PROGRAM wedge|circle|cylinder [--ranks N ...] [--small]

Four cycles each. wedge: rhoCentralFoam at Mach 2 past the wedge of 10 degrees: angle of the shock, pressure behind it and force on the ramp against the exact
ones. circle: the same solver past a circle: the stagnation pressure behind the bow shock. cylinder: simpleFoam, laminar, past a cylinder in layers: the length
of its bubble and its drag, the latter beside OpenFOAM's own. With --ranks meshes, flows, trees and tables of all these numbers of ranks of quadloop must be the
same, byte for byte. --small asks for nothing else, on coarse meshes and with few steps.
"""
import argparse
import filecmp
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import MPIRUN, ROOT, run, skip
from run_forces import Figures, shock_angle
from wedge_error import DENSITY_BEHIND, PRESSURE_RATIO, SHOCK_DEGREES


def read_cells(path):
    """Nodes, triangles, quads, and a dictionary of the variables of the cells, triangles first."""
    rows, names = [], []
    lines = iter(Path(path).read_text().splitlines())

    def block():
        return [next(lines).split() for _ in range(int(next(lines)))]

    def section(head):
        for line in lines:
            if line.startswith(head):
                return
        sys.exit(f"{path}: has no section '{head}'")

    section("#Number of grid points")
    points = np.array(block(), float)
    section("#Number of triangular elements")
    triangles = np.array(block(), int).reshape(-1, 3) - 1
    section("#Number of quadrilateral elements")
    quads = np.array(block(), int).reshape(-1, 4) - 1
    section("#Number of cell variables")
    next(lines)
    names = next(lines).split()[1:]
    rows = np.array([next(lines).split() for _ in range(len(triangles) + len(quads))], float)
    return points, triangles, quads, {name: rows[:, i] for i, name in enumerate(names)}


def to_nodes(points, triangles, quads, values):
    """Means of the cells round a node."""
    sums, counts = np.zeros(len(points)), np.zeros(len(points))
    for cells, of_cells in ((triangles, values[:len(triangles)]), (quads, values[len(triangles):])):
        for corner in cells.T:
            np.add.at(sums, corner, of_cells)
            np.add.at(counts, corner, 1)
    return sums / counts.clip(min=1)


def centroids(points, triangles, quads):
    return np.vstack([points[triangles].mean(axis=1), points[quads].mean(axis=1)])


def check_meshes(cycles, figures):
    """What OpenFOAM's own check says of each cycle's mesh."""
    environment = dict(os.environ)
    if "WM_PROJECT_DIR" not in environment and Path("/usr/share/openfoam").is_dir():
        environment["WM_PROJECT_DIR"] = "/usr/share/openfoam"
    accepted = 0
    for cycle in cycles:
        said = subprocess.run(["checkMesh", "-case", cycle / "openfoam"], env=environment, text=True, capture_output=True, check=False).stdout
        accepted += "Mesh OK." in said
    figures.add("meshes of which checkMesh says 'Mesh OK.'", accepted, len(cycles), len(cycles))


def check_wedge(cycles, figures):
    points, triangles, quads, flow = read_cells(cycles[-1] / "mesh.mesh")
    halves = np.vstack([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    density = to_nodes(points, triangles, quads, flow["rho"] / 1.4)
    figures.add("nodes", len(points))
    figures.add("shock angle, degrees", shock_angle(points, halves, density, (1 + DENSITY_BEHIND) / 2), SHOCK_DEGREES - 0.5, SHOCK_DEGREES + 0.5)
    places = centroids(points, triangles, quads)
    heights = places[:, 1] / places[:, 0].clip(min=0.3)
    behind = (places[:, 0] > 0.3) & (heights > 0.25) & (heights < 0.65)
    ahead = (places[:, 0] < -0.1) | (heights > 1.2)
    ratio = flow["p"][behind].mean() / flow["p"][ahead].mean()
    figures.add("pressure behind over before the shock", ratio, 0.99 * PRESSURE_RATIO, 1.01 * PRESSURE_RATIO)
    coefficient = (PRESSURE_RATIO - 1) / (0.5 * 1.4 * 2 ** 2)
    for key, exact in (("cd", coefficient * math.tan(math.radians(10))), ("cl", -coefficient)):  # the ramp reaches from x = 0 to 1
        figures.add(f"{key} of the ramp, exact {exact:.5f}", forces(cycles[-1])["ramp"][key], *sorted((0.99 * exact, 1.01 * exact)))


def check_circle(cycles, figures):
    """Behind a normal shock at Mach 2, brought to rest (Rayleigh): p02 / p1 = 5.640441."""
    for cycle in cycles:
        _, _, _, flow = read_cells(cycle / "mesh.mesh")
        figures.add(f"{cycle.name}, {len(flow['p'])} cells: largest pressure", flow["p"].max())
    figures.add("stagnation pressure in the last cycle", flow["p"].max(), 0.98 * 5.640441, 1.02 * 5.640441)
    figures.add("cd", forces(cycles[-1])["circle"]["cd"])


def check_cylinder(cycles, figures):
    """Laminar at Re 40: the separation bubble is 2.1 to 2.35 diameters long (Coutanceau and Bouard 1977; Dennis and Chang 1970)."""
    points, triangles, quads, flow = read_cells(cycles[-1] / "mesh.mesh")
    places = centroids(points, triangles, quads)
    wake = (abs(places[:, 1]) < 0.05) & (places[:, 0] > 0.5) & (places[:, 0] < 4)
    order = np.argsort(places[wake, 0])
    x, u = places[wake, 0][order], flow["U_x"][wake][order]
    end = np.flatnonzero((u[:-1] < 0) & (u[1:] >= 0))
    figures.add("nodes", len(points))
    figures.add("length of the bubble, diameters", x[end[-1]] - 0.5 if len(end) else 0, 1.9, 2.5)
    own = forces(cycles[-1])["cylinder"]
    figures.add("cd", own["cd"], 1.45, 1.65)
    figures.add("cl", own["cl"], -0.01, 0.01)
    rows = [line.split() for line in next((cycles[-1] / "openfoam" / "postProcessing" / "forces").glob("*/coefficient.dat")).read_text().splitlines()]
    names, last = next(row for row in reversed(rows) if row[0] == "#")[1:], rows[-1]
    theirs = float(last[names.index("Cd")])
    figures.add("cd by OpenFOAM's forceCoeffs", theirs)
    figures.add("ours over OpenFOAM's", own["cd"] / theirs, 0.99, 1.01)


def forces(cycle):
    return json.loads((cycle / "record.json").read_text())["forces"]


def check_tables(cycles, figures):
    """Each cycle tells the forces, their sum and the flow along its wall."""
    whole = 0
    for cycle in cycles:
        record = json.loads((cycle / "record.json").read_text())
        rows = (cycle / "mesh.walls.csv").read_text().splitlines()
        adds_up = all(abs(record[key] - sum(wall[key] for wall in record["forces"].values())) < 1e-12 for key in ("cl", "cd"))
        whole += adds_up and len(record["forces"]) == 1 and rows[0].startswith("boundary,s,x,y,Cp,Mach") and len(rows) > 10
    figures.add("cycles with forces and a table of the wall", whole, 4, 4)


CHECKS = {"wedge": check_wedge, "circle": check_circle, "cylinder": check_cylinder}


# What --small changes: lengths of the case, and the steps of its template.
SMALL = {"wedge": ({"spacing.min": 0.03, "spacing.max": 0.068, "adapt.min": 0.008}, {"endTime": 200, "writeInterval": 200}),
         "circle": ({"spacing.min": 0.04, "spacing.max": 0.6, "boundary.circle.spacing": 0.1, "adapt.min": 0.01, "adapt.max_nodes": 8000},
                    {"endTime": 400, "writeInterval": 400}),
         "cylinder": ({"spacing.min": 0.04, "spacing.max": 2.0, "boundary.cylinder.spacing": 0.12, "adapt.min": 0.01, "adapt.max_nodes": 15000},
                      {"endTime": 60, "writeInterval": 60})}


def small_case(name, folder):
    """A copy of the case with few steps, and the assignments for coarse meshes."""
    settings, steps = SMALL[name]
    for given in ("openfoam_" + name, "wedge"):
        shutil.copytree(ROOT / "cases" / given, folder / given)
    control = folder / ("openfoam_" + name) / "template" / "system" / "controlDict"
    text = control.read_text()
    for key, value in steps.items():
        text = re.sub(rf"^{key} .*?;", f"{key} {value};", text, flags=re.M)
    control.write_text(text)
    return folder / ("openfoam_" + name) / "case.toml", [f"{key}={value}" for key, value in settings.items()]


def record_without_times(cycle):
    record = json.loads((cycle / "record.json").read_text())
    del record["seconds"]
    return record


def same_files(one, other):
    names = ("mesh.mesh", "mesh.tree.h5", "mesh.walls.csv")
    return all(filecmp.cmp(a / name, b / name, shallow=False) for a, b in zip(one, other, strict=True) for name in names) and \
        all(record_without_times(a) == record_without_times(b) for a, b in zip(one, other, strict=True))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=CHECKS)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    parser.add_argument("--ranks", type=int, nargs="*", default=[1])
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--small", action="store_true")
    args = parser.parse_args()
    if shutil.which("checkMesh") is None:
        skip("OpenFOAM is not installed: scripts/setup --full installs Debian's package `openfoam`")
    figures, runs = Figures(), []
    with tempfile.TemporaryDirectory(prefix="quadloop_openfoam_") as folder:
        case, assignments = ROOT / "cases" / f"openfoam_{args.case}" / "case.toml", args.set
        if args.small:
            case, assignments = small_case(args.case, Path(folder) / "cases")
        for ranks in args.ranks:
            out = Path(folder) / str(ranks)
            words = [*([MPIRUN, "-n", str(ranks)] if ranks > 1 else []), args.quadloop]
            run([*words, "-q", "adapt", case, "-o", out, *(word for text in assignments for word in ("--set", text))])
            runs.append(sorted(out.glob("cycle_*")))
            figures.add(f"cycles on {ranks} ranks", len(runs[-1]), 4, 4)
        check_meshes(runs[0], figures)
        check_tables(runs[0], figures)
        if not args.small:
            CHECKS[args.case](runs[0], figures)
        for ranks, cycles in zip(args.ranks[1:], runs[1:]):
            figures.add(f"the same files on {ranks} ranks", same_files(runs[0], cycles), 1, 1)
    return 1 if figures.missed else 0


if __name__ == "__main__":
    sys.exit(main())
