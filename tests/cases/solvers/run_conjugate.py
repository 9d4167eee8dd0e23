#!/usr/bin/env python3
"""Blocks as regions of OpenFOAM: splitMeshRegions makes a region of each block, with its cells, and finds every edge between two of them; checkMesh says
"Mesh OK." of each region. With --conduction also conducts heat through concentric cylinders, on the case's mesh and on one with cells of half the size:
the temperature comes near the exact one.

    run_conjugate.py --quadloop PROGRAM --case CASE.toml [--conduction]

Status 77 where OpenFOAM is not installed.
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

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import ROOT, fail, mesh_case, run, skip  # noqa: E402

sys.path.insert(0, str(ROOT / "tests" / "judge"))
from mesh_files import read_mesh  # noqa: E402

HEADER = "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {kind};\n    object {name};\n}}\n"
RADII, TEMPERATURES, CONDUCTIVITIES = (1.0, 2.0, 3.0), (400.0, 300.0), {"inner": 1.0, "outer": 5.0}
SYSTEM = {
    "controlDict": "application {solver};\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime {steps};\ndeltaT 1;\nwriteInterval {steps};\n"
                   "writePrecision 12;\ntimePrecision 6;\n",
    "fvSchemes": "ddtSchemes {{ default steadyState; }}\ngradSchemes {{ default Gauss linear; }}\ndivSchemes {{ default none; }}\n"
                 "laplacianSchemes {{ default Gauss linear corrected; }}\ninterpolationSchemes {{ default linear; }}\nsnGradSchemes {{ default corrected; }}\n",
    "fvSolution": "solvers {{ h {{ solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; }} }}\nSIMPLE {{ nNonOrthogonalCorrectors 1; }}\n"
                  "relaxationFactors {{ equations {{ h 1; }} }}\n",
}
THERMO = """thermoType
{{
    type heSolidThermo; mixture pureMixture; transport constIso; thermo hConst; equationOfState rhoConst; specie specie; energy sensibleEnthalpy;
}}
mixture
{{
    specie {{ molWeight 1; }}
    transport {{ kappa {kappa}; }}
    thermodynamics {{ Hf 0; Cp 1; }}
    equationOfState {{ rho 1; }}
}}
"""


def environment():
    if shutil.which("splitMeshRegions") is None:
        skip("OpenFOAM is not installed")
    found = dict(os.environ)
    if "WM_PROJECT_DIR" not in found and Path("/usr/share/openfoam").is_dir():
        found["WM_PROJECT_DIR"] = "/usr/share/openfoam"
    return found


def foam(program, case, *options):
    done = subprocess.run([program, "-case", case, *options], capture_output=True, text=True, env=environment(), check=False)
    if done.returncode != 0:
        fail(f"{program}: {done.stdout[-2000:]}{done.stderr[-1000:]}")
    return done.stdout


def write(path, text, kind="dictionary"):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER.format(kind=kind, name=path.name) + text)


def write_system(case, regions, steps=1):
    for folder in (case / "system", *(case / "system" / region for region in regions)):
        for name, text in SYSTEM.items():
            write(folder / name, text.format(solver="chtMultiRegionSimpleFoam", steps=steps))


def patches_of(region):
    """{name: (type, faces)}"""
    text = (region / "polyMesh" / "boundary").read_text()
    return {name: (kind, int(faces)) for name, kind, faces in re.findall(r"(\S+)\s*\{\s*type\s+(\S+);[^}]*?nFaces\s+(\d+);", text)}


def interface_edges(mesh):
    """{(block, other): edges between them}"""
    owner, counts = {}, {}
    cell = 0
    for cells in mesh.kinds():
        for nodes in cells.tolist():
            for a, b in zip(nodes, nodes[1:] + nodes[:1]):
                other = owner.get((b, a))
                owner[a, b] = mesh.of_cells[cell]
                if other is not None and other != mesh.of_cells[cell]:
                    pair = tuple(sorted((int(other), int(mesh.of_cells[cell]))))
                    counts[pair] = counts.get(pair, 0) + 1
            cell += 1
    return counts


def check_regions(case, mesh):
    """What splitMeshRegions makes of the blocks."""
    said = foam("splitMeshRegions", case, "-cellZonesOnly", "-overwrite")
    for block, name in enumerate(mesh.blocks):
        cells = int((mesh.of_cells == block).sum())
        if not (case / "constant" / name / "polyMesh").is_dir():
            fail(f"no region {name}: {said[-2000:]}")
        checked = foam("checkMesh", case, "-region", name)
        if "Mesh OK." not in checked or not re.search(rf"^ +cells: +{cells}$", checked, re.M):
            fail(f"checkMesh of region {name}, which should have {cells} cells: {checked[-3000:]}")
    for (first, second), edges in interface_edges(mesh).items():
        for here, there in ((first, second), (second, first)):
            patches = patches_of(case / "constant" / mesh.blocks[here])
            wanted = ("mappedWall", edges)
            if patches.get(f"{mesh.blocks[here]}_to_{mesh.blocks[there]}") != wanted:
                fail(f"region {mesh.blocks[here]} has the patches {patches}, not {wanted} to {mesh.blocks[there]}")
    print(f"regions {mesh.blocks}: found, each 'Mesh OK.'")


def write_conduction(case, mesh):
    write(case / "constant" / "regionProperties", f"regions ( fluid () solid ({' '.join(mesh.blocks)}) );\n")
    write(case / "constant" / "g", "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 0);\n", "uniformDimensionedVectorField")
    for block in mesh.blocks:
        write(case / "constant" / block / "thermophysicalProperties", THERMO.format(kappa=CONDUCTIVITIES[block]))
        write(case / "constant" / block / "radiationProperties", "radiation off;\nradiationModel none;\n")
        patches = patches_of(case / "constant" / block)
        temperature, pressure = "", ""
        for name, (kind, _) in patches.items():
            ends = {"hot": TEMPERATURES[0], "cold": TEMPERATURES[1]}
            if kind == "empty":
                condition = "type empty;"
            elif kind == "mappedWall":
                condition = "type compressible::turbulentTemperatureCoupledBaffleMixed; Tnbr T; kappaMethod solidThermo; value uniform 350;"
            else:
                condition = f"type fixedValue; value uniform {ends[name]};"
            temperature += f"    {name} {{ {condition} }}\n"
            pressure += f"    {name} {{ {'type empty;' if kind == 'empty' else 'type calculated; value uniform 1e5;'} }}\n"
        write(case / "0" / block / "T", f"dimensions [0 0 0 1 0 0 0];\ninternalField uniform 350;\nboundaryField\n{{\n{temperature}}}\n", "volScalarField")
        write(case / "0" / block / "p", f"dimensions [1 -1 -2 0 0 0 0];\ninternalField uniform 1e5;\nboundaryField\n{{\n{pressure}}}\n", "volScalarField")


def exact(radius, block):
    """In each ring linear in the logarithm of the radius; the heat that flows through both is the same."""
    resistance = [np.log(RADII[i + 1] / RADII[i]) / kappa for i, kappa in enumerate(CONDUCTIVITIES.values())]
    heat = (TEMPERATURES[0] - TEMPERATURES[1]) / sum(resistance)
    start = TEMPERATURES[0] - heat * sum(resistance[:block])
    return start - heat * np.log(radius / RADII[block]) / list(CONDUCTIVITIES.values())[block]


def areas_and_centres(mesh):
    """Of each cell; OpenFOAM's values are those at the centres of area."""
    areas, centres = [], []
    for cells in mesh.kinds():
        p = mesh.points[cells]
        q = np.roll(p, -1, axis=1)
        origin = p[:, :1]
        twice = np.cross(p - origin, q - origin)
        areas.append(twice.sum(axis=1) / 2)
        centres.append(origin[:, 0] + ((p + q - 2 * origin) * twice[:, :, None]).sum(axis=1) / (6 * areas[-1])[:, None])
    return np.concatenate(areas), np.vstack(centres)


def conduction_error(case, mesh, steps=400):
    """The errors in the cells, in the mean square and the largest, as shares of the difference of the temperatures."""
    write_system(case, mesh.blocks, steps)
    write_conduction(case, mesh)
    foam("chtMultiRegionSimpleFoam", case)
    areas, centres = areas_and_centres(mesh)
    worst, squares = 0.0, 0.0
    for block, name in enumerate(mesh.blocks):
        text = (case / str(steps) / name / "T").read_text()
        values = np.array(re.search(r"internalField\s+nonuniform List<scalar>\s*\d+\s*\(([^)]*)\)", text)[1].split(), float)
        wanted = exact(np.hypot(*centres[mesh.of_cells == block].T), block)
        errors = (values - wanted) / (TEMPERATURES[0] - TEMPERATURES[1])
        squares += float((errors ** 2 * areas[mesh.of_cells == block]).sum())
        worst = max(worst, float(np.abs(errors).max()))
    mean = float(np.sqrt(squares / areas.sum()))
    print(f"{len(centres)} cells: errors of the temperature {mean:.3g} in the mean square, {worst:.3g} at most, of the difference")
    return mean, worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--conduction", action="store_true")
    args = parser.parse_args()
    environment()
    for mesh_type in ("hybrid", "delaunay"):
        errors = [run_case(args, mesh_type, factor) for factor in ((1, 0.5) if args.conduction else (1,))]
        if args.conduction and not (errors[1][0] < 0.7 * errors[0][0] and errors[1][1] < 5e-3):
            fail(f"the errors of the temperature, {errors}, do not vanish with the cells")


def run_case(args, mesh_type, factor):
    """Makes the mesh, with cells smaller by the factor, and the regions; returns the error of the temperature, if asked for."""
    sizes = {"spacing.min": 0.05, "spacing.max": 0.2, "boundary.hot.spacing": 0.1, "boundary.between.spacing": 0.1, "boundary.cold.spacing": 0.1}
    finer = [word for key, size in sizes.items() for word in ("--set", f"{key}={size * factor}")] if factor != 1 else []
    with tempfile.TemporaryDirectory(prefix="quadloop_conjugate_") as folder:
        prefix, case = Path(folder) / "mesh", Path(folder) / "case"
        mesh_case(args.quadloop, args.case, prefix, options=["-q", "--type", mesh_type, "--set", 'output.formats=["mesh","polyMesh"]', *finer])
        run([args.quadloop, "check", f"{prefix}.polyMesh"])
        mesh = read_mesh(f"{prefix}.mesh")
        write_system(case, [])
        (case / "constant").mkdir()
        shutil.move(f"{prefix}.polyMesh", case / "constant" / "polyMesh")
        write_system(case, mesh.blocks)
        check_regions(case, mesh)
        return conduction_error(case, mesh) if args.conduction else None


if __name__ == "__main__":
    sys.exit(main())
