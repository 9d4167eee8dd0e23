#!/usr/bin/env python3
"""Goals in the loop and in `solve`, with the built-in solver past the NACA 0012.

    run_goals.py --quadloop PROGRAM [--full]

Without --full, on few nodes: the same files on 1 and on 3 ranks and after a cycle that is made again, records of goals, the fields that `solve` writes,
refusals; at Mach 0.5 derivatives by angle of attack and Mach number against differences of flows solved anew on the same mesh. With --full:
lift and drag at Mach 0.8 and 1.25 degrees within 0.5 % of those of the finest meshes (docs/notes/adaptation-studies.md) with at most half the nodes that marks need, in
two cycles fewer.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import adapt_three_ways, records, require, sets
from finest_forces import first_within
from quadloop_runs import ROOT, run

CASES = ROOT / "cases" / "naca0012_m08"
GOALS = CASES / "goals.toml"
MARKS = {"nodes": 15729, "cycle": 3}  # docs/notes/adaptation-studies.md; run_wanted_sizes.py --full finds them anew
FEW = ["adapt.passes=0", "solver.iterations=60", "adapt.max_nodes=5000", "adapt.min=0.003"]


def check_ranks_and_resume(program, folder):
    ways = adapt_three_ways(program, GOALS, folder, sets(FEW))
    found = [[cycle["goals"] for cycle in ways[way]] for way in ("one", "three", "again")]
    require(found[0] == found[1] == found[2], f"goals of one run, of three ranks, resumed: {found}")
    cycles = ways["one"]
    for cycle in cycles:
        require(abs(cycle["goals"]["lift"]["value"] - cycle["cl"]) < 1e-13, f"lift is not cl: {cycle}")
        require(abs(cycle["goals"]["drag"]["value"] - cycle["cd"]) < 1e-13, f"drag is not cd: {cycle}")
    require(all(4500 <= cycle["nodes"] <= 5000 for cycle in cycles[1:]), f"nodes {[cycle['nodes'] for cycle in cycles]}")
    marks = sets([*FEW, "adapt.max_nodes=4500"])
    by_marks = folder / "marks.toml"
    by_marks.write_text("\n".join(line for line in GOALS.read_text().replace("../", f"{CASES.parent}/").splitlines() if not line.startswith("norm")))
    run([program, "-q", "adapt", by_marks, "-o", folder / "marks", "--cycles", "1", *marks])
    require(records(folder / "marks")[0]["refined"] > 0, "no cell is marked by the error field")


def solved(program, mesh, out, *assignments):
    record = json.loads(run([program, "--json", "-q", "solve", CASES / "case.toml", mesh, "-o", out, *sets(["solver.iterations=1500", *assignments])]))
    return record, record["goals"]


def check_derivatives(program, folder, mach, digits):
    """Of flows that have converged as far as rounding lets them, and close to each other: limiters and wave speeds have kinks."""
    run([program, "-q", "mesh", CASES / "case.toml", "-o", folder / "coarse"])
    base = folder / f"base_{mach}.mesh"
    same = ['solver.goal=["lift","drag"]', "solver.tolerance=1e-12"]
    record, goals = solved(program, folder / "coarse.mesh", base, f"solver.mach={mach}", *same)
    step = 1e-4
    for key, centre, name in (("alpha", 1.25, "by_alpha"), ("mach", mach, "by_mach")):
        ends = [solved(program, base, folder / "other.mesh", f"solver.mach={mach}", f"solver.{key}={centre + sign * step}", *same)[1] for sign in (1, -1)]
        for goal in ("lift", "drag"):
            difference = (ends[0][goal]["value"] - ends[1][goal]["value"]) / (2 * step)
            found = goals[goal][name]
            print(f"| {mach} | d {goal} / d {key} | {found:.7g} | {difference:.7g} | {found / difference - 1:.1e} | {goals[goal]['adjoint_residual']:.1e} |", flush=True)
            require(abs(found / difference - 1) < digits, f"d {goal} / d {key} at Mach {mach} is {found}, by differences {difference}")
            require(goals[goal]["adjoint_residual"] < 1e-8, f"adjoint of {goal} at Mach {mach}: {goals[goal]}")


def check_fields(program, folder):
    run([program, "-q", "mesh", CASES / "case.toml", "-o", folder / "coarse"])
    out = folder / "fields.mesh"
    solved(program, folder / "coarse.mesh", out, 'solver.goal="drag"', 'solver.goal_adjoint="write"', "solver.tolerance=1e-5")
    names = next(line for line in out.read_text().splitlines() if line.startswith("#names:")).split()[1:]
    adjoint = [f"drag_adjoint_{name}" for name in ("mass", "x_momentum", "y_momentum", "energy")]
    require(names == ["density", "x_velocity", "y_velocity", "pressure", *adjoint, "drag_by_x", "drag_by_y", "error"], f"variables {names}")
    refused = subprocess.run([program, "adapt", CASES / "case.toml", "-o", folder / "no", "--set", 'adapt.variable={error="error"}'],
                             capture_output=True, text=True)
    require(refused.returncode == 1 and "set solver.goal" in refused.stderr, f"an error of nothing: {refused.stderr}")


def check_forces(program, folder):
    run([program, "-q", "adapt", GOALS, "-o", folder / "goals"])
    cycles = records(folder / "goals")
    print("| cycle | nodes | cl | corrected | cd | corrected |\n| --- | --- | --- | --- | --- | --- |")
    for cycle in cycles:
        lift, drag = cycle["goals"]["lift"], cycle["goals"]["drag"]
        print(f"| {cycle['cycle']} | {cycle['nodes']} | {cycle['cl']:.5f} | {lift['corrected']:.5f} | {cycle['cd']:.5f} | {drag['corrected']:.5f} |")
    first = first_within(cycles)
    require(first is not None and first <= MARKS["cycle"] - 2, f"within 0.5 % from cycle {first} on")
    most = max(cycle["nodes"] for cycle in cycles)
    require(most <= MARKS["nodes"] / 2, f"{most} nodes, marks need {MARKS['nodes']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--full", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if arguments.full:
            check_forces(arguments.quadloop, Path(folder))
            return
        check_ranks_and_resume(arguments.quadloop, Path(folder))
        check_fields(arguments.quadloop, Path(folder))
        print("| Mach | | adjoint | differences | | left of the adjoint |\n| --- | --- | --- | --- | --- | --- |")
        check_derivatives(arguments.quadloop, Path(folder), 0.5, 1e-4)


if __name__ == "__main__":
    main()
