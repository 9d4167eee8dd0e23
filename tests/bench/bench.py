#!/usr/bin/env python3
"""How fast meshing and smoothing are, and with how much memory: NACA 0012 to about 0.1, 1 and 4 million cells on one rank, 1 million on two, hybrid and
Delaunay, and the high-resolution Gulf of Mexico. Each run is repeated, the median counts. Standard library only.

    bench.py --quadloop PROGRAM [--repeats N] [--update docs/performance.md] [--require]

--update   puts the figures into the file, between this script's two markers
--require  exit status 1 where a goal is missed
"""
import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from figures import add_update, tell

ROOT = Path(__file__).resolve().parents[2]
AIRFOIL = ROOT / "cases" / "naca0012" / "case.toml"
GULF = ROOT / "cases" / "gulf_of_mexico" / "high.toml"


@dataclass
class Run:
    cells: int
    in_memory: float  # seconds of all stages but smoothing and writing, each on its slowest rank
    smoothing: float  # seconds
    to_file: float    # seconds of all stages but smoothing, the CGNS file written
    peak: int         # bytes that the process held at most; of one rank
    cut_share: float  # of the leaves, those that the outline runs through


def airfoil_options(finer):
    """The airfoil's case with every spacing divided; its far field carries most of the cells."""
    values = {"spacing.min": 0.002, "spacing.max": 0.08, "boundary.airfoil.spacing": 0.005}
    return [f"{key}={value / finer!r}" for key, value in values.items()]


def run_once(quadloop, case, assignments, ranks, folder):
    launcher = [ROOT / "scripts" / "mpirun", "-n", str(ranks)] if ranks > 1 else []
    sets = [word for text in [*assignments, 'output.formats=["cgns"]'] for word in ("--set", text)]
    command = [*launcher, quadloop, "mesh", case, "-o", Path(folder) / "out", *sets]
    child = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said, complaints = child.stdout.read(), child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{complaints}")
    return understand(said, usage.ru_maxrss * 1024)


def understand(table, peak):
    counts = {name: int(value) for name, value in re.findall(r"^  (triangles|quads|leaves|cut leaves) +(\d+)$", table, re.M)}
    stages = {name: float(slowest) for name, slowest in re.findall(r"^    (\w+) +([\d.]+) +[\d.]+$", table, re.M)}
    total = sum(stages.values())
    smoothing = stages.get("smooth", 0.0)
    return Run(counts["triangles"] + counts["quads"], total - smoothing - stages["write"], smoothing, total - smoothing, peak,
               counts["cut leaves"] / counts["leaves"])


def measure(quadloop, case, assignments, ranks, repeats):
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_") as folder:
        runs = [run_once(quadloop, case, assignments, ranks, folder) for _ in range(repeats)]
    median = lambda field: statistics.median(getattr(run, field) for run in runs)
    return Run(runs[0].cells, median("in_memory"), median("smoothing"), median("to_file"), median("peak"), runs[0].cut_share)


def table_row(name, ranks, run):
    memory = f"{run.peak / run.cells:.0f}" if ranks == 1 else ""
    smoothing = f"{run.smoothing:.2f}" if run.smoothing > 0 else ""
    return (f"| {name} | {ranks} | {run.cells} | {run.in_memory:.2f} | {run.cells / run.in_memory / 1e6:.2f} | "
            f"{run.to_file:.2f} | {run.cells / run.to_file / 1e6:.2f} | {smoothing} | {memory} | {100 * run.cut_share:.1f} % |")


def goals(runs):
    """(what, figure, bound, whether it is met)"""
    million = runs["naca0012 1M", 1]
    per_cell = [runs[f"naca0012 {size}", 1].in_memory / runs[f"naca0012 {size}", 1].cells for size in ("0.1M", "1M", "4M")]
    middle = (max(per_cell) + min(per_cell)) / 2
    smoothed, on_two, delaunay = runs["naca0012 1M smoothed", 1], runs["naca0012 1M smoothed", 2], runs["naca0012 1M Delaunay", 1]
    figures = [
        ("million cells a second to the mesh in memory, 1M cells", million.cells / million.in_memory / 1e6, ">=", 1.5),
        ("million cells a second to the CGNS file, 1M cells", million.cells / million.to_file / 1e6, ">=", 1.0),
        ("bytes of peak memory a cell, 1M cells", million.peak / million.cells, "<=", 400),
        ("time per cell from 0.1M to 4M cells, farthest from the middle of its range, over that", max(per_cell) / middle - 1, "<=", 0.2),
        ("the same, largest over smallest", max(per_cell) / min(per_cell), "<=", 1.2),
        ("two ranks faster than one to the mesh in memory, 1M cells", million.in_memory / runs["naca0012 1M", 2].in_memory, ">=", 1.7),
        ("Delaunay cells a second over hybrid ones, to the mesh in memory", delaunay.cells / delaunay.in_memory / (million.cells / million.in_memory), ">=", 0.6),
        ("time of smoothing over that of the mesh in memory, 1M cells", smoothed.smoothing / smoothed.in_memory, "<=", 0.5),
        ("two ranks faster than one at smoothing, 1M cells", smoothed.smoothing / on_two.smoothing, ">=", 1.6),
    ]
    return [(what, figure, f"{sign} {bound}", figure >= bound if sign == ">=" else figure <= bound) for what, figure, sign, bound in figures]


def report(runs, results, repeats):
    lines = [f"median of {repeats} runs.", "",
             "| mesh | ranks | cells | s in memory | M cells/s | s to CGNS | M cells/s | s of smoothing | bytes/cell | leaves cut |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    lines += [table_row(name, ranks, run) for (name, ranks), run in runs.items()]
    lines += ["", "| goal | figure | bound | |", "|---|---|---|---|"]
    lines += [f"| {what} | {figure:.2f} | {bound} | {'met' if met else 'missed'} |" for what, figure, bound, met in results]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--repeats", type=int, default=3)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    cut = ["smooth.sweeps=0"]
    million = airfoil_options(4)
    plan = [("naca0012 0.1M", 1, AIRFOIL, airfoil_options(1) + cut), ("naca0012 1M", 1, AIRFOIL, million + cut),
            ("naca0012 4M", 1, AIRFOIL, airfoil_options(8) + cut), ("naca0012 1M", 2, AIRFOIL, million + cut),
            ("naca0012 1M Delaunay", 1, AIRFOIL, million + cut + ['mesh.type="delaunay"']), ("naca0012 1M smoothed", 1, AIRFOIL, million),
            ("naca0012 1M smoothed", 2, AIRFOIL, million), ("gulf high", 1, GULF, cut), ("gulf high smoothed", 1, GULF, [])]
    runs = {}
    for name, ranks, case, assignments in plan:
        runs[name, ranks] = measure(args.quadloop, case, assignments, ranks, args.repeats)
        print(table_row(name, ranks, runs[name, ranks]), file=sys.stderr, flush=True)
    results = goals(runs)
    tell(report(runs, results, args.repeats), "bench.py", args.update)
    return 1 if args.require and not all(met for *_, met in results) else 0


if __name__ == "__main__":
    sys.exit(main())
