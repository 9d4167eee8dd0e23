#!/usr/bin/env python3
"""Layers that go on along wakes: valid meshes of both types, no jump of areas anywhere, and the same bytes on any number of ranks.

    run_wakes.py --quadloop PROGRAM --case FILE [--ranks N ...]
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

from quadloop_runs import fail, judge_mesh, mesh_case

LARGEST_AREA_RATIO = 10  # over any inner edge, where a fan has hundreds
SMALLEST_ANGLE = 15  # of a hybrid mesh; where strips meet the cells outside


def figures(quadloop, prefix):
    said = subprocess.run([quadloop, "check", f"{prefix}.mesh", "--json"], capture_output=True, text=True, check=True)
    return json.loads(said.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 3, 5])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_wakes_") as folder:
        for mesh_type in ("hybrid", "delaunay"):
            prefix = Path(folder) / mesh_type
            options = ["--type", mesh_type, "--set", 'output.formats=["mesh", "cgns", "vtu"]']
            mesh_case(args.quadloop, args.case, prefix, options=[*options, "--geometry-out", f"{prefix}.geom"])
            judge_mesh(prefix, f"{prefix}.geom", corners=True)
            said = figures(args.quadloop, prefix)
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
