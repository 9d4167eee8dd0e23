#!/usr/bin/env python3
"""OpenFOAM's checkMesh on cases' meshes, each extruded to one layer of cells: it says "Mesh OK."; where a case has layers, no check fails but that of the
aspect ratio, which is what layers are. checkMesh must have as many prisms and hexahedra as the mesh has triangles and quads, and all of its boundaries;
`quadloop check` must foretell its non-orthogonality and skewness.

    run_checkmesh.py --quadloop PROGRAM --case CASE.toml [...] [--type delaunay] [--fractal]

checkMesh is looked for on the path, or named by QUADLOOP_CHECKMESH. No angle between a face's normal and the line of its cells' centres may be above 60 degrees;
not asked of thin quadrilaterals divided in two, and with --fractal of none: cells in the clefts of a coast have the angles of the coast.
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

from quadloop_runs import ROOT, mesh_case, run, skip

sys.path.insert(0, str(ROOT / "tests" / "judge"))
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


def write_system(case):
    (case / "system").mkdir(parents=True)
    (case / "constant").mkdir()
    for name, text in SYSTEM.items():
        (case / "system" / name).write_text(HEADER.format(kind="dictionary", name=name) + text)


def typical_width(mesh):
    """The median edge: neither the thin layers nor the far field are much thinner or wider."""
    edges = np.concatenate([mesh.points[np.roll(cells, -1, axis=1)] - mesh.points[cells] for cells in mesh.kinds()], axis=None).reshape(-1, 2)
    return float(np.median(np.hypot(*edges.T)))


def number_after(label, said):
    found = re.search(re.escape(label) + r"\s*([0-9.e+-]+)", said)
    return float(found.group(1)) if found else float("nan")


def has_layers(case):
    """Whether any boundary, wake or line of the case has."""
    def within(value):
        return isinstance(value, dict) and ("layers" in value or any(map(within, value.values())))
    settings = tomllib.loads(case.read_text())
    return within(settings) or "wake" in settings or "layer_line" in settings


def patches_of(mesh):
    """The boundaries that are no interface of two blocks, whose faces are inner ones."""
    cell_edges = {(int(a), int(b)) for cells in mesh.kinds() for cell in cells for a, b in zip(cell, (*cell[1:], cell[0]))}
    return [name for name, edges in mesh.boundaries.items() if not any((int(b), int(a)) in cell_edges for a, b in edges)]


def faults_of(mesh, said, layers, limit):
    """What is amiss with what checkMesh says of the mesh."""
    triangles, quadrilaterals = map(len, mesh.kinds())
    yield from (f"{count} {kind}, where the mesh has {wanted}" for kind, wanted, count in (
        ("prisms", triangles, number_after("prisms:", said)), ("hexahedra", quadrilaterals, number_after("hexahedra:", said)),
        ("points", 2 * len(mesh.points), number_after("points:", said))) if count != wanted)
    yield from (f"no patch {name}" for name in patches_of(mesh) if not re.search(rf"^ +{re.escape(name)} *[0-9]", said, re.M))
    failed = [line.strip() for line in said.splitlines() if line.startswith(" ***")]
    yield from (line for line in failed if not layers or "aspect ratio" not in line)
    if not failed and "Mesh OK." not in said:
        yield "does not say 'Mesh OK.'"
    angle = number_after("Mesh non-orthogonality Max:", said)
    if not angle <= limit:
        yield f"non-orthogonality {angle} is above {limit}"


def own_figures_that_differ(quadloop, mesh, said):
    """What `quadloop check` foretells of checkMesh, by its own figures."""
    record = json.loads(subprocess.run([quadloop, "check", mesh, "--json"], capture_output=True, text=True, check=False).stdout)
    for key, label in (("non_orthogonality", "Mesh non-orthogonality Max:"), ("skewness", "Max skewness =")):
        theirs = number_after(label, said)
        if not abs(record[key] - theirs) <= 1e-3 * max(theirs, 1):
            yield f"check says {key} {record[key]}, checkMesh {theirs}"


def check(args, case, checkmesh, folder):
    """A line of the table, and whether all is well."""
    program, environment = checkmesh
    prefix, foam = folder / "mesh", folder / "case"
    mesh_case(args.quadloop, case, prefix, options=["-q", "--type", args.type])
    mesh = read_mesh(f"{prefix}.mesh")
    write_system(foam)
    run([args.quadloop, "-q", "extrude", f"{prefix}.mesh", "-o", foam / "constant" / "polyMesh", "--layers", 1, "--thickness", typical_width(mesh)])
    done = subprocess.run([program, "-case", foam], capture_output=True, text=True, env=environment, check=False)
    said = done.stdout + done.stderr
    layers = has_layers(case)
    limit = 90 if args.fractal or (layers and args.type == "delaunay") else ORTHOGONALITY
    faults = list(faults_of(mesh, said, layers, limit)) + list(own_figures_that_differ(args.quadloop, f"{prefix}.mesh", said)) + [f"exit status {done.returncode}"] * (done.returncode != 0)
    print(f"{case.parent.name}/{case.stem} {args.type}: {len(mesh.points)} nodes, {'layers, ' * layers}non-orthogonality "
          f"{number_after('Mesh non-orthogonality Max:', said)}, skewness {number_after('Max skewness =', said)}, "
          f"aspect ratio {number_after('Max aspect ratio =', said)}: {'; '.join(faults) or 'good'}", flush=True)
    if faults:
        print(said[said.find("Checking geometry"):])
    return not faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path, nargs="+")
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--fractal", action="store_true")
    args = parser.parse_args()
    checkmesh = find_checkmesh()
    good = True
    for case in args.case:
        with tempfile.TemporaryDirectory(prefix="quadloop_checkmesh_") as folder:
            good = check(args, case, checkmesh, Path(folder)) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
