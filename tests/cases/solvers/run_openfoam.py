#!/usr/bin/env python3
"""OpenFOAM in the loop, from one command: a table of figures with their bounds; status 1 where one fails, 77 where OpenFOAM is not installed.

    run_openfoam.py --quadloop PROGRAM wedge|circle|cylinder [--ranks N ...]

wedge: rhoCentralFoam at Mach 2 past the wedge of 10 degrees, three adaptations: angle of the shock and pressure behind it against the exact ones.
circle: the same solver past a circle, four cycles: the stagnation pressure behind the bow shock. cylinder: simpleFoam, laminar, past a
cylinder in layers, the length of its bubble. With --ranks the meshes and trees of all these numbers of ranks of quadloop must be the same, byte for byte.
"""
import argparse
import filecmp
import os
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


def check_circle(cycles, figures):
    """Behind a normal shock at Mach 2, brought to rest (Rayleigh): p02 / p1 = 5.640441."""
    for cycle in cycles:
        _, _, _, flow = read_cells(cycle / "mesh.mesh")
        figures.add(f"{cycle.name}, {len(flow['p'])} cells: largest pressure", flow["p"].max())
    figures.add("stagnation pressure in the last cycle", flow["p"].max(), 0.98 * 5.640441, 1.02 * 5.640441)


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


CHECKS = {"wedge": check_wedge, "circle": check_circle, "cylinder": check_cylinder}


def same_files(one, other):
    return all(filecmp.cmp(a / name, b / name, shallow=False) for a, b in zip(one, other, strict=True) for name in ("mesh.mesh", "mesh.tree.h5"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=CHECKS)
    parser.add_argument("--quadloop", default=str(ROOT / "build" / "release" / "app" / "quadloop"))
    parser.add_argument("--ranks", type=int, nargs="*", default=[1])
    parser.add_argument("--set", action="append", default=[])
    args = parser.parse_args()
    if shutil.which("checkMesh") is None:
        skip("OpenFOAM is not installed")
    figures, runs = Figures(), []
    with tempfile.TemporaryDirectory(prefix="quadloop_openfoam_") as folder:
        for ranks in args.ranks:
            out = Path(folder) / str(ranks)
            words = [*([MPIRUN, "-n", str(ranks)] if ranks > 1 else []), args.quadloop]
            run([*words, "-q", "adapt", ROOT / "cases" / f"openfoam_{args.case}" / "case.toml", "-o", out,
                 *(word for text in args.set for word in ("--set", text))])
            runs.append(sorted(out.glob("cycle_*")))
        check_meshes(runs[0], figures)
        CHECKS[args.case](runs[0], figures)
        for ranks, cycles in zip(args.ranks[1:], runs[1:]):
            figures.add(f"the same meshes, flows and trees on {ranks} ranks", same_files(runs[0], cycles), 1, 1)
    return 1 if figures.missed else 0


if __name__ == "__main__":
    sys.exit(main())
