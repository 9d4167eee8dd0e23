#!/usr/bin/env python3
"""Wanted sizes in the loop, with the built-in solver past the NACA 0012 at Mach 0.8 and 1.25 degrees.

    run_wanted_sizes.py --quadloop PROGRAM [--full]

Without --full, on few nodes: the number of nodes is met, the same files on 1 and on 3 ranks and after a cycle that is made again, estimates and their
order in the records; the same with passes before the first cycle. With --full: lift and drag within 0.5 % of those of the finest meshes
(docs/notes/adaptation-studies.md) with at most half the nodes that marks need, in fewer cycles, with passes in two fewer; a table, which gives the processor time, too.
"""
import argparse
import resource
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import adapt_three_ways, records, require, sets
from finest_forces import errors, first_within
from quadloop_runs import ROOT, run

CASES = ROOT / "cases" / "naca0012_m08"
FEW = ["solver.iterations=40", "adapt.max_nodes=5000", "adapt.norm=2", "adapt.min=0.003", "adapt.variable=density"]
NO_PASSES = ["adapt.passes=0"]


def check_ranks_and_resume(program, folder):
    options = sets([*FEW, *NO_PASSES, "adapt.until={estimate=1e-9}"])
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
    ended = run([program, "adapt", case, "-o", folder / "one", "--cycles", "4", "--resume", *sets([*FEW, *NO_PASSES, "adapt.until={cl=1}"])])
    require("satisfies adapt.until" in ended, f"an earlier run that has settled goes on: {ended}")


def check_passes(program, folder):
    """The first cycle has the mesh that a rough flow on the case's own asks for."""
    case = CASES / "sizes.toml"
    ways = adapt_three_ways(program, case, folder, sets([*FEW, "adapt.passes=1", "adapt.until={estimate=1e-9}"]))
    first = ways["one"][0]
    for way, cycles in ways.items():
        require(cycles[0]["passes"] == first["passes"], f"other passes: {way} {cycles[0]['passes']}, {first['passes']}")
        require("passes" not in cycles[1], "passes before a later cycle")
    require(len(first["passes"]) == 1 and first["passes"][0]["nodes"] < 4000, f"{first['passes']}")
    require(4500 <= first["nodes"] <= 5000, f"{first['nodes']} nodes after a pass")
    require(0.004 < first["passes"][0]["residual"] <= 0.01, f"not a rough flow: {first['passes']}")


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds_of(cycles):
    return sum(sum(cycle["seconds"].values()) for cycle in cycles)


# The finest meshes resolve the facets of the polygon, so these runs may do so, too.
FACETS = sets(["adapt.facets=true"])
MARKS = sets(["adapt.min=0.0007", "adapt.max_nodes=60000", "solver.tolerance=1e-6"])
RUNS = {"marks": ("case.toml", ["--cycles", "4", *MARKS]), "sizes": ("sizes.toml", sets(NO_PASSES)), "passes, sizes": ("sizes.toml", []),
        "passes, marks": ("case.toml", ["--cycles", "1", *MARKS, *sets(["adapt.passes=3"])])}


def check_forces(program, folder):
    found = {}
    for name, (case, options) in RUNS.items():
        before = processor_seconds()
        run([program, "-q", "adapt", CASES / case, "-o", folder / name, *options, *FACETS])
        used = processor_seconds() - before
        cycles = records(folder / name)
        for cycle in cycles:
            off = ", ".join(f"{key} {cycle[key]:.5f} ({100 * error:+.2f} %)" for key, error in errors(cycle).items())
            print(f"| {name} | {cycle['cycle']} | {cycle['nodes']} | {off} | {cycle.get('estimate', '')} |")
        k = first_within(cycles)
        require(k is not None, f"{name}: lift and drag do not come within 0.5 %")
        share = seconds_of(cycles[:k + 1]) / seconds_of(cycles)
        found[name] = k, cycles[k]["nodes"], used * share
        print(f"{name}: within 0.5 % from cycle {k} on, {cycles[k]['nodes']} nodes, {used * share:.1f} processor seconds up to its end", flush=True)
    cycles_of_marks, nodes_of_marks, _ = found["marks"]
    for name, fewer in (("sizes", 1), ("passes, sizes", 2)):
        cycles, nodes, _ = found[name]
        require(nodes <= 0.5 * nodes_of_marks, f"{name}: more than half the nodes")
        require(cycles <= cycles_of_marks - fewer, f"{name}: not {fewer} cycles fewer")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--full", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if arguments.full:
            check_forces(arguments.quadloop, Path(folder))
        else:
            check_ranks_and_resume(arguments.quadloop, Path(folder) / "cycles")
            check_passes(arguments.quadloop, Path(folder) / "passes")


main()
