#!/usr/bin/env python3
"""How much memory a remesh takes with either transfer, beside the same mesh made from scratch: NACA 0012 (the case of bench.py), four variables at its
nodes, the 5 % of the leaves with the largest differences of one of them marked. Memory is the most that any one rank holds, reading and all, by the nodes of
the new mesh that a rank has on average. Standard library only.

    transfer.py --quadloop PROGRAM [--ranks N ...] [--finer F] [--update docs/performance.md]

--finer    divides every spacing of the case cases/naca0012 (2: a quarter of a million nodes)
"""
import argparse
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell
from remesh import ADAPT, count, stages

ROOT = Path(__file__).resolve().parents[2]
NAMES = ("height", "b", "c", "d")


def quadloop(program, ranks, command, settings, *words):
    launcher = [ROOT / "scripts" / "mpirun", "-n", ranks] if ranks > 1 else []
    sets = [word for text in settings for word in ("--set", text)]
    done = subprocess.run([str(word) for word in (*launcher, program, command, AIRFOIL, *words, *sets)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return done.stdout


def add_field(path):
    """A smooth step across a circle and multiples of it, at every node of a native mesh without a solution."""
    with open(path, encoding="ascii") as file:
        next(file)
        heights = [math.tanh((math.hypot(*map(float, next(file).split())) - 4) / 0.5) for _ in range(int(next(file)))]
    with open(path, "a", encoding="ascii") as file:
        file.write(f"#Number of constants\n0\n#Number of variables\n{len(NAMES)}\n#names: {' '.join(NAMES)}\n")
        file.writelines(" ".join(repr(height * (k + 1)) for k in range(len(NAMES))) + "\n" for height in heights)


def row(ranks, what, table):
    nodes, peak = count(table, "nodes"), float(re.search(r"^  peak memory +([\d.]+)", table, re.M)[1])
    seconds = stages(table).get("transfer")
    return f"| {ranks} | {what} | {nodes} | {peak:.0f} | {peak * 2**20 * ranks / nodes:.0f} | {'' if seconds is None else f'{seconds:.2f}'} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--finer", type=float, default=2)
    add_update(parser)
    args = parser.parse_args()
    settings, rows = [*airfoil_options(args.finer), 'output.formats=["mesh"]'], []
    with tempfile.TemporaryDirectory(prefix="quadloop_transfer_") as name:
        first, again = Path(name) / "first", Path(name) / "again"
        quadloop(args.quadloop, 1, "mesh", settings, "-o", first)
        add_field(f"{first}.mesh")
        for ranks in args.ranks:
            for kind in ("linear", "conservative"):
                rows.append(row(ranks, f"remesh, {kind}", quadloop(args.quadloop, ranks, "remesh", [*settings, *ADAPT, "adapt.refine=0.05", f'adapt.transfer="{kind}"'],
                                                                    "--tree", f"{first}.tree.h5", "--solution", f"{first}.mesh", "-o", again)))
            rows.append(row(ranks, "from scratch", quadloop(args.quadloop, ranks, "mesh", settings, "--tree", f"{again}.tree.h5", "-o", Path(name) / "scratch")))
    tell("\n".join([f"{len(NAMES)} variables at nodes.", "", "| ranks | run | nodes | most MiB on a rank | bytes a node | s of transfer |",
                    "|---|---|---|---|---|---|", *rows]), "transfer.py", args.update)


if __name__ == "__main__":
    sys.exit(main())
