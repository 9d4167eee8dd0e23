#!/usr/bin/env python3
"""How long one remesh takes after a change of about 5 % of the leaves, and of 0.1 %, beside the same mesh made from scratch: NACA 0012 to about a
million cells (the case of bench.py), an artificial field at its nodes, that share of the leaves with the largest differences marked. Each pair runs
`remesh`, then `mesh --tree` of the tree that it left, which is the same mesh; medians count. Reading and writing do not; the transfer of the
solution, which a mesh from scratch goes without, is told apart. Standard library only.

    remesh.py --quadloop PROGRAM [--repeats N] [--finer F] [--update docs/performance.md] [--require]

--update   puts the figures into the file, between this script's two markers
--require  exit status 1 where remeshing after a change of 5 %, with smoothing and transfer, takes more than 80 % of the time from scratch
"""
import argparse
import math
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell

GOAL = 0.8
SHARES = (0.05, 0.001)
ADAPT = ['adapt.variable="height"', 'adapt.indicator="difference"', 'adapt.threshold="fraction"', "adapt.coarsen=0", "adapt.min=0.00001"]


def quadloop(program, command, settings, *words):
    sets = [word for text in settings for word in ("--set", text)]
    line = [str(word) for word in (program, command, AIRFOIL, *words, *sets)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(line)}\n{done.stdout}{done.stderr}")
    return done.stdout


def stages(table):
    """{stage: seconds of the slowest rank}, but reading, with a look whether the solution is the tree's mesh's, and writing."""
    found = {name: float(slowest) for name, slowest in re.findall(r"^    (\w+) +([\d.]+) +[\d.]+$", table, re.M)}
    return {name: seconds for name, seconds in found.items() if name not in ("read", "compare", "write")}


def count(table, name):
    return int(re.search(rf"^  {name} +(\d+)$", table, re.M)[1])


def add_field(path):
    """A smooth step across a circle, at every node of a native mesh without a solution."""
    with open(path, encoding="ascii") as file:
        next(file)
        nodes = int(next(file))
        heights = [math.tanh((math.hypot(*map(float, next(file).split())) - 4) / 0.5) for _ in range(nodes)]
    with open(path, "a", encoding="ascii") as file:
        file.write("#Number of constants\n0\n#Number of variables\n1\n#names: height\n")
        file.writelines(f"{height!r}\n" for height in heights)


def pair(program, settings, share, folder):
    """The tables of one remesh, and of the mesh that it led to from scratch."""
    first, again = folder / "first", folder / "again"
    files = ["--tree", f"{first}.tree.h5", "--solution", f"{first}.mesh", "-o", again]
    remeshed = quadloop(program, "remesh", [*settings, *ADAPT, f"adapt.refine={share}"], *files)
    scratch = quadloop(program, "mesh", settings, "--tree", f"{again}.tree.h5", "-o", folder / "scratch")
    if count(scratch, "nodes") != count(remeshed, "nodes"):
        sys.exit("the mesh from scratch is not the mesh that remeshing led to")
    return remeshed, scratch


def medians(tables):
    columns = [stages(table) for table in tables]
    return {name: statistics.median(column[name] for column in columns) for name in columns[0]}


def row_of(sweeps, share, first, pairs):
    """A row of the stages of both, and the median ratio of their times over the pairs."""
    remeshed, scratch = zip(*pairs)
    ratios = [(sum(stages(r).values()), stages(r)["transfer"], sum(stages(s).values())) for r, s in pairs]
    ratio = statistics.median(whole / scratch for whole, _, scratch in ratios)
    without = statistics.median((whole - transfer) / scratch for whole, transfer, scratch in ratios)
    text = [", ".join(f"{stage} {seconds:.2f}" for stage, seconds in medians(tables).items() if seconds >= 0.005) for tables in (remeshed, scratch)]
    sums = [statistics.median(sum(stages(table).values()) for table in tables) for tables in (remeshed, scratch)]
    leaves = f"{count(first, 'leaves')} | {count(remeshed[0], 'leaves')}"
    return f"| {sweeps} | {share:.1%} | {leaves} | {text[0]} | {sums[0]:.2f} | {text[1]} | {sums[1]:.2f} | {ratio:.2f} | {without:.2f} |", ratio


def measure(program, finer, sweeps, repeats):
    """{share of the leaves: row and ratio}."""
    settings = [*airfoil_options(finer), f"smooth.sweeps={sweeps}", 'output.formats=["mesh"]']
    with tempfile.TemporaryDirectory(prefix="quadloop_remesh_") as name:
        folder = Path(name)
        first = quadloop(program, "mesh", settings, "-o", folder / "first")
        add_field(folder / "first.mesh")
        return {share: row_of(sweeps, share, first, [pair(program, settings, share, folder) for _ in range(repeats)]) for share in SHARES}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--finer", type=float, default=4, help="every spacing divided by this; 4 makes about a million cells")
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    measured = {sweeps: measure(args.quadloop, args.finer, sweeps, args.repeats) for sweeps in (0, 20)}
    rows = [row for of_shares in measured.values() for row, _ in of_shares.values()]
    _, ratio = measured[20][SHARES[0]]
    goal = (f"Goal: with smoothing and transfer, {SHARES[0]:.0%} marked, at most {GOAL:.0%} of the time from scratch: "
            f"{'met' if ratio <= GOAL else 'missed'}.")
    tell("\n".join([f"median of {args.repeats} pairs, one rank.", "",
                    "| sweeps | marked | leaves before | after | s of remesh | in all | s from scratch | in all | ratio | without transfer |",
                    "|---|---|---|---|---|---|---|---|---|---|", *rows, "", goal]), "remesh.py", args.update)
    return 1 if args.require and ratio > GOAL else 0


if __name__ == "__main__":
    sys.exit(main())
