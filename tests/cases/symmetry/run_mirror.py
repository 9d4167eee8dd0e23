#!/usr/bin/env python3
"""mesh.mirror: smoothed meshes of both types are their own mirror images, bit for bit, on several numbers of ranks; outlines and
sizes that are none are refused; with --adapt cycles keep it, and the built-in solver finds no lift at zero incidence.

    run_mirror.py --quadloop PROGRAM --case CASE.toml [--axis x|y] [--ranks 1 3] [--set KEY=VALUE ...]
    run_mirror.py --quadloop PROGRAM --case CASE.toml --refusals
    run_mirror.py --quadloop PROGRAM --case CASE.toml --adapt [--mach 0.8 0.5] [--cycles 3] [--ranks 1]
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from quadloop_runs import MPIRUN, NativeMesh, digest, fail, judge_mesh, mesh_case, run

LARGEST_LIFT = 1e-10
TYPES = ("hybrid", "delaunay")
MIRRORS = {"x": lambda x, y: (x, 0.0 - y), "y": lambda x, y: (0.0 - x, y)}


def require_image(path, axis, what):
    mesh = NativeMesh(path)
    image = mesh.mapped(MIRRORS[axis], True)
    for part, here, there in zip(("nodes", "cells", "boundaries"), mesh.canonical(), image.canonical()):
        if here != there:
            fail(f"{what}: the {part} are not symmetric, e.g. {sorted(set(here) ^ set(there))[:4]}")
    print(f"{what}: {len(mesh.nodes)} nodes, each with its image")


def mesh_both_types(args, folder):
    for mesh_type in TYPES:
        first = None
        for ranks in args.ranks:
            prefix = folder / f"{mesh_type}_{ranks}"
            mesh_case(args.quadloop, args.case, prefix, ranks, ["--type", mesh_type, "--set", f'mesh.mirror="{args.axis}"', *args.set])
            found = [digest(f"{prefix}{suffix}") for suffix in (".mesh", ".tree.h5")]
            first = first or found
            if found != first:
                fail(f"{mesh_type}: the files of {ranks} ranks are others than those of {args.ranks[0]}")
        prefix = folder / f"{mesh_type}_{args.ranks[0]}"
        require_image(f"{prefix}.mesh", args.axis, mesh_type)
        judge_mesh(prefix)


def require_refusal(args, folder, words, *settings):
    command = [args.quadloop, "mesh", args.case, "-o", folder / "none", "--set", 'mesh.mirror="x"', *settings]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode == 0 or not all(word in done.stderr for word in words):
        fail(f"{settings} is not refused with {words}: status {done.returncode}, {done.stderr}")
    print("refused:", done.stderr.strip().splitlines()[-1])


def refusals(args, folder):
    require_refusal(args, folder, ["has no mirror image", "the point ("], "geometry.rotate=-1")
    require_refusal(args, folder, ["has no mirror image", "geometry.translate"], "geometry.translate=[0, 0.25]")
    require_refusal(args, folder, ["the node at (", "[[source]]"], "source=[{disc=[0.5, 1.0, 0.5], spacing=0.02}]")
    require_refusal(args, folder, ["mirror", "'z'"], 'mesh.mirror="z"')


def adapt(args, folder):
    for mesh_type in TYPES:
        for mach in args.mach:
            first = None
            for ranks in args.ranks:
                out = folder / f"{mesh_type}_{mach}_{ranks}"
                launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
                settings = [f'mesh.mirror="{args.axis}"', f'mesh.type="{mesh_type}"', f"solver.mach={mach}", "solver.alpha=0",
                            "solver.tolerance=1e-12", f"adapt.cycles={args.cycles}"]
                run([*launcher, args.quadloop, "adapt", args.case, "-o", out, "--set", *settings])
                cycles = sorted(out.glob("cycle_*"))
                found = [digest(cycle / "mesh.mesh") for cycle in cycles]
                first = first or found
                if found != first:
                    fail(f"{mesh_type}: the cycles of {ranks} ranks are others than those of {args.ranks[0]}")
            for cycle in cycles:
                record = json.loads((cycle / "record.json").read_text())
                what = f"{mesh_type}, Mach {mach}, {cycle.name}, cl {record['cl']:.1e}"
                require_image(cycle / "mesh.mesh", args.axis, what)
                if not abs(record["cl"]) < LARGEST_LIFT:
                    fail(f"{what}: lift above {LARGEST_LIFT} at zero incidence")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--axis", choices=MIRRORS, default="x")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    parser.add_argument("--set", nargs="+", default=[], help="more settings of the case")
    parser.add_argument("--refusals", action="store_true")
    parser.add_argument("--adapt", action="store_true")
    parser.add_argument("--mach", type=float, nargs="+", default=[0.8, 0.5])
    parser.add_argument("--cycles", type=int, default=2)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_mirror_") as folder:
        work = refusals if args.refusals else adapt if args.adapt else mesh_both_types
        work(args, Path(folder))


if __name__ == "__main__":
    main()
