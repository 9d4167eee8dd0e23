#!/usr/bin/env python3
"""Nodes that gather at fronts (smooth.targets = "solution") in the loop and in remesh, with the solver of the ring.

    run_targets.py --quadloop PROGRAM

Meshes are valid and have the number of nodes, less error than without; the same files on 1 and on 3 ranks, after a cycle that is made again, and from
`remesh` of the same solution; what a tree alone cannot know is said.
"""
import argparse
import json
import math
import shutil
import subprocess
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, ROOT, fail, run
from front_error import l1_error

CASE = ROOT / "cases" / "ring"


def require(holds, message):
    if not holds:
        fail(message)


def ring_case(folder):
    """The ring's case for few nodes, by wanted sizes, nodes gathered."""
    shutil.copytree(CASE, folder)
    text = (CASE / "case.toml").read_text()
    adapt = '[smooth]\ntargets = "solution"\n\n[adapt]\ncycles = 2\nvariable = "height"\nnorm = 1\nmax_nodes = 1200\nmin = 0.004\n\n'
    case = folder / "gathered.toml"
    case.write_text(text[:text.index("[adapt]")] + adapt + text[text.index("[solver]"):])
    return case


def height(x, y):
    return math.tanh((math.hypot(x, y) - 0.6) / 0.01)


def error_after(run_folder):
    """That of the last cycle; and its number of nodes."""
    return l1_error(run_folder / "cycle_02" / "mesh.mesh", "height", height)


def check_cycles(program, case, folder):
    run([program, "-q", "adapt", case, "-o", folder / "one"])
    run([program, "-q", "adapt", case, "-o", folder / "ideal", "--set", 'smooth.targets="ideal"'])
    for cycle in ("cycle_01", "cycle_02"):
        run([program, "-q", "check", folder / "one" / cycle / "mesh.mesh", "--geometry", case.parent / "square.geom"])
        record = json.loads((folder / "one" / cycle / "record.json").read_text())
        require(record["nodes"] <= 1200 and record["quads"] > 0, f"{cycle}: {record}")
    (nodes, error), (_, ideal) = error_after(folder / "one"), error_after(folder / "ideal")
    require(error < 0.6 * ideal, f"error {error} of {nodes} nodes, {ideal} without targets")


def check_ranks_and_resume(program, case, folder):
    run([MPIRUN, "-n", "3", program, "-q", "adapt", case, "-o", folder / "three"])
    shutil.copytree(folder / "one", folder / "again")
    shutil.rmtree(folder / "again" / "cycle_02")
    run([program, "-q", "adapt", case, "-o", folder / "again", "--resume"])
    for cycle in ("cycle_01", "cycle_02"):
        for name in ("mesh.mesh", "mesh.tree.h5"):
            bytes_of = [(folder / one / cycle / name).read_bytes() for one in ("one", "three", "again")]
            require(bytes_of[0] == bytes_of[1], f"{cycle}/{name} differs on 3 ranks")
            require(bytes_of[0] == bytes_of[2], f"{cycle}/{name} differs after --resume")


def check_remesh(program, case, folder):
    last = folder / "one" / "cycle_01"
    for ranks in (1, 2):
        run([MPIRUN, "-n", str(ranks), program, "-q", "remesh", case, "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh",
             "-o", folder / f"next_{ranks}"])
    tree = (folder / "one" / "cycle_02" / "mesh.tree.h5").read_bytes()
    require((folder / "next_1.tree.h5").read_bytes() == tree, "remesh makes another tree than the loop")
    require((folder / "next_2.tree.h5").read_bytes() == tree, "remesh makes another tree on 2 ranks")
    require((folder / "next_1.mesh").read_bytes() == (folder / "next_2.mesh").read_bytes(), "remesh makes another mesh on 2 ranks")


def told_by(program, *arguments):
    return subprocess.run([program, "-q", *arguments], capture_output=True, text=True, check=True).stderr


def check_warnings(program, case, folder):
    """A tree knows no solution."""
    last = folder / "one" / "cycle_02"
    for more, words in (([], 'smooth.targets = "solution"'), (["--set", 'smooth.targets="ideal"'], "")):
        told = told_by(program, "mesh", case, "--tree", last / "mesh.tree.h5", "-o", folder / "from_tree", *more)
        require(told.count("\n") == (1 if words else 0) and words in told, f"mesh --tree said: {told}")
    without = case.parent / "without.toml"
    text = case.read_text()
    without.write_text(text[:text.index("[adapt]")] + text[text.index("[solver]"):])
    told = told_by(program, "remesh", without, "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh", "-o", folder / "standing")
    require("no table [adapt]" in told, f"remesh said: {told}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    program = parser.parse_args().quadloop
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = ring_case(folder / "case")
        check_cycles(program, case, folder)
        check_ranks_and_resume(program, case, folder)
        check_remesh(program, case, folder)
        check_warnings(program, case, folder)


main()
