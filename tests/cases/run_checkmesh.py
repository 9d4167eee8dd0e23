#!/usr/bin/env python3
"""OpenFOAM's checkMesh on a layered mesh, extruded one cell thick by a writer of its own: no check fails but that of the aspect ratio, which is what
layers are.

    run_checkmesh.py --quadloop PROGRAM --case CASE.toml [--type delaunay]

checkMesh is looked for on the path, or named by QUADLOOP_CHECKMESH. A mesh of quadrilaterals is asked for an orthogonality too; thin ones divided in two
have none.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from quadloop_runs import ROOT, fail, mesh_case, skip

sys.path.insert(0, str(ROOT / "tests" / "judge"))
from layers import CellEdges  # noqa: E402
from mesh_files import read_mesh  # noqa: E402

ORTHOGONALITY = 60  # degrees; checkMesh itself warns of 70
DEBIAN = Path("/usr/share/openfoam")  # where Debian's package keeps etc/controlDict
HEADER = "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {kind};\n    object {name};\n}}\n"
SYSTEM = {  # without which no program of OpenFOAM starts
    "controlDict": "application checkMesh;\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1;\ndeltaT 1;\nwriteInterval 1;\n",
    "fvSchemes": "ddtSchemes {}\ngradSchemes {}\ndivSchemes {}\nlaplacianSchemes {}\ninterpolationSchemes {}\nsnGradSchemes {}\n",
    "fvSolution": "",
}


def find_checkmesh():
    """The program and its environment; the test is skipped where there is none that starts."""
    program = os.environ.get("QUADLOOP_CHECKMESH") or shutil.which("checkMesh")
    if program is None:
        skip("checkMesh of OpenFOAM is not at hand")
    environment = dict(os.environ)
    if "WM_PROJECT_DIR" not in environment and DEBIAN.exists():
        environment["WM_PROJECT_DIR"] = str(DEBIAN)
    trial = subprocess.run([program, "-help"], capture_output=True, text=True, env=environment, check=False)
    if trial.returncode != 0:
        skip(f"{program} does not start: {trial.stdout[-300:]}{trial.stderr[-300:]}")
    return program, environment


def write_list(folder, name, kind, rows):
    (folder / name).write_text(HEADER.format(kind=kind, name=name) + f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n")


class Extruded:
    """One layer of prisms over the mesh, as OpenFOAM wants its faces: inner ones by owner, then by neighbour, each pointing from the one to the other; then
    those of the patches, which point out of the domain."""

    def __init__(self, mesh, thickness):
        self.mesh, self.thickness, self.n = mesh, thickness, len(mesh.points)
        edges = CellEdges(mesh)
        self.cells, self.sizes = edges.cells, edges.sizes
        self.faces, self.owner, self.neighbour, self.patches = [], [], [], []
        self.add_inner(edges)
        for name, ends in mesh.boundaries.items():
            self.add_sides(edges, name, ends)
        self.add_ends("front", lambda cell: [node + self.n for node in cell])
        self.add_ends("back", lambda cell: cell[::-1])

    def side(self, a, b):
        return [a, b, b + self.n, a + self.n]

    def add_inner(self, edges):
        a, b, cell = edges.rows[:, 0] // self.n, edges.rows[:, 0] % self.n, edges.rows[:, 1]
        other, _ = edges.find(b, a)
        inner = np.flatnonzero((other >= 0) & (cell < other))
        inner = inner[np.lexsort((other[inner], cell[inner]))]
        self.faces += [self.side(int(a[i]), int(b[i])) for i in inner]
        self.owner += cell[inner].tolist()
        self.neighbour += other[inner].tolist()

    def add_sides(self, edges, name, ends):
        cell, _ = edges.find(ends[:, 0], ends[:, 1])
        if (cell < 0).any():
            fail(f"an edge of boundary {name} is no cell's")
        order = np.argsort(cell, kind="stable")
        self.add_patch(name, "patch", [self.side(int(a), int(b)) for a, b in ends[order]], cell[order].tolist())

    def add_ends(self, name, corners):
        faces = [corners(cell[:size].tolist()) for cell, size in zip(self.cells, self.sizes)]
        self.add_patch(name, "empty", faces, list(range(len(faces))))

    def add_patch(self, name, kind, faces, owners):
        self.patches.append(f"{name}\n{{\n    type {kind};\n    nFaces {len(faces)};\n    startFace {len(self.faces)};\n}}")
        self.faces += faces
        self.owner += owners

    def write(self, case):
        folder = case / "constant" / "polyMesh"
        folder.mkdir(parents=True)
        (case / "system").mkdir()
        for name, text in SYSTEM.items():
            (case / "system" / name).write_text(HEADER.format(kind="dictionary", name=name) + text)
        points = [f"({x!r} {y!r} {z!r})" for z in (0.0, self.thickness) for x, y in self.mesh.points.tolist()]
        write_list(folder, "points", "vectorField", points)
        write_list(folder, "faces", "faceList", [f"{len(face)}({' '.join(map(str, face))})" for face in self.faces])
        write_list(folder, "owner", "labelList", list(map(str, self.owner)))
        write_list(folder, "neighbour", "labelList", list(map(str, self.neighbour)))
        write_list(folder, "boundary", "polyBoundaryMesh", self.patches)


def typical_width(mesh):
    """The median edge: neither the thin layers nor the far field are much thinner or wider."""
    edges = np.concatenate([mesh.points[np.roll(cells, -1, axis=1)] - mesh.points[cells] for cells in mesh.kinds()], axis=None).reshape(-1, 2)
    return float(np.median(np.hypot(*edges.T)))


def failed_checks(said):
    """What checkMesh marks with three stars, but aspect ratios."""
    return [line.strip() for line in said.splitlines() if line.startswith(" ***") and "aspect ratio" not in line]


def largest_angle(said):
    found = re.search(r"Mesh non-orthogonality Max: ([0-9.e+-]+)", said)
    if found is None:
        fail(f"checkMesh says nothing of orthogonality: {said[-2000:]}")
    return float(found.group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    args = parser.parse_args()
    program, environment = find_checkmesh()
    with tempfile.TemporaryDirectory(prefix="quadloop_checkmesh_") as folder:
        prefix, case = Path(folder) / "mesh", Path(folder) / "case"
        mesh_case(args.quadloop, args.case, prefix, options=["--type", args.type])
        mesh = read_mesh(f"{prefix}.mesh")
        Extruded(mesh, typical_width(mesh)).write(case)
        done = subprocess.run([program, "-case", case], capture_output=True, text=True, env=environment, check=False)
    said = done.stdout + done.stderr
    print(said[said.find("Checking geometry"):])
    if done.returncode != 0 or "Checking geometry" not in said:
        fail(f"checkMesh ends with {done.returncode}: {said[-2000:]}")
    found = failed_checks(said)
    if args.type == "hybrid" and largest_angle(said) > ORTHOGONALITY:
        found.append(f"non-orthogonality {largest_angle(said)} is above {ORTHOGONALITY}")
    if found:
        fail("; ".join(found))
    print("good")


if __name__ == "__main__":
    main()
