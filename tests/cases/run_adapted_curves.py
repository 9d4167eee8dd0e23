#!/usr/bin/env python3
"""Adapted meshes whose layers end on an arc, an ellipse or a spline: cells at the curve are refined, all its nodes lie on it to 1e-12, the columns
keep their heights, the meshes are valid for the judge, and they have the same bytes on several numbers of ranks.

    run_adapted_curves.py --quadloop PROGRAM [--ranks 1 3]
"""
import argparse
import json
import math
import sys
import tempfile
from pathlib import Path

from quadloop_runs import JUDGE, MPIRUN, NativeMesh, digest, fail, run

# The inlet of a channel from (0, 1) to (0, 0): control points and weights of a rational Bezier curve.
INLETS = {
    "arc": ([(-0.5 * math.tan(0.6), 0.5)], [1, math.cos(0.6), 1]),
    "ellipse": ([(0.3, 0.4)], [1, 0.7, 1]),
    "spline": ([(-0.12, 0.7), (0.1, 0.3)], [1, 1, 1, 1]),
}
CHANNEL = "4\nfloor open\n2\n0 0\n2 0\noutlet open\n2\n2 0\n2 1\ntop open\n2\n2 1\n0 1\ninlet open\n2\n0 1 curve {}\n0 0\n"
CASE = """[geometry]
file = "channel.geom"

[spacing]
max = 0.2
curvature = 8

[boundary.floor]
spacing = 0.06
layers = {{ first = 0.004, growth = 1.2, count = 12 }}

[boundary.top]
spacing = 0.06
layers = {{ first = 0.004, growth = 1.2, count = 12 }}

[adapt]
cycles = 2
variable = "T"
threshold = "fraction"
min = 0.01

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""


def solve(mesh, solution):
    """A front across the layers that touches the curve at both walls."""
    text = Path(mesh).read_text().split("#Number of constants")[0].rstrip("\n") + "\n"
    values = "".join(f"{math.tanh(20 * (x + 0.3 * y * (1 - y) - 0.08))!r}\n" for x, y in NativeMesh(mesh).nodes)
    Path(solution).write_text(text + "#Number of constants\n0\n#Number of variables\n1\n#names: T\n" + values)


def on_curve(poles, weights, y):
    """x of the curve at y, which decreases along it."""
    def point(t):
        rows = [(w * px, w * py, w) for (px, py), w in zip(poles, weights)]
        while len(rows) > 1:
            rows = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(rows, rows[1:])]
        return rows[0][0] / rows[0][2], rows[0][1] / rows[0][2]
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if point(middle)[1] > y else (low, middle)
    return point(low)[0]


def check_mesh(quadloop, path, geometry, poles, weights):
    """The number of edges of the inlet outside the layers."""
    run([sys.executable, "-B", JUDGE, path, "--geometry", geometry, "--corners"])
    mesh = NativeMesh(path)
    nodes = [mesh.nodes[n] for n in sorted({*sum(mesh.boundaries["inlet"], ())})]
    off, x, y = max((abs(on_curve(poles, weights, y) - x), x, y) for x, y in nodes)
    if off > 1e-12:
        fail(f"{path}: the node at ({x}, {y}) is {off} off the curve")
    for row in json.loads(run([quadloop, "check", path, "--json"]))["layers"]:
        if row["count"] != 12 or max(abs(first - 0.004) for first in row["first"]) > 2e-5:
            fail(f"{path}: layers {row}")
    return len(mesh.boundaries["inlet"]) - 24


def adapt(quadloop, case, ranks, out):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
    run([*launcher, quadloop, "adapt", case, "-o", out])
    return [digest(out / f"cycle_0{cycle}" / f"mesh.{suffix}") for cycle in range(3) for suffix in ("mesh", "tree.h5")]


def main():
    if sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 3])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapted_curves_") as name:
        work = Path(name)
        for (inlet, (control, weights)), mesh_type in zip(list(INLETS.items()) * 2, ["hybrid", "delaunay"] * 3):
            geometry, case = work / "channel.geom", work / "case.toml"
            geometry.write_text(CHANNEL.format(" ".join(map(repr, sum(control, ()))) + " weights " + " ".join(map(repr, weights))))
            case.write_text(f'[mesh]\ntype = "{mesh_type}"\n\n' + CASE.format(python=sys.executable, script=Path(__file__).resolve()))
            outs = {ranks: work / f"{inlet}_{mesh_type}_{ranks}" for ranks in args.ranks}
            found = {ranks: adapt(args.quadloop, case, ranks, out) for ranks, out in outs.items()}
            if any(digests != found[args.ranks[0]] for digests in found.values()):
                fail(f"{inlet}, {mesh_type}: the meshes differ between the numbers of ranks")
            edges = [check_mesh(args.quadloop, outs[args.ranks[0]] / f"cycle_0{cycle}" / "mesh.mesh", geometry, [(0, 1), *control, (0, 0)], weights)
                     for cycle in range(3)]
            if not edges[0] < edges[1] < edges[2]:
                fail(f"{inlet}, {mesh_type}: the inlet has {edges} edges outside the layers; it is not refined")
    print("good")
    return None


if __name__ == "__main__":
    sys.exit(main())
