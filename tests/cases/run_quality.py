#!/usr/bin/env python3
"""Shapes of cells, before any smoothing or after it, on the case's own root and on others that shift the lattice. Corners that the outline
itself makes sharp are not counted.

    run_quality.py --quadloop PROGRAM --case CASE.toml --smallest DEG --largest DEG [--quads SHARE] [--type delaunay] [--offsets 8]
                   [--borrow FILE.geom] [--smoothed]

--smoothed  judges the mesh after smoothing, and that smoothing made neither the worst cell nor the smallest angle worse
"""
import argparse
import json
import shutil
import tempfile
from pathlib import Path

from outline import read_outline
from quadloop_runs import beside_the_checkout, fail, mesh_case, run, skip

BELOW_26, LARGEST_RATIO, USUAL_RATIO = 0.01, 50, 4.5  # share of corners; area ratio of neighbours: any, 99 percent
LARGEST_RATIO_SMOOTHED = 10
UNSMOOTHED = ["--set", "smooth.sweeps=0"]


def roots(geometry, count):
    """The case's own, then larger ones, the outline somewhere inside."""
    points = [p for entry in read_outline(geometry) for p in entry.points]
    low = [min(p[k] for p in points) for k in (0, 1)]
    extent = max(max(p[k] for p in points) - low[k] for k in (0, 1))
    yield None
    for k in range(1, count):
        shift = [0.09 * (k * step % 1) + 0.005 for step in (0.3819660113, 0.8034)]
        yield [low[0] - shift[0] * extent, low[1] - shift[1] * extent, 1.1 * extent, 1, 1]


def shapes_of(quadloop, case, prefix, options):
    mesh_case(quadloop, case, prefix, options=["--geometry-out", f"{prefix}.geom", "--set", 'output.formats=["mesh"]', *options])
    return json.loads(run([quadloop, "check", f"{prefix}.mesh", "--geometry", f"{prefix}.geom", "--json"]))


def shortfalls(said, args, before):
    """`before` is the unsmoothed mesh where the smoothed one is judged."""
    limits = [("smallest angle", said["min_angle_made"], ">=", args.smallest), ("largest angle", said["max_angle_made"], "<=", args.largest),
              ("share of quads", said["quad_share"], ">=", args.quads)]
    if before:
        limits += [("largest area ratio of neighbours", said["area_ratio_max"], "<=", LARGEST_RATIO_SMOOTHED),
                   ("smallest angle of all", said["min_angle"], ">=", before["min_angle"] * (1 - 1e-9)),
                   ("mean quality", said["mean_quality"], ">=", before["mean_quality"])]
    else:
        limits += [("share of corners below 26 degrees", said["corners_below_26"] / said["corners"], "<=", BELOW_26),
                   ("largest area ratio of neighbours", said["area_ratio_max"], "<=", LARGEST_RATIO),
                   ("99 % of the area ratios", said["area_ratio_p99"], "<=", USUAL_RATIO)]
    return [f"{what} is {value:.4g}, not {sign} {bound}" for what, value, sign, bound in limits
            if not (value >= bound if sign == ">=" else value <= bound)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--smallest", type=float, required=True)
    parser.add_argument("--largest", type=float, required=True)
    parser.add_argument("--quads", type=float, default=0)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--offsets", type=int, default=8)
    parser.add_argument("--borrow")
    parser.add_argument("--smoothed", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_quality_") as folder:
        case, prefix = args.case, Path(folder) / "out"
        if args.borrow:
            source = beside_the_checkout("QUADLOOP_BORROWED_DATA", "data")
            if source is None or not (source / args.borrow).exists():
                skip(f"{args.borrow} is not part of the project and not at hand")
            shutil.copy(source / args.borrow, folder)
            case = Path(shutil.copy(case, folder))
        options = ["--type", args.type]
        shapes_of(args.quadloop, case, prefix, options)
        for root in list(roots(f"{prefix}.geom", args.offsets)):
            here = options + (["--set", f"mesh.root={root}"] if root else [])
            unsmoothed = shapes_of(args.quadloop, case, prefix, here + UNSMOOTHED)
            said = shapes_of(args.quadloop, case, prefix, here) if args.smoothed else unsmoothed
            print(root, {key: said[key] for key in ("min_angle_made", "max_angle_made", "corners_of_outline", "area_ratio_max", "quad_share")})
            found = shortfalls(said, args, unsmoothed if args.smoothed else None)
            if found:
                fail(f"root {root}: {'; '.join(found)}")
    print("good")


if __name__ == "__main__":
    main()
