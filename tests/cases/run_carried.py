#!/usr/bin/env python3
"""What a flow carried over from the mesh before saves: steps of each cycle of a case's run beside those from the free stream on the same mesh. A table;
status 1 where the last cycle needs more than a share of them.

    run_carried.py --quadloop PROGRAM [--case CASE.toml] [--most SHARE] [--cycles N] [--set KEY=VALUE]...
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

from adapt_runs import records, sets
from quadloop_runs import ROOT, run


def without_flow(mesh, bare):
    """The native mesh file up to the solution behind its boundaries."""
    bare.write_text(mesh.read_text().split("#Number of constants")[0])
    return bare


def steps_of(history):
    """The last row's, and its CL and CD."""
    step, _, cl, cd, *_ = history.read_text().splitlines()[-1].split(",")
    return int(step), float(cl), float(cd)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", default=ROOT / "cases" / "wedge" / "case.toml", type=Path)
    parser.add_argument("--most", default=1 / 3, type=float)
    parser.add_argument("--cycles")
    parser.add_argument("--set", default=[], action="append")
    args = parser.parse_args()
    options = [*sets(args.set), *(("--cycles", args.cycles) if args.cycles else ())]
    share = 1.0
    with tempfile.TemporaryDirectory(prefix="quadloop_carried_") as name:
        folder = Path(name)
        run([args.quadloop, "-q", "adapt", args.case, "-o", folder / "run", *options])
        print("| cycle | nodes | steps | from the free stream | share | CL, CD | from the free stream |")
        for record in records(folder / "run")[1:]:
            cycle = folder / "run" / f"cycle_{record['cycle']:02}"
            bare = without_flow(cycle / "mesh.mesh", folder / "bare.mesh")
            told = json.loads(run([args.quadloop, "-q", "solve", args.case, bare, "-o", folder / "cold.mesh", "--json", *sets(args.set)]))
            steps, cl, cd = steps_of(cycle / "mesh.history.csv")
            share = steps / told["steps"]
            print(f"| {record['cycle']} | {record['nodes']} | {steps} | {told['steps']} | {share:.2f} | {cl:.6f}, {cd:.6f} | "
                  f"{told['cl']:.6f}, {told['cd']:.6f} |", flush=True)
    return 0 if share <= args.most else 1


if __name__ == "__main__":
    sys.exit(main())
