#!/usr/bin/env python3
"""How fast meshing and smoothing are, and with how much memory: NACA 0012 to about 0.1, 1 and 4 million cells on one rank, 4 million on two, hybrid and
Delaunay, with sizes that grow from the wall, and the high-resolution Gulf of Mexico. Each run is repeated, all of them in turns; the median counts.
One rank and two are compared on runs of a second, not of a fifth. Standard library only.

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


def wall_options(cells, slope):
    """Triangles whose edges grow by `slope` from the airfoil on, about twice so many as cells; most of them near it."""
    wall = 16.0 / cells
    leaf = 2 * wall  # that leaves stay below, by up to half, where other programs' edges go beyond
    return [f"spacing.min={leaf / 2!r}", "spacing.max=2.0", f"spacing.gradation={1 + 2 * slope!r}", f"boundary.airfoil.spacing={leaf!r}"]


def run_once(quadloop, case, assignments, ranks, folder):
    launcher = [ROOT / "scripts" / "mpirun", "-n", str(ranks)] if ranks > 1 else []
    sets = [word for text in ['output.formats=["cgns"]', *assignments] for word in ("--set", text)]
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


def measure(quadloop, plan, repeats):
    runs = {(name, ranks): [] for name, ranks, *_ in plan}
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_") as folder:
        for turn in range(repeats):
            for name, ranks, case, assignments in plan:
                run = run_once(quadloop, case, assignments, ranks, folder)
                runs[name, ranks].append(run)
                print(f"turn {turn + 1}: {table_row(name, ranks, run)}", file=sys.stderr, flush=True)
    return {key: medians(some) for key, some in runs.items()}


def medians(runs):
    fields = ("in_memory", "smoothing", "to_file", "peak")
    return Run(runs[0].cells, *(statistics.median(getattr(run, field) for run in runs) for field in fields), runs[0].cut_share)


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
    smoothed, delaunay = runs["naca0012 1M smoothed", 1], runs["naca0012 1M Delaunay", 1]
    one, two = runs["naca0012 4M smoothed", 1], runs["naca0012 4M smoothed", 2]
    wall_one, wall_two = (runs["naca0012 wall smoothed", ranks] for ranks in (1, 2))
    figures = [
        ("million cells a second to the mesh in memory, 1M cells", million.cells / million.in_memory / 1e6, ">=", 1.5),
        ("million cells a second to the CGNS file, 1M cells", million.cells / million.to_file / 1e6, ">=", 1.0),
        ("bytes of peak memory a cell, 1M cells", million.peak / million.cells, "<=", 400),
        ("time per cell from 0.1M to 4M cells, farthest from the middle of its range, over that", max(per_cell) / middle - 1, "<=", 0.2),
        ("the same, largest over smallest", max(per_cell) / min(per_cell), "<=", 1.2),
        ("two ranks faster than one to the mesh in memory, 4M cells", one.in_memory / two.in_memory, ">=", 1.7),
        ("Delaunay cells a second over hybrid ones, to the mesh in memory", delaunay.cells / delaunay.in_memory / (million.cells / million.in_memory), ">=", 0.6),
        ("time of smoothing over that of the mesh in memory, 1M cells", smoothed.smoothing / smoothed.in_memory, "<=", 0.5),
        ("two ranks faster than one at smoothing, 4M cells", one.smoothing / two.smoothing, ">=", 1.6),
        ("two ranks faster than one, sizes that grow from the wall, smoothed and written",
         (wall_one.to_file + wall_one.smoothing) / (wall_two.to_file + wall_two.smoothing), ">=", 1.8),
    ]
    return [(what, figure, f"{sign} {bound}", figure >= bound if sign == ">=" else figure <= bound) for what, figure, sign, bound in figures]


def report(runs, results, repeats):
    lines = [f"median of {repeats} runs.", "",
             "| mesh | ranks | cells | s in memory | M cells/s | s to the file | M cells/s | s of smoothing | bytes/cell | leaves cut |",
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
    delaunay = ['mesh.type="delaunay"']
    near_wall = [*wall_options(1e6, 0.3), *delaunay, 'output.formats=["qmesh"]']
    plan = [("naca0012 0.1M", 1, AIRFOIL, airfoil_options(1) + cut), ("naca0012 1M", 1, AIRFOIL, million + cut),
            ("naca0012 4M", 1, AIRFOIL, airfoil_options(8) + cut), ("naca0012 1M Delaunay", 1, AIRFOIL, million + cut + delaunay),
            ("naca0012 1M smoothed", 1, AIRFOIL, million), *(("naca0012 4M smoothed", ranks, AIRFOIL, airfoil_options(8)) for ranks in (1, 2)),
            *(("naca0012 wall smoothed", ranks, AIRFOIL, near_wall) for ranks in (1, 2)), ("gulf high", 1, GULF, cut), ("gulf high smoothed", 1, GULF, [])]
    runs = measure(args.quadloop, plan, args.repeats)
    results = goals(runs)
    tell(report(runs, results, args.repeats), "bench.py", args.update)
    return 1 if args.require and not all(met for *_, met in results) else 0


if __name__ == "__main__":
    sys.exit(main())
