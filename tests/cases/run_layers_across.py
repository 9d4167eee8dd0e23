#!/usr/bin/env python3
"""Layers of walls on both sides of what ends on them: a measuring line from wall to wall and a baffle in a channel, and a channel that runs
from block to block. Valid for `quadloop check` and the judges, the nodes of the line in rows of the layers'
heights, the same bytes on 1, 2, 3, 5 and 8 ranks.

    run_layers_across.py --quadloop PROGRAM [--ranks 1,2,3,5,8]
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

from quadloop_runs import JUDGE, beside_the_checkout, digest, fail, mesh_case, run
from run_lines import check_line, points_and_lines

FIRST, GROWTH, COUNT = 0.004, 1.2, 6
SECTION = [[1.0, 0.0], [1.4, 0.8], [1.4, 1.0]]
PLATE = [[2.0, 0.0], [1.8, 0.4]]

CHANNEL = f"""
[spacing]
min = 0.005
max = 0.1

[boundary.box]
bc = "wall"
spacing = 0.05
layers = {{ first = {FIRST}, growth = {GROWTH}, count = {COUNT} }}

[[shape]]
name = "box"
kind = "rectangle"
box = [0.0, 3.0, 0.0, 1.0]
"""
LINE = f"""
[[line]]
name = "section"
path = {SECTION}
"""
BAFFLE = f"""
[[line]]
name = "plate"
path = {PLATE}
kind = "baffle"
"""
BLOCKS = """
[geometry]
file = "two.geom"

[spacing]
min = 0.005
max = 0.1

[boundary.wall]
bc = "wall"
spacing = 0.05
layers = { first = 0.004, growth = 1.2, count = 6 }

[boundary.screen]
spacing = 0.05

[[block]]
name = "fluid"
inside = [0.5, 0.5]

[[block]]
name = "porous"
inside = [2.0, 0.5]
"""
SCREEN = [[1.2, 0.0], [1.5, 1.0]]
CHAINS = {"wall": [[0, 0], [3, 0]], "outlet": [[3, 0], [3, 1]], "lid": [[3, 1], [0, 1]], "inlet": [[0, 1], [0, 0]], "screen": SCREEN}
CASES = {"line": CHANNEL + LINE, "baffle": CHANNEL + LINE + BAFFLE, "blocks": BLOCKS}


def check_column(points, path):
    """Nodes at the layers' heights, measured along the line from its foot."""
    foot, along = path[0], (path[1][0] - path[0][0], path[1][1] - path[0][1])
    length = math.hypot(*along)
    height, reached = FIRST, 0
    for _ in range(COUNT):
        reached += height / (abs(along[1]) / length)
        height *= GROWTH
        place = tuple(f + reached / length * a for f, a in zip(foot, along))
        if min(math.dist(p, place) for p in points) > 1e-9:
            fail(f"no node at {place}, at the height of a layer")


def check_mesh(quadloop, name, prefix, mesh_type):
    run([quadloop, "check", f"{prefix}.mesh"])
    points, lines = points_and_lines(f"{prefix}.mesh")
    if name != "blocks":
        check_line("section", SECTION, points, lines["section"])
        check_column(points, SECTION)
        check_column(points, SECTION[:0:-1])
    else:
        check_column(points, SCREEN)
    if name == "baffle":
        check_column(points, PLATE)
        doubled = len(points) - len(set(points))
        if doubled < COUNT + 4:
            fail(f"only {doubled} doubled nodes on the baffle")
    else:
        if len(set(points)) != len(points):
            fail("two nodes at one place")
        run([sys.executable, "-B", JUDGE, f"{prefix}.mesh"])
        script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
        if script is not None:
            run([sys.executable, script, f"{prefix}.mesh"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", default="1,2,3,5,8")
    parser.add_argument("--keep", help="folder for the results")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_layers_across_") as folder:
        work = Path(args.keep or folder)
        rows = [f"{name} open\n{len(path)}\n" + "".join(f"{x} {y}\n" for x, y in path) for name, path in CHAINS.items()]
        (work / "two.geom").write_text(f"{len(rows)}\n" + "".join(rows))
        for name, text in CASES.items():
            case = work / f"{name}.toml"
            case.write_text(text)
            for mesh_type in ("hybrid", "delaunay"):
                first = None
                for ranks in map(int, args.ranks.split(",")):
                    prefix = work / f"{name}_{mesh_type}_{ranks}"
                    first = first or prefix
                    mesh_case(args.quadloop, case, prefix, ranks, ["--set", 'output.formats=["mesh"]', "--type", mesh_type])
                    for file in ("mesh", "tree.h5"):
                        if digest(f"{first}.{file}") != digest(f"{prefix}.{file}"):
                            fail(f"{name}, {mesh_type}: {file} differs on {ranks} ranks")
                check_mesh(args.quadloop, name, first, mesh_type)
    print("good")


if __name__ == "__main__":
    main()
