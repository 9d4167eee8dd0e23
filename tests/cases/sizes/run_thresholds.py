#!/usr/bin/env python3
"""What the thresholds promise: a wanted or allowed number of nodes met to 5 %, leaves between adapt.min and spacing.max, a mesh of the sizes that a
solver asks for.

    run_thresholds.py --quadloop PROGRAM
"""
import argparse
import json
import math
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapt_runs import TINY, adapt, require, tiny_case
from quadloop_runs import skip

# A step round no symmetric place, so that hardly two leaves have the same indicator; FIELD is an expression in x and y.
SOLVER = """import math, sys
from pathlib import Path
mesh, solution = sys.argv[1:3]
text = Path(mesh).read_text().split("#Number of constants")[0]
rows = [line for line in text.splitlines() if not line.startswith("#")]
nodes = [tuple(map(float, row.split())) for row in rows[1:int(rows[0]) + 1]]
values = "\\n".join(repr(FIELD) for x, y in nodes)
Path(solution).write_text(text + "#Number of constants\\n0\\n#Number of variables\\n1\\n#names: height\\n" + values + "\\n")
"""
STEP = "math.tanh((math.hypot(x - 0.13, y + 0.07) - 0.6) / 0.05) + 0.01 * x"
CASE = TINY.replace("min = 0.25", "min = 0.06").replace("max = 0.5", "max = 0.13").replace("min = 0.03", "min = 0.007")


def record_of(folder, cycle):
    return json.loads((folder / f"cycle_{cycle:02}" / "record.json").read_text())


def leaf_edges(folder, cycle):
    """(lower left corner, edge) of every leaf inside the domain."""
    import h5py
    with h5py.File(folder / f"cycle_{cycle:02}" / "mesh.tree.h5") as tree:
        unit = tree.attrs["tree_edge"] / 2**30
        low = tree.attrs["root_x"], tree.attrs["root_y"]
        rows = zip(tree["tree"][()].tolist(), tree["x"][()].tolist(), tree["y"][()].tolist(), tree["level"][()].tolist())
        return [(tuple(low[k] + unit * (place[k] * 2**30 + (x, y)[k]) for k in (0, 1)), unit * 2**(30 - level)) for place, x, y, level in rows]


def check_bounds(folder, cycles, least, most):
    for cycle in range(cycles + 1):
        edges = [edge for _, edge in leaf_edges(folder, cycle)]
        require(least <= min(edges) and max(edges) <= most, f"cycle {cycle}: leaves from {min(edges)} to {max(edges)}, not within {least} and {most}")


def check_cap(program, case, folder, indicator):
    """The cap takes hold where the marks would lead past it, and then leaves no more than a twentieth of it unused."""
    free, capped = folder / f"free_{indicator}", folder / f"capped_{indicator}"
    options = ["--cycles", "2", "--set", f'adapt.indicator="{indicator}"']
    adapt(program, case, free, options=options)
    wanted = [record_of(free, cycle)["nodes"] for cycle in (0, 1, 2)]
    cap = (wanted[1] + wanted[2]) // 2
    adapt(program, case, capped, options=[*options, "--set", f"adapt.max_nodes={cap}"])
    nodes = [record_of(capped, cycle)["nodes"] for cycle in (0, 1, 2)]
    require(nodes[:2] == wanted[:2], f"a cap of {cap} has changed cycles that do not reach it: {nodes} instead of {wanted}")
    require(0.95 * cap <= nodes[2] <= cap, f"{nodes[2]} nodes under a cap of {cap}, {wanted[2]} without")
    print(f"{indicator}: {wanted[2]} nodes without a cap, {nodes[2]} under one of {cap}")
    check_bounds(capped, 2, 0.007, 0.13)


def check_wanted_nodes(program, case, folder):
    """On a mesh of a thousand nodes: on a coarser one a single mark, by gradation, adds a twentieth of them."""
    fine = ["--set", "spacing.max=0.0625", "--set", "spacing.min=0.05"]
    adapt(program, case, folder / "base", options=[*fine, "--cycles", "0"])
    base = record_of(folder / "base", 0)["nodes"]
    for factor in (1.3, 2, 3):
        made, target = folder / f"nodes_{factor}", int(factor * base)
        adapt(program, case, made, options=[*fine, "--cycles", "1", "--set", 'adapt.threshold="nodes"', "--set", f"adapt.max_nodes={target}"])
        nodes = record_of(made, 1)["nodes"]
        require(0.95 * target <= nodes <= target, f"{nodes} nodes where {target} are wanted")
        print(f"{nodes} nodes where {target} are wanted")


def check_size_field(program, folder):
    """No leaf larger than the solver's sizes allow, and none much smaller: halving gives between a half and one, gradation up to a level less."""
    def size(x, y):
        return 0.012 + 0.15 * abs(math.hypot(x - 0.13, y + 0.07) - 0.6)

    field = "0.012 + 0.15 * abs(math.hypot(x - 0.13, y + 0.07) - 0.6)"
    text = CASE.replace('variable = "height"', 'variable = { size = "height" }').replace('threshold = "deviation"\n', "")
    case = tiny_case(folder / "sizes", SOLVER.replace("FIELD", field), text)
    made = folder / "by_size"
    adapt(program, case, made, options=["--cycles", "6", "--set", "smooth.sweeps=0"])
    end = max(int(path.name[-2:]) for path in made.glob("cycle_*"))
    last = record_of(made, end)
    require(last["refined"] == 0, f"after {end} cycles {last['refined']} leaves are still larger than the wanted size")
    shares = []
    for (x, y), edge in leaf_edges(made, end):
        smallest = min(size(x + i * edge, y + j * edge) for i in (0, 1) for j in (0, 1))
        require(edge <= smallest, f"the leaf at ({x}, {y}) has edge {edge}, wanted is {smallest}")
        shares.append(edge / min(smallest, 0.13))
    shares.sort()
    print(f"sizes: edge / wanted size has the median {shares[len(shares) // 2]:.2f}, the smallest {shares[0]:.2f}")
    require(shares[len(shares) // 2] > 0.4 and shares[0] > 0.25, "leaves are much smaller than wanted")
    check_bounds(made, end, 0.007, 0.13)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    args = parser.parse_args()
    try:
        import h5py  # noqa: F401
    except ImportError:
        skip("needs h5py to read trees")
    with tempfile.TemporaryDirectory(prefix="quadloop_thresholds_") as name:
        folder = Path(name)
        case = tiny_case(folder / "case", SOLVER.replace("FIELD", STEP), CASE)
        for indicator in ("difference", "gradient", "hessian"):
            check_cap(args.quadloop, case, folder, indicator)
        check_wanted_nodes(args.quadloop, case, folder)
        check_size_field(args.quadloop, folder)
    print("good")


if __name__ == "__main__":
    main()
