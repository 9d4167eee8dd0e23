#!/usr/bin/env python3
"""A geometry that is its own mirror image in y, in a root that is so too, gives a mesh that is, bit for bit; both types.

    run_symmetry.py --quadloop PROGRAM --case CASE.toml [--layers]

--layers  triangles across the axis are left out: layers' cells there are symmetric trapeziums, of which no diagonal is
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import NativeMesh, fail, mesh_case


def beside_axis(cells):
    return [cell for cell in cells if len(cell) == 4 or min(y for _, y in cell) >= 0 or max(y for _, y in cell) <= 0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--layers", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_symmetry_") as folder:
        for mesh_type in ("hybrid", "delaunay"):
            mesh_case(args.quadloop, args.case, Path(folder) / mesh_type, options=["--type", mesh_type, "--set", "smooth.sweeps=0"])
            mesh = NativeMesh(Path(folder) / f"{mesh_type}.mesh")
            image = mesh.mapped(lambda x, y: (x, 0.0 - y), True)
            for what, here, there in zip(("nodes", "cells", "boundaries"), mesh.canonical(), image.canonical()):
                if args.layers and what == "cells":
                    here, there = beside_axis(here), beside_axis(there)
                if here != there:
                    fail(f"{mesh_type}: the {what} are not symmetric, e.g. {sorted(set(here) ^ set(there))[:4]}")
            print(f"{mesh_type}: symmetric")


if __name__ == "__main__":
    main()
