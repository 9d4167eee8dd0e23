#!/usr/bin/env python3
"""Inner lines, two of which cross, and a baffle beside a body with boundary layers, and on it: valid, the lines followed, the layers thinner where a
line is near, no refinement where the lines meet, the same bytes on several numbers of ranks. A line at a flat angle to the body is refused.

    run_lines_in_layers.py --quadloop PROGRAM [--ranks 1,2,3]
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from quadloop_runs import digest, fail, mesh_case, run
from run_lines import check_line, points_and_lines

SECTION = [[2, 2], [1.5, 0.2], [1.0, -1.0]]
ACROSS = [[1.1, 1.2], [2.3, 0.85]]
NEAR = [[0.1, 0.6], [0.6, 0.65]]

CASE = """
[[shape]]
name = "far"
kind = "rectangle"
box = [-2, 3, -2, 2]

[[shape]]
name = "body"
kind = "circle"
centre = [0, 0]
radius = 0.5

[[line]]
name = "section"
path = {section}

[[line]]
name = "across"
path = {across}

[[line]]
name = "near"
path = {near}

[[line]]
name = "plate"
path = [[-1.5, -0.63], [0.7, -0.6]]
kind = "baffle"

[spacing]
max = 0.5

[boundary.body]
bc = "wall"
spacing = 0.1
layers = {{ first = 0.004, growth = 1.25, count = 8 }}

[boundary."plate*"]
bc = "wall"
spacing = 0.1
"""


def layer_comments(path):
    return [line for line in Path(path).read_text().splitlines() if line.startswith("# layers body 8")]


def check_mesh(prefix, quadloop):
    run([quadloop, "check", f"{prefix}.mesh"])
    points, lines = points_and_lines(f"{prefix}.mesh")
    for name, path in (("section", SECTION), ("across", ACROSS), ("near", NEAR)):
        check_line(name, path, points, lines[name])
    if not layer_comments(f"{prefix}.mesh"):
        fail(f"{prefix}.mesh has no layers on the body")
    doubled = len(points) - len(set(points))
    if doubled < 10:
        fail(f"{prefix}.mesh has only {doubled} doubled nodes on the baffle")


def check_sizes(quadloop, case, work):
    """The layers do not ask for smaller cells where lines cross."""
    said = json.loads(run([quadloop, "mesh", case, "-o", work / "sizes", "--json"]))
    if "trials" in json.dumps(said):
        fail(f"the mesh is made several times for the columns of layers: {said}")


def check_refusal(quadloop, case, work):
    text = case.read_text().replace(str(NEAR), "[[0, 0.5], [0.6, 0.7]]")
    bad = work / "bad.toml"
    bad.write_text(text)
    done = subprocess.run([quadloop, "mesh", str(bad), "-o", str(work / "bad")], capture_output=True, text=True)
    if done.returncode == 0 or not all(part in done.stderr for part in ("bad.toml:", "'near'", "boundary body", "0.5)", "45 to 135 degrees")):
        fail(f"a line on a wall with layers: {done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", default="1,2,3")
    parser.add_argument("--keep", help="folder for the results")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_lines_in_layers_") as name:
        work = Path(args.keep or name)
        case = work / "case.toml"
        case.write_text(CASE.format(section=SECTION, across=ACROSS, near=NEAR))
        for mesh_type in ("hybrid", "delaunay"):
            first = None
            for ranks in map(int, args.ranks.split(",")):
                prefix = work / f"{mesh_type}_{ranks}"
                first = first or prefix
                mesh_case(args.quadloop, case, prefix, ranks, ["--set", 'output.formats=["mesh"]', "--type", mesh_type])
                for file in ("mesh", "tree.h5"):
                    if digest(f"{first}.{file}") != digest(f"{prefix}.{file}"):
                        fail(f"{mesh_type}: {file} differs on {ranks} ranks")
            check_mesh(first, args.quadloop)
        check_sizes(args.quadloop, case, work)
        check_refusal(args.quadloop, case, work)
    print("good")
    return None


if __name__ == "__main__":
    sys.exit(main())
