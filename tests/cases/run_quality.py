#!/usr/bin/env python3
"""Shapes of cells, before any smoothing and after it, on the case's own root and on others that shift the lattice. Corners that the outline
itself makes sharp are not counted.

    run_quality.py --quadloop PROGRAM --case CASE.toml (--cut SMALLEST LARGEST --smoothed SMALLEST LARGEST [--quads SHARE] | --fractal)
                   [--type delaunay] [--offsets 8] [--borrow FILE.geom]

Angles in degrees, of the mesh as it is cut and of the smoothed one; smoothing may make neither the smallest angle nor the mean quality worse.
--fractal  for a coast, where no angle can be promised: of a thousand corners at most one below 15 degrees as cut, below 25 smoothed
"""
import argparse
import json
import shutil
import tempfile
from pathlib import Path

from outline import read_outline
from quadloop_runs import beside_the_checkout, fail, mesh_case, run, skip

PARALLELOGRAMS, QUADS, QUADS_WHERE_PARALLEL = 0.85, 0.65, 0.64  # shares: smoothed; of the cells; of the cells with mesh.quads = "parallel"
BELOW_26, LARGEST_RATIO, USUAL_RATIO = 0.01, 50, 4.5  # share of corners; area ratio of neighbours: any, 99 percent
LARGEST_RATIO_SMOOTHED = 10
MOST_OF_A_COAST = 0.001
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


def shortfalls_of(limits):
    return [f"{what} is {value:.4g}, not {sign} {bound}" for what, value, sign, bound in limits
            if not (value >= bound if sign == ">=" else value <= bound)]


def angle_limits(said, bounds, what):
    return [(f"smallest angle {what}", said["min_angle_made"], ">=", bounds[0]), (f"largest angle {what}", said["max_angle_made"], "<=", bounds[1])]


def fractal_limits(cut, smoothed):
    share = lambda said, degrees: said[f"corners_below_{degrees}"] / said["corners"]
    return [("share of corners below 15 degrees", share(cut, 15), "<=", MOST_OF_A_COAST), ("share below 26", share(cut, 26), "<=", BELOW_26),
            ("share of corners below 25 degrees, smoothed", share(smoothed, 25), "<=", MOST_OF_A_COAST),
            ("mean quality, smoothed", smoothed["mean_quality"], ">=", cut["mean_quality"])]


def cut_limits(said, args):
    return angle_limits(said, args.cut, "as cut") + [
        ("share of quads", said["quad_share"], ">=", args.quads),
        ("share of corners below 26 degrees", said["corners_below_26"] / said["corners"], "<=", BELOW_26),
        ("largest area ratio of neighbours", said["area_ratio_max"], "<=", LARGEST_RATIO),
        ("99 % of the area ratios", said["area_ratio_p99"], "<=", USUAL_RATIO)]


def smoothed_limits(said, before, args):
    return angle_limits(said, args.smoothed, "smoothed") + [
        ("largest area ratio of neighbours, smoothed", said["area_ratio_max"], "<=", LARGEST_RATIO_SMOOTHED),
        ("smallest angle of all, smoothed", said["min_angle"], ">=", before["min_angle"] * (1 - 1e-9)),
        ("mean quality, smoothed", said["mean_quality"], ">=", before["mean_quality"])]


def parallel_limits(smoothed, split):
    return [("share of parallelograms", smoothed["parallelogram_share"], ">=", PARALLELOGRAMS),
            ("share of quads, smoothed", smoothed["quad_share"], ">=", QUADS),
            ("share of parallelograms where the others are divided", split["parallelogram_share"], ">=", 1),
            ("share of quads there", split["quad_share"], ">=", QUADS_WHERE_PARALLEL),
            ("share of inexact nodes there", split["inexact_node_share"], "<=", smoothed["inexact_node_share"] / 2)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--cut", type=float, nargs=2)
    parser.add_argument("--smoothed", type=float, nargs=2)
    parser.add_argument("--fractal", action="store_true")
    parser.add_argument("--quads", type=float, default=0)
    parser.add_argument("--parallel", action="store_true", help="few smoothed quads are skew, and with mesh.quads = \"parallel\" none")
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--offsets", type=int, default=8)
    parser.add_argument("--borrow")
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
            cut, smoothed = shapes_of(args.quadloop, case, prefix, here + UNSMOOTHED), shapes_of(args.quadloop, case, prefix, here)
            for said in (cut, smoothed):
                print(root, {key: said[key] for key in ("min_angle_made", "max_angle_made", "corners_of_outline", "area_ratio_max", "quad_share")})
            limits = fractal_limits(cut, smoothed) if args.fractal else cut_limits(cut, args) + smoothed_limits(smoothed, cut, args)
            if args.parallel:
                split = shapes_of(args.quadloop, case, prefix, here + ["--set", 'mesh.quads="parallel"'])
                limits += parallel_limits(smoothed, split)
            found = shortfalls_of(limits)
            if found:
                fail(f"root {root}: {'; '.join(found)}")
    print("good")


if __name__ == "__main__":
    main()
