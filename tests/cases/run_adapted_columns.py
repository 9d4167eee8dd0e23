#!/usr/bin/env python3
"""Columns of layers are as wide along the wall as the solution in them needs: a front that lies within the layers narrows the columns around it, although
the solution is constant outside, with refinement flags and with target sizes; other columns and all heights stay, on several numbers of ranks.

    run_adapted_columns.py --quadloop PROGRAM [--ranks 1 3]
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

from quadloop_runs import JUDGE, MPIRUN, NativeMesh, digest, fail, run

CHANNEL = "4\nfloor open\n2\n0 0\n4 0\noutlet open\n2\n4 0\n4 2\ntop open\n2\n4 2\n0 2\ninlet open\n2\n0 2\n0 0\n"
FRONT, TOP, WIDTH = 2.0, 0.12, 0.1  # the front is at x = FRONT, below y = TOP
CASE = """[geometry]
file = "channel.geom"

[spacing]
max = 0.2

[boundary.floor]
spacing = 0.1
layers = {{ first = 0.004, growth = 1.2, count = 12 }}   # 0.158 thick

[adapt]
cycles = 2
variable = "T"
min = 0.01
{keys}

[solver]
kind = "command"
command = ["{python}", "{script}", "--solve", "{{mesh}}", "{{solution}}"]
mesh = "mesh.mesh"
solution = "solution.mesh"
"""
WAYS = {"flags": 'threshold = "fraction"\nrefine = 0.02', "sizes": "norm = 2\nmax_nodes = 4000"}


def solve(mesh, solution):
    text = Path(mesh).read_text().split("#Number of constants")[0].rstrip("\n") + "\n"
    values = "".join(f"{math.tanh((x - FRONT) / WIDTH) * max(0, 1 - y / TOP)!r}\n" for x, y in NativeMesh(mesh).nodes)
    Path(solution).write_text(text + "#Number of constants\n0\n#Number of variables\n1\n#names: T\n" + values)


def columns(path):
    """(middle, width) of the columns on the floor."""
    mesh = NativeMesh(path)
    ends = sorted(mesh.nodes[n][0] for n in {*sum(mesh.boundaries["floor"], ())})
    return [((a + b) / 2, b - a) for a, b in zip(ends, ends[1:])]


def heights(path):
    """y of the layers' nodes at the inlet."""
    mesh = NativeMesh(path)
    return sorted(y for x, y in mesh.nodes if abs(x) < 1e-9 and y < 0.16)


def meshes(folder):
    return [cycle / "mesh.mesh" for cycle in sorted(folder.glob("cycle_0?"))]


def check_columns(way, folder):
    first, last = meshes(folder)[0], meshes(folder)[-1]
    before, after = columns(first), columns(last)
    for mesh in (first, last):
        run([sys.executable, "-B", JUDGE, mesh])
    narrowest = min(width for x, width in after if abs(x - FRONT) < WIDTH)
    widest = max(width for x, width in before)
    if not narrowest < 0.3 * widest:
        fail(f"{way}: columns at the front are {narrowest} wide; {widest} before")
    far = [width for x, width in after if abs(x - FRONT) > 1.2]
    if not min(far) > 0.45 * widest:
        fail(f"{way}: columns far from the front are {min(far)} wide; {widest} before")
    if heights(first) != heights(last):
        fail(f"{way}: the layers have other heights")


def main():
    if sys.argv[1] == "--solve":
        return solve(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 3])
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_adapted_columns_") as name:
        work = Path(name)
        (work / "channel.geom").write_text(CHANNEL)
        case = work / "case.toml"
        for way, keys in WAYS.items():
            case.write_text(CASE.format(keys=keys, python=sys.executable, script=Path(__file__).resolve()))
            found = set()
            for ranks in args.ranks:
                out = work / f"{way}_{ranks}"
                run([*([MPIRUN, "-n", str(ranks)] if ranks > 1 else []), args.quadloop, "adapt", case, "-o", out])
                found.add(tuple(digest(mesh) for mesh in meshes(out)))
            if len(found) > 1:
                fail(f"{way}: the meshes differ between the numbers of ranks")
            check_columns(way, work / f"{way}_{args.ranks[0]}")
    print("good")
    return None


if __name__ == "__main__":
    sys.exit(main())
