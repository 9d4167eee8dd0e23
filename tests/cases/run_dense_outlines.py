#!/usr/bin/env python3
"""NACA airfoils as files with more and more points, cosine-spaced and with nine decimals, meshed with layers and a wake: the layers have the
requested thickness whatever the number of points is.

    run_dense_outlines.py --quadloop PROGRAM
"""
import argparse
import json
import math
import tempfile
from pathlib import Path

from quadloop_runs import fail, judge_mesh, mesh_case, run

LEAST_SHARE = 0.95  # of the requested thickness
POINTS = (100, 200, 400, 800)  # per side
CASE = """[geometry]
file = "airfoil.dat"
far_field = 20.0
[spacing]
min = 0.0005
max = 1.0
curvature = 10
[flow]
reynolds = 3e6
[boundary.airfoil]
spacing = 0.005
corner = 30
bc = "wall"
layers = { first = "yplus:1", growth = 1.2, count = 37 }
[boundary.farfield]
bc = "farfield"
[[wake]]
from = "airfoil"
length = 3.0
spacing = 0.03
[output]
formats = ["mesh", "cgns"]
"""


def side(code, x, sign, closed):
    camber, at, thickness = int(code[0]) / 100, int(code[1]) / 10, int(code[2:]) / 100
    half = 5 * thickness * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - (0.1036 if closed else 0.1015) * x**4)
    if camber == 0:
        return x, sign * half
    ahead = x < at
    factor = camber / (at if ahead else 1 - at)**2
    mean = factor * ((0 if ahead else 1 - 2 * at) + 2 * at * x - x**2)
    turn = math.atan(2 * factor * (at - x))
    return x - sign * half * math.sin(turn), mean + sign * half * math.cos(turn)


def write_airfoil(path, code, points, closed):
    places = [0.5 * (1 - math.cos(math.pi * i / (points - 1))) for i in range(points)]
    outline = [side(code, x, 1, closed) for x in reversed(places)] + [side(code, x, -1, closed) for x in places[1:]]
    path.write_text(f"NACA {code}\n" + "".join(f"{x:.9f} {y:.9f}\n" for x, y in outline))


def check(quadloop, folder, code, points, closed):
    what = f"NACA {code}, {points} points per side, {'closed' if closed else 'blunt'}"
    write_airfoil(folder / "airfoil.dat", code, points, closed)
    prefix = folder / "airfoil"
    mesh_case(quadloop, folder / "case.toml", prefix)
    judge_mesh(prefix)
    rows = {row["boundary"]: row for row in json.loads(run([quadloop, "check", f"{prefix}.mesh", "--json"]))["layers"]}
    for name in ("airfoil", "wake"):
        share = rows[name]["thickness"][0] / rows[name]["thickness_asked"]
        print(f"{what}: {name} {share:.4g}")
        if share < LEAST_SHARE:
            fail(f"{what}: the layers of {name} have {share:.3g} of the requested thickness, not at least {LEAST_SHARE}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_dense_outlines_") as name:
        folder = Path(name)
        (folder / "case.toml").write_text(CASE)
        for code, closed in (("0012", True), ("2412", True), ("4406", True), ("2412", False)):
            for points in POINTS:
                check(args.quadloop, folder, code, points, closed)
    print("good")


if __name__ == "__main__":
    main()
