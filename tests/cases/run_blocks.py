#!/usr/bin/env python3
"""A case with several blocks, both types of mesh: valid for `quadloop check` and the judges, the same bytes on 1, 2, 3, 5 and 8 ranks in every
format that holds blocks, as expected (expected.toml); what does not work with blocks is refused in one line.

    run_blocks.py --quadloop PROGRAM --case CASE.toml [--write-expected]
"""
import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import JUDGE, NativeMesh, beside_the_checkout, digest, fail, mesh_case, run
from run_case import compare, expected_file, values_of, write_expected

FORMATS = ("mesh", "qmesh", "cgns", "vtu", "msh", "msh41", "su2", "fluent.msh", "ugrid", "medit")
FOLDER = "polyMesh"
UNNAMED = ("ugrid", "medit", "b8.ugrid")


def delaunay_option(case, mesh_type):
    """The cells of layers follow the wall and are not Delaunay."""
    has_layers = any("layers" in boundary for boundary in tomllib.loads(case.read_text()).get("boundary", {}).values())
    return ["--delaunay"] * (mesh_type == "delaunay" and not has_layers)


def check_areas(quadloop, case, prefix, mesh_type):
    """Both judges compare the blocks with the geometry, by name."""
    names = [block["name"] for block in tomllib.loads(case.read_text())["block"]]
    report = json.loads(run([quadloop, "check", f"{prefix}.mesh", "--geometry", f"{prefix}.geom", "--json"]))
    if list(report["block_figures"]) != names or any(not row["geometry_area_error"] < 2e-2 for row in report["block_figures"].values()):
        fail(f"blocks of the report: {report['block_figures']}")
    if report["interface_edges"] == 0 or "unnamed_interface_edges" in report:
        fail(f"{report['interface_edges']} edges between blocks, {report.get('unnamed_interface_edges')} without a name")
    judged = json.loads(run([sys.executable, "-B", JUDGE, f"{prefix}.mesh", "--geometry", f"{prefix}.geom", "--json"]
                            + delaunay_option(case, mesh_type)))
    if list(judged["blocks"]) != names or any(abs(judged["blocks"][name] - row["area"]) > 1e-9 for name, row in report["block_figures"].items()):
        fail(f"areas of blocks: {judged['blocks']}, {report['block_figures']}")


def judge(case, prefix, mesh_type):
    script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    if script is None:
        print("no other judge at hand")
        return
    run([sys.executable, script, f"{prefix}.mesh", *delaunay_option(case, mesh_type)])


def compare_figures(name, wanted, found, size, layers=1, thickness=1.0):
    """Blocks of a file with those of the .mesh, in their order; some formats store numbers for names."""
    if name not in UNNAMED and list(found) != list(wanted):
        fail(f"{name}: blocks {list(found)}, not {list(wanted)}")
    in_order = [found[block] for block in (sorted(found) if name in UNNAMED else found)]
    for row, other in zip(wanted.values(), in_order, strict=True):
        if other["cells"] != layers * row["cells"] or abs(other[size] - thickness * row["area"]) > 1e-9:
            fail(f"{name}: a block has {other}, not {row}")


def check_formats(quadloop, prefix, work):
    """Each file has the blocks of the .mesh, by name where the format stores names, with the same area, and the same edges between them."""
    wanted = json.loads(run([quadloop, "check", f"{prefix}.mesh", "--json"]))
    for name in (*FORMATS, FOLDER):
        file = f"{prefix}.{name}"
        if name == FOLDER:
            file = work / "plane.mesh"
            run([quadloop, "-q", "convert", f"{prefix}.{name}", file])
        found = json.loads(run([quadloop, "check", file, "--json"]))
        compare_figures(name, wanted["block_figures"], found["block_figures"], "area")
        unnamed = wanted["interface_edges"] if name == FOLDER else 0
        if (found["nodes"], found["interface_edges"], found.get("unnamed_interface_edges", 0)) != (wanted["nodes"], wanted["interface_edges"], unnamed):
            fail(f"{name}: {found['nodes']} nodes, {found['interface_edges']} edges between blocks, {found.get('unnamed_interface_edges')} unnamed")
    for name in ("cgns", "su2"):
        run([quadloop, "-q", "convert", f"{prefix}.{name}", work / "back.mesh"])
        if NativeMesh(work / "back.mesh").canonical() != NativeMesh(f"{prefix}.mesh").canonical():
            fail(f"{name} is read as another mesh")
    for block, row in wanted["block_figures"].items():
        run([quadloop, "-q", "convert", f"{prefix}.mesh", work / "zone.su2", "--block", block])
        zone = json.loads(run([quadloop, "check", work / "zone.su2", "--json"]))
        if zone["triangles"] + zone["quads"] != row["cells"] or abs(zone["area"] - row["area"]) > 1e-12 * row["area"]:
            fail(f"the file of block {block}, {row}, holds {zone['area']}")
    judged = json.loads(run([sys.executable, "-B", JUDGE, f"{prefix}.cgns", "--geometry", f"{prefix}.geom", "--json"]))
    if list(judged["blocks"]) != list(wanted["block_figures"]):
        fail(f"zones {judged['blocks']}")
    if shutil.which("cgnscheck"):
        said = run(["cgnscheck", f"{prefix}.cgns"])
        if "ERROR" in said or "WARNING" in said:
            fail(said)


def check_commands(quadloop, prefix, work):
    """Smoothing keeps the blocks, extrusion gives each its volume, and they are drawn."""
    sizes = json.loads(run([quadloop, "check", f"{prefix}.mesh", "--json"]))["block_figures"]
    run([quadloop, "-q", "smooth", f"{prefix}.mesh", "-o", work / "smooth.mesh", "--sweeps", "2"])
    smoothed = json.loads(run([quadloop, "check", work / "smooth.mesh", "--json"]))["block_figures"]
    if {name: row["cells"] for name, row in smoothed.items()} != {name: row["cells"] for name, row in sizes.items()}:
        fail(f"smoothed: {smoothed}, not {sizes}")
    for name in ("cgns", "su2", "vtu", "b8.ugrid", "msh", "fluent.msh", FOLDER):
        run([quadloop, "-q", "extrude", f"{prefix}.mesh", "-o", work / f"solid.{name}", "--layers", "2", "--thickness", "0.5"])
        solid = json.loads(run([quadloop, "check", work / f"solid.{name}", "--json"]))
        compare_figures(name, sizes, solid["block_figures"], "volume", layers=2, thickness=0.5)
    for colouring in ("block", "type"):
        run([quadloop, "-q", "plot", f"{prefix}.mesh", "-o", work / f"{colouring}.svg", "--colour-by", colouring])
    if digest(work / "block.svg") == digest(work / "type.svg"):
        fail("a picture of the blocks is one of the types")


def check_refusals(quadloop, case, work):
    for assignment, part in (("mesh.mirror=\"x\"", "mesh.mirror"), ("adapt.variable=\"density\"", "solver.kind")):
        done = subprocess.run([str(quadloop), "mesh", str(case), "-o", str(work / "refused"), "--set", assignment], capture_output=True,
                              text=True, check=False)
        lines = [line for line in done.stderr.splitlines() if "error" in line]
        if done.returncode != 1 or len(lines) != 1 or part not in lines[0] or "[[block]]" not in lines[0]:
            fail(f"{assignment}: exit status {done.returncode}, {done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--write-expected", action="store_true")
    args = parser.parse_args()
    options = ["--set", "output.formats=[" + ",".join(f'"{name}"' for name in (*FORMATS, FOLDER)) + "]"]
    with tempfile.TemporaryDirectory(prefix="quadloop_blocks_") as folder:
        work = Path(folder)
        for mesh_type in ("hybrid", "delaunay"):
            prefix = work / mesh_type
            for ranks in (1, 2, 3, 5, 8):
                other = prefix if ranks == 1 else work / "other"
                mesh_case(args.quadloop, args.case, other, ranks, [*options, "--type", mesh_type, "--geometry-out", f"{other}.geom"])
                for name in (*FORMATS, "tree.h5", *(f"{FOLDER}/{path.name}" for path in Path(f"{prefix}.{FOLDER}").iterdir())):
                    if digest(f"{other}.{name}") != digest(f"{prefix}.{name}"):
                        fail(f"{name} differs on {ranks} ranks")
            check_formats(args.quadloop, prefix, work)
            check_commands(args.quadloop, prefix, work)
            check_areas(args.quadloop, args.case, prefix, mesh_type)
            judge(args.case, prefix, mesh_type)
            found = values_of(prefix)
            expected = expected_file(args.case, mesh_type)
            if args.write_expected:
                write_expected(expected, found)
            elif expected.exists():
                compare(found, tomllib.loads(expected.read_text()))
        if args.case.parent.name == "fuel_cell" and args.case.stem == "case":
            check_refusals(args.quadloop, args.case, work)
    print("good")


if __name__ == "__main__":
    main()
