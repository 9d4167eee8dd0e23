#!/usr/bin/env python3
"""Meshes that stretch (mesh.type = "metric") in the loop and in remesh, with the built-in solver past the wedge.

    run_metric.py --quadloop PROGRAM

The number of nodes is met, edges are mostly units of the metric, meshes are valid and on the outline; the same files on 1 and on 3 ranks, after a
cycle that is made again, and from `remesh` of the same solution; less error for fewer nodes than the first mesh; sizes by a solver's error;
what `mesh --tree` says of a metric mesh; refusals.
"""
import argparse
import shutil
import subprocess
import tempfile
from pathlib import Path

from adapt_runs import adapt_three_ways, remesh_as_the_loop, require
from quadloop_runs import MPIRUN, ROOT, run

CASE = ROOT / "cases" / "wedge" / "case.toml"


def metric_case(folder):
    """The wedge's case for few nodes."""
    text = CASE.read_text()
    head = text[:text.index("[adapt]")].replace("min = 0.015", "min = 0.05").replace("max = 0.034", "max = 0.2")
    solver = text[text.index("[solver]"):].replace("iterations = 1000", "iterations = 20")
    adapt = '[mesh]\ntype = "metric"\n\n[adapt]\ncycles = 2\nvariable = "density"\nnorm = 2\nmax_nodes = 600\nmin = 0.001\n\n'
    folder.mkdir()
    shutil.copy(CASE.parent / "wedge.geom", folder)
    case = folder / "case.toml"
    case.write_text(head + adapt + solver)
    return case


def check_cycles(program, case, folder):
    records = adapt_three_ways(program, case, folder)["one"]
    require(len(records) == 3 and "metric" not in records[0], f"{len(records)} cycles")
    for record in records[1:]:
        require(0.95 * 600 <= record["nodes"] <= 600, f"{record['nodes']} nodes")
        edges = record["metric"]["edges"]["counts"]
        require(sum(edges[2:4]) > 0.93 * sum(edges), f"edges {edges}")
        require(record["metric"]["complexity"] > 300, f"{record['metric']}")
        require(record["quads"] == 0, "triangles alone")
    require(records[2]["estimate"] < 0.5 * records[0]["estimate"], f"the error: {[r['estimate'] for r in records]}")
    for cycle in ("cycle_01", "cycle_02"):
        run([program, "-q", "check", folder / "one" / cycle / "mesh.mesh", "--geometry", case.parent / "wedge.geom"])


def check_error(program, case, folder):
    """Sizes by an error that a solver wrote, be it any field: other meshes than by that field's hessian, the same on 2 ranks."""
    last = folder / "one" / "cycle_01"
    for ranks in (1, 2):
        run([MPIRUN, "-n", str(ranks), program, "-q", "remesh", case, "--tree", last / "mesh.tree.h5", "--solution", last / "mesh.mesh",
             "-o", folder / f"error_{ranks}", "--set", 'adapt.variable={ error = "density" }'])
    meshes = [(folder / f"{name}.mesh").read_bytes() for name in ("error_1", "error_2", "next_1")]
    require(meshes[0] == meshes[1], "sizes by an error differ on 2 ranks")
    require(meshes[0] != meshes[2], "sizes by an error are those by a hessian")


def check_tree_alone(program, case, folder):
    for cycle, says in (("cycle_00", False), ("cycle_02", True)):
        told = subprocess.run([program, "mesh", case, "--tree", folder / "one" / cycle / "mesh.tree.h5", "-o", folder / "alone"],
                              capture_output=True, text=True, check=False)
        require(told.returncode == 0, told.stderr)
        require(("without anisotropic cells" in told.stderr) == says, f"mesh --tree of {cycle}: {told.stderr}")
        require(told.stderr.count("warning") == int(says), f"mesh --tree of {cycle}: {told.stderr}")


def check_refusals(program, case, folder):
    for assignment, words in (('mesh.mirror="x"', "half"), ("adapt.growth=0.5", "growth")):
        told = subprocess.run([program, "adapt", case, "-o", folder / "refused", "--set", assignment], capture_output=True, text=True, check=False)
        require(told.returncode == 1 and words in told.stderr, f"{assignment}: {told.returncode} {told.stderr}")
    other = case.parent / "marks.toml"
    other.write_text(case.read_text().replace("norm = 2\n", ""))
    told = subprocess.run([program, "adapt", other, "-o", folder / "refused"], capture_output=True, text=True, check=False)
    require(told.returncode == 1 and "'adapt.norm'" in told.stderr and "norm = 2" in told.stderr, f"without norm: {told.returncode} {told.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadloop", required=True)
    program = parser.parse_args().quadloop
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = metric_case(folder / "case")
        check_refusals(program, case, folder)
        check_cycles(program, case, folder)
        remesh_as_the_loop(program, case, folder)
        check_error(program, case, folder)
        check_tree_alone(program, case, folder)


main()
