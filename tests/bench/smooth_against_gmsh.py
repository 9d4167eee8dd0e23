#!/usr/bin/env python3
"""Smoothing against Gmsh's Relocate2D on the same mesh file: NACA 0012, triangles alone, about as many nodes as asked for. Gmsh is told that the
surface is a plane, as it would otherwise lose the positions. Nothing is compared where gmsh is not installed.

    smooth_against_gmsh.py --quadloop PROGRAM [--finer 4] [--update docs/performance.md]

--update  puts the figures into the file, between this script's two markers
--finer   divides every spacing of the case cases/naca0012 (4: a million nodes, some two minutes)
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from figures import add_update, tell

CASE = Path(__file__).resolve().parents[2] / "cases" / "naca0012" / "case.toml"

PLANE = """Point(90000001) = {-1e3, -1e3, 0}; Point(90000002) = {1e3, -1e3, 0}; Point(90000003) = {1e3, 1e3, 0}; Point(90000004) = {-1e3, 1e3, 0};
Line(9001) = {90000001, 90000002}; Line(9002) = {90000002, 90000003}; Line(9003) = {90000003, 90000004}; Line(9004) = {90000004, 90000001};
Curve Loop(1) = {9001, 9002, 9003, 9004};
Plane Surface(3) = {1};
Merge "given.msh";
OptimizeMesh "Relocate2D";
Mesh.MshFileVersion = 2.2;
Mesh.SaveAll = 1;
Save "gmsh.msh";
"""


def run(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def shape(quadloop, path, folder):
    done = subprocess.run([str(quadloop), "check", path, "--json"], cwd=folder, capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def row(name, seconds, found):
    return f"| {name} | {seconds} | {found['worst_quality']:.3f} | {found['mean_quality']:.4f} | {found['min_angle']:.1f} | {found['max_angle']:.1f} | {found['valid']} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--finer", type=float, default=4)
    add_update(parser)
    args = parser.parse_args()
    if shutil.which("gmsh") is None:
        print("gmsh is not installed; nothing to compare with")
        return
    quadloop, version = args.quadloop.resolve(), run(["gmsh", "--version"], ".").strip()
    spacings = {"spacing.min": 0.002, "spacing.max": 0.08, "boundary.airfoil.spacing": 0.005}
    sets = [word for key, value in spacings.items() for word in ("--set", f"{key}={value / args.finer!r}")]
    with tempfile.TemporaryDirectory(prefix="quadloop_gmsh_") as name:
        folder = Path(name)
        run([quadloop, "mesh", CASE, "-o", "cut", "--type", "delaunay", "--set", "smooth.sweeps=0", "--set", 'output.formats=["mesh"]', *sets], folder)
        run([quadloop, "smooth", "cut.mesh", "-o", "given.msh", "--sweeps", "0"], folder)
        (folder / "relocate.geo").write_text(PLANE)
        theirs = float(re.search(r"Done optimizing mesh \(Wall ([\d.]+)s", run(["gmsh", "relocate.geo", "-nopopup", "-parse_and_exit", "-v", "4"], folder))[1])
        ours = float(re.search(r"^    smooth +([\d.]+)", run([quadloop, "smooth", "given.msh", "-o", "ours.msh"], folder), re.M)[1])
        shapes = {path: shape(quadloop, path, folder) for path in ("given.msh", "gmsh.msh", "ours.msh")}
    better = shapes["ours.msh"]["worst_quality"] > shapes["gmsh.msh"]["worst_quality"]
    lines = [f"Gmsh {version}; {shapes['given.msh']['nodes']} nodes, {shapes['given.msh']['triangles']} triangles.", "",
             "| | s | worst quality | mean quality | smallest angle | largest angle | valid |", "|---|---|---|---|---|---|---|",
             row("as cut", "", shapes["given.msh"]), row("Gmsh Relocate2D", f"{theirs:.2f}", shapes["gmsh.msh"]),
             row("quadloop smooth", f"{ours:.2f}", shapes["ours.msh"]), "",
             f"{theirs / ours:.1f} times as fast as Gmsh; goal: 5. Worst cell {'better' if better else 'worse'}."]
    tell("\n".join(lines), "smooth_against_gmsh.py", args.update)


if __name__ == "__main__":
    main()
