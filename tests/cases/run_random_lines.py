#!/usr/bin/env python3
"""Random arrangements of inner lines and baffles, some with a hole or two blocks: each mesh, smoothed, is valid for `quadloop check` and has the
same bytes on 1, 2 and 3 ranks, or the arrangement is refused with a place and a remedy.

    run_random_lines.py --quadloop PROGRAM [--first N] [--count N] [--curves]

With --curves the lines are splines, and the hole or second block is a circle.
"""
import argparse
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from quadloop_runs import MPIRUN, beside_the_checkout, digest, fail, run

BOX = '[[shape]]\nname = "wall"\nkind = "rectangle"\nbox = [0, 1, 0, 1]\n\n[spacing]\nmin = 0.005\nmax = 0.12\n\n[output]\nformats = ["mesh"]\n'


def arrangement(number, curves):
    """The text of a case."""
    chance = random.Random(number)

    def place(low=-0.1, high=1.1):
        x = chance.uniform(low, high)
        return round(8 * x) / 8 if chance.random() < 0.5 else x

    text = f'[mesh]\ntype = "{chance.choice(("hybrid", "delaunay"))}"\n\n' + BOX
    for line in range(chance.randint(1, 4)):
        path = [[place(), place()] for _ in range(chance.randint(2, 5))]
        if len(path) > 3 and chance.random() < 0.33:
            path.append(path[0])
        kind = "baffle" if chance.random() < 0.25 else "line"
        text += f'\n[[line]]\nname = "line{line}"\nkind = "{kind}"\npath = {path}\n'
        if curves:
            text += "spline = true\n"
    if chance.random() < 0.5:
        x, y, size = place(0.2, 0.5), place(0.2, 0.5), chance.uniform(0.1, 0.4)
        text += '\n[[shape]]\nname = "ring"\n'
        if curves:
            text += f'kind = "circle"\ncentre = {[x + size / 2, y + size / 2]}\nradius = {size / 2}\n'
        else:
            text += f'kind = "rectangle"\nbox = {[x, x + size, y, y + size]}\n'
        if chance.random() < 0.5:
            text += '\n[[block]]\nname = "outer"\nloop = "wall"\n\n[[block]]\nname = "inner"\nloop = "ring"\n'
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=6)
    parser.add_argument("--curves", action="store_true")
    args = parser.parse_args()
    refused = []
    with tempfile.TemporaryDirectory(prefix="quadloop_random_lines_") as name:
        case = Path(name) / "case.toml"
        for number in range(args.first, args.first + args.count):
            case.write_text(arrangement(number, args.curves))
            found = []
            for ranks in (1, 2, 3):
                prefix = Path(name) / f"on_{ranks}"
                done = subprocess.run([MPIRUN, "-n", str(ranks), args.quadloop, "mesh", case, "-o", prefix], capture_output=True, text=True, check=False)
                text = done.stderr
                if done.returncode == 0:
                    found.append([digest(f"{prefix}.{file}") for file in ("mesh", "tree.h5")])
                elif "(" in text and ";" in text and "INTERNAL" not in text.upper():
                    found.append("refused")
                else:
                    fail(f"arrangement {number} on {ranks} ranks: {text}")
            if found[1:] != found[:1] * 2:
                fail(f"arrangement {number} differs between numbers of ranks")
            if found[0] == "refused":
                refused.append(number)
            else:
                run([args.quadloop, "check", Path(name) / "on_1.mesh"])
                judge = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
                if judge is not None and '"baffle"' not in case.read_text():  # which takes doubled nodes for a fault
                    run([sys.executable, judge, Path(name) / "on_1.mesh"])
    if 10 * len(refused) > args.count:
        fail(f"{len(refused)} of {args.count} arrangements are refused: {refused}")
    print(f"good; refused: {refused}")


if __name__ == "__main__":
    sys.exit(main())
