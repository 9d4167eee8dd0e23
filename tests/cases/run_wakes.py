#!/usr/bin/env python3
"""Layers that go on along wakes: valid meshes of both types, the hybrid one with the case's expected values, no jump of areas anywhere, and the
same bytes on any number of ranks. Files know the wake by its name: `check` measures it, `convert` and `smooth` keep it.

    run_wakes.py --quadloop PROGRAM --case FILE [--ranks N ...]
"""
import argparse
import json
import subprocess
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import MPIRUN, NativeMesh, fail, judge_mesh, mesh_case, run
from run_case import compare, expected_file, values_of

LARGEST_AREA_RATIO = 10  # over any inner edge, where a fan has hundreds
SMALLEST_ANGLE = 15  # of a hybrid mesh; where strips meet the cells outside


def figures(quadloop, mesh):
    said = subprocess.run([quadloop, "check", mesh, "--json"], capture_output=True, text=True, check=True)
    return json.loads(said.stdout)


def rows_of(said):
    return {row["boundary"]: row for row in said["layers"]}


def check_rows(said):
    """The wall's columns and the wake's apart, both as the case asks for them: 30 layers from 1e-5 on, growing by 1.2."""
    rows = rows_of(said)
    if set(rows) != {"airfoil", "wake"}:
        fail(f"layers of {sorted(rows)}, not of airfoil and wake")
    for name, row in rows.items():
        if row["count"] != 30 or abs(row["thickness"][0] / row["thickness_asked"] - 1) > 0.01:
            fail(f"{name}: {row}")
        if abs(row["first"][0] / 1e-5 - 1) > 0.01 or row["growth"][0] < 0.99 or row["growth"][2] > 1.21:
            fail(f"{name}: {row}")
    wall = rows["airfoil"]
    if wall["thickness"][2] > 1.05 * wall["thickness_asked"] or wall["growth"][0] < 1.19:
        fail(f"columns of the wake, or rows behind its edge, are taken for the wall's: {wall}")


def strip_nodes(mesh):
    """The places of the nodes that the comments of a .mesh file list, in their order."""
    points, places = NativeMesh(mesh).nodes, []
    for line in Path(mesh).read_text().splitlines():
        for word in line.split()[2:] if line.startswith("# nodes ") else []:
            first, _, last = word.partition("-")
            first, last = int(first), int(last or first)
            step = 1 if first <= last else -1
            places += [points[number - 1] for number in range(first, last + step, step)]
    return places


def check_files(quadloop, prefix, folder, ranks):
    """Through other formats, and smoothed on one rank and several."""
    of_mesh = figures(quadloop, f"{prefix}.mesh")
    for suffix in ("cgns", "vtu"):
        back = Path(folder) / f"from_{suffix}.mesh"
        run([quadloop, "convert", f"{prefix}.{suffix}", back])
        if back.read_bytes() != Path(f"{prefix}.mesh").read_bytes():
            fail(f"from .{suffix}: another mesh")
    smoothed = Path(folder) / "smoothed.mesh"
    run([quadloop, "smooth", f"{prefix}.mesh", "-o", smoothed, "--sweeps", "5"])
    if strip_nodes(smoothed) != strip_nodes(f"{prefix}.mesh") or len(strip_nodes(smoothed)) < 61 * 50:
        fail("smooth has moved nodes of the wake, or lost it")
    after = figures(quadloop, smoothed)
    if rows_of(after) != rows_of(of_mesh) or after["layer_cells"] != of_mesh["layer_cells"]:
        fail("layers are others after smoothing")
    for count in ranks:
        again = Path(folder) / f"smoothed_{count}.mesh"
        run([MPIRUN, "-n", str(count), quadloop, "smooth", f"{prefix}.mesh", "-o", again, "--sweeps", "5"])
        if again.read_bytes() != smoothed.read_bytes():
            fail(f"smoothed on {count} ranks: another mesh")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 3, 5])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_wakes_") as folder:
        for mesh_type in ("hybrid", "delaunay"):
            prefix = Path(folder) / mesh_type
            options = ["--type", mesh_type, "--set", 'output.formats=["mesh", "cgns", "vtu"]']
            mesh_case(args.quadloop, args.case, prefix, options=[*options, "--geometry-out", f"{prefix}.geom"])
            judge_mesh(prefix, f"{prefix}.geom", corners=True)
            if mesh_type == "hybrid":
                compare(values_of(prefix), tomllib.loads(expected_file(args.case, mesh_type).read_text()))
            said = figures(args.quadloop, f"{prefix}.mesh")
            check_rows(said)
            check_files(args.quadloop, prefix, folder, args.ranks)
            if said["area_ratio_max"] > LARGEST_AREA_RATIO:
                fail(f"{mesh_type}: areas jump by {said['area_ratio_max']:.4g}, not at most {LARGEST_AREA_RATIO}")
            if mesh_type == "hybrid" and said["min_angle"] < SMALLEST_ANGLE:
                fail(f"{mesh_type}: an angle of {said['min_angle']:.4g}, not at least {SMALLEST_ANGLE}")
            for ranks in args.ranks:
                again = Path(folder) / f"on_{ranks}"
                mesh_case(args.quadloop, args.case, again, ranks, options)
                for suffix in ("mesh", "vtu", "tree.h5"):
                    if Path(f"{again}.{suffix}").read_bytes() != Path(f"{prefix}.{suffix}").read_bytes():
                        fail(f"{mesh_type} on {ranks} ranks: another .{suffix}")
            print(mesh_type, f"area ratio {said['area_ratio_max']:.4g}, smallest angle {said['min_angle']:.4g}")
    print("good")


if __name__ == "__main__":
    main()
