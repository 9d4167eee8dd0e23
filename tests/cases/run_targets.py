#!/usr/bin/env python3
"""Nodes that gather at fronts (smooth.targets = "solution") in the loop and in remesh, with the solver of the ring.

    run_targets.py --quadloop PROGRAM

Meshes are valid and have the number of nodes, less error than without; the same files on 1 and on 3 ranks, after a cycle that is made again, and from
`remesh` of the same solution; what a tree alone cannot know is said.
"""
import argparse
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from adapt_runs import adapt_three_ways, remesh_as_the_loop, require
from front_error import l1_error
from quadloop_runs import ROOT, run

CASE = ROOT / "cases" / "ring"


def ring_case(folder):
    """The ring's case for few nodes, by wanted sizes, nodes gathered."""
    shutil.copytree(CASE, folder)
    text = (CASE / "case.toml").read_text()
    adapt = '[smooth]\ntargets = "solution"\n\n[adapt]\ncycles = 2\nvariable = "height"\nnorm = 1\nmax_nodes = 1200\nmin = 0.004\n\n'
    case = folder / "gathered.toml"
    case.write_text(text[:text.index("[adapt]")] + adapt + text[text.index("[solver]"):])
    return case


def height(x, y):
    return np.tanh((np.hypot(x, y) - 0.6) / 0.01)


def error_after(run_folder):
    """That of the last cycle; and its number of nodes."""
    return l1_error(run_folder / "cycle_02" / "mesh.mesh", "height", height)


def check_cycles(program, case, folder):
    records = adapt_three_ways(program, case, folder)["one"]
    run([program, "-q", "adapt", case, "-o", folder / "ideal", "--set", 'smooth.targets="ideal"'])
    for record in records[1:]:
        run([program, "-q", "check", folder / "one" / f"cycle_0{record['cycle']}" / "mesh.mesh", "--geometry", case.parent / "square.geom"])
        require(record["nodes"] <= 1200 and record["quads"] > 0, f"{record}")
    (nodes, error), (_, ideal) = error_after(folder / "one"), error_after(folder / "ideal")
    require(error < 0.6 * ideal, f"error {error} of {nodes} nodes, {ideal} without targets")


def told_by(program, *arguments):
    return subprocess.run([program, "-q", *arguments], capture_output=True, text=True, check=True).stderr


def check_warnings(program, case, folder):
    """A tree knows no solution."""
    last = folder / "one" / "cycle_02"
    for more, words in (([], 'smooth.targets = "solution"'), (["--set", 'smooth.targets="ideal"'], "")):
        told = told_by(program, "mesh", case, "--tree", last / "mesh.tree.h5", "-o", folder / "from_tree", *more)
        require(told.count("\n") == (1 if words else 0) and words in told, f"mesh --tree said: {told}")
    for more, words in (([], 'smooth.targets = "solution": "mesh" ignores this setting'), (["--set", 'smooth.targets="ideal"'], "")):
        told = told_by(program, "mesh", case, "-o", folder / "first", *more)
        require(told.count("\n") == (1 if words else 0) and words in told, f"mesh said: {told}")
    without = case.parent / "without.toml"
    text = case.read_text()
    without.write_text(text[:text.index("[adapt]")] + text[text.index("[solver]"):])
    told = told_by(program, "remesh", without, "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh", "-o", folder / "standing")
    require("without a table [adapt]" in told, f"remesh said: {told}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    program = parser.parse_args().quadloop
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = ring_case(folder / "case")
        check_cycles(program, case, folder)
        remesh_as_the_loop(program, case, folder)
        check_warnings(program, case, folder)


main()
