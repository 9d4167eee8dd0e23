#!/usr/bin/env python3
"""Wanted sizes in the loop, with the built-in solver past the NACA 0012 at Mach 0.8 and 1.25 degrees.

    run_wanted_sizes.py --quadloop PROGRAM [--full]

Without --full, on few nodes: the number of nodes is met, the same files on 1 and on 3 ranks and after a cycle that is made again, estimates and their
order in the records. With --full: lift and drag within 0.5 % of those of the finest meshes (docs/adaptation.md) with at most half the nodes that marks
need, in fewer cycles; a table of what is met and missed.
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import adapt_three_ways, records, require, sets
from finest_forces import errors, first_within
from quadloop_runs import ROOT, run

CASES = ROOT / "cases" / "naca0012_m08"
FEW = ["solver.iterations=40", "adapt.max_nodes=5000", "adapt.norm=2", "adapt.min=0.003", "adapt.variable=density"]


def check_ranks_and_resume(program, folder):
    options = sets([*FEW, "adapt.until={estimate=1e-9}"])
    case = CASES / "sizes.toml"
    ways = adapt_three_ways(program, case, folder, options)
    cycles = ways["one"]
    require(len(cycles) == 3, f"{len(cycles)} cycles")
    for key in ("estimate", "order", "settled", "cl", "cd"):
        found = [[cycle.get(key) for cycle in ways[way]] for way in ("one", "three", "again")]
        require(found[0] == found[1] == found[2], f"{key} of one run, of three ranks, resumed: {found}")
    require(all(cycle["estimate"] > 0 and cycle["settled"] is False for cycle in cycles), f"{cycles}")
    require(cycles[1]["order"] > 0 and cycles[1]["estimate"] < cycles[0]["estimate"], f"the error grows: {cycles}")
    require(all(4500 <= cycle["nodes"] <= 5000 for cycle in cycles[1:]), f"nodes {[cycle['nodes'] for cycle in cycles]}")
    ended = run([program, "adapt", case, "-o", folder / "one", "--cycles", "4", "--resume", *sets([*FEW, "adapt.until={cl=1}"])])
    require("has settled by adapt.until" in ended, f"an earlier run that has settled goes on: {ended}")


def check_forces(program, folder):
    marks, sizes = folder / "marks", folder / "sizes"
    run([program, "-q", "adapt", CASES / "case.toml", "-o", marks, "--cycles", "4",
         *sets(["adapt.min=0.0007", "adapt.max_nodes=60000", "solver.tolerance=1e-6"])])
    run([program, "-q", "adapt", CASES / "sizes.toml", "-o", sizes])
    found = {}
    for name, run_folder in (("marks", marks), ("sizes", sizes)):
        cycles = records(run_folder)
        for cycle in cycles:
            off = ", ".join(f"{key} {cycle[key]:.5f} ({100 * error:+.2f} %)" for key, error in errors(cycle).items())
            print(f"| {name} | {cycle['cycle']} | {cycle['nodes']} | {off} | {cycle.get('estimate', '')} |")
        k = first_within(cycles)
        require(k is not None, f"{name}: lift and drag do not come within 0.5 %")
        found[name] = k, cycles[k]["nodes"]
    (cycles_of_marks, nodes_of_marks), (cycles_of_sizes, nodes_of_sizes) = found["marks"], found["sizes"]
    print(f"nodes: {nodes_of_sizes} of {nodes_of_marks}; cycles: {cycles_of_sizes} of {cycles_of_marks} "
          f"(two fewer: {'met' if cycles_of_sizes <= cycles_of_marks - 2 else 'MISSED'})")
    require(nodes_of_sizes <= 0.5 * nodes_of_marks, "more than half the nodes")
    require(cycles_of_sizes < cycles_of_marks, "as many cycles")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--full", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if arguments.full:
            check_forces(arguments.quadloop, Path(folder))
        else:
            check_ranks_and_resume(arguments.quadloop, Path(folder))


main()
