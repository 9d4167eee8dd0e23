#!/usr/bin/env python3
"""One case from end to end: mesh it, let `quadloop check`, the tests' own judge (tests/judge) and, where they are at hand, another judge and
cgnscheck look at what came out, and compare with the case's expected values (expected.toml: nodes, triangles, quads, boundaries, area, digest).

    run_case.py --quadloop PROGRAM --case CASE.toml [--type delaunay] [--keeps-corners] [--ranks N] [--borrow FILE.geom] [--write-expected]

--borrow   the geometry is not the project's to ship: it is taken from outside, or the test is skipped
"""
import argparse
import json
import math
import shutil
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import JUDGE, NativeMesh, beside_the_checkout, digest, fail, judge_mesh, mesh_case, run, skip

AREA_TOLERANCE = 1e-12  # relative; the areas are sums of the same doubles, added up in the order of the file


def borrowed_case(case, geometry_name, work):
    source = beside_the_checkout("QUADLOOP_BORROWED_DATA", "data")
    if source is None or not (source / geometry_name).exists():
        skip(f"{geometry_name} is not part of the project and not at hand")
    shutil.copy(source / geometry_name, work)
    return Path(shutil.copy(case, work))


def without_curves(geometry):
    """The outline with points in place of its curves: the other judge knows polygons only."""
    sys.path.append(str(Path(JUDGE).parent))
    from mesh_files import read_geometry
    chains = [(name, *chain) for name, all_of_name in read_geometry(geometry).items() for chain in all_of_name]
    rows = [str(len(chains))]
    for name, closed, points in chains:
        rows += [name if closed else f"{name} open", str(len(points)), *(f"{x!r} {y!r}" for x, y in points.tolist())]
    polygons = geometry.with_suffix(".polygons.geom")
    polygons.write_text("\n".join(rows) + "\n")
    return polygons


def another_judge(prefix, geometry, keeps_corners, mesh_type):
    script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
    if script is None:
        print("no other judge at hand")
        return
    geometry = Path(geometry)
    if " curve " in geometry.read_text():
        geometry = without_curves(geometry)
    kind = ["--delaunay"] if mesh_type == "delaunay" else []
    said = json.loads(run([sys.executable, script, f"{prefix}.mesh", "--geometry", geometry, "--json", *kind], accept=(0, 1)))
    print({key: said[key] for key in sorted(said) if key not in ("valid", "broken")})
    if not said["valid"]:
        fail(f"the other judge: {said['broken']}")
    if said["boundaries_dropped"] != 0:
        fail(f"{said['boundaries_dropped']} boundaries dropped")
    if keeps_corners and said["sharp_corners_lost"] != 0:
        fail(f"{said['sharp_corners_lost']} sharp corners lost")
    run([sys.executable, script, f"{prefix}.mesh", "--same", f"{prefix}.cgns"])


def check_cgns(prefix):
    program = shutil.which("cgnscheck")
    if program is None:
        print("no cgnscheck at hand")
        return
    said = run([program, f"{prefix}.cgns"])
    if "ERROR" in said:
        fail(f"cgnscheck: {said}")


def values_of(prefix):
    mesh = NativeMesh(f"{prefix}.mesh")
    return {"nodes": len(mesh.nodes), "triangles": mesh.triangles(), "quads": mesh.quads(), "boundaries": len(mesh.boundaries),
            "area": mesh.area(), "digest": digest(f"{prefix}.mesh")}


def expected_file(case, mesh_type):
    """case.toml has its values in expected.toml, medium.toml in expected_medium.toml; those of the Delaunay mesh end with _delaunay."""
    stem = "expected" if case.stem == "case" else f"expected_{case.stem}"
    return case.with_name(f"{stem}{'' if mesh_type == 'hybrid' else '_delaunay'}.toml")


def compare(found, expected):
    for key, value in expected.items():
        same = math.isclose(found[key], value, rel_tol=AREA_TOLERANCE) if key == "area" else found[key] == value
        if not same:
            fail(f"{key} is {found[key]}, expected {value}")


def write_expected(path, found):
    rows = [f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value!r}" for key, value in found.items()]
    path.write_text("# Expected results on any number of ranks; digest: SHA-256 of the .mesh file.\n" + "\n".join(rows) + "\n")
    print(f"wrote {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--keeps-corners", action="store_true")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--borrow")
    parser.add_argument("--write-expected", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_case_") as folder:
        work = Path(folder)
        case = borrowed_case(args.case, args.borrow, work) if args.borrow else args.case
        prefix, geometry = work / "out", work / "as_meshed.geom"
        mesh_case(args.quadloop, case, prefix, args.ranks, ["--geometry-out", geometry, "--type", args.type])
        run([args.quadloop, "check", f"{prefix}.mesh", "--geometry", geometry])
        judge_mesh(prefix, geometry, args.keeps_corners, args.type == "delaunay")
        another_judge(prefix, geometry, args.keeps_corners, args.type)
        check_cgns(prefix)
        found = values_of(prefix)
    expected = expected_file(args.case, args.type)
    if args.write_expected:
        write_expected(expected, found)
    elif expected.exists():
        compare(found, tomllib.loads(expected.read_text()))
    print("good")


if __name__ == "__main__":
    main()
