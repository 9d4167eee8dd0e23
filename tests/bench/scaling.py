#!/usr/bin/python3
"""How meshing scales with ranks, on a machine with fewer cores than ranks: CPU seconds, messages, bytes, collective calls and memory of each rank, counted
by a library in front of MPI (mpi_counts.c), so that waiting does not count. Two cases of the thesis, both mesh types, smoothed and written; then a model
of the airfoil's figures, fitted to small runs, checked on runs that were not fitted, and extrapolated. Needs numpy, scipy and mpicc.

    scaling.py --quadloop PROGRAM [--ranks 1 2 4 8 16] [--save FILE] [--from FILE] [--update docs/scaling.md]

--save    keeps what was measured; --from reports it without measuring again
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import nnls

from bench import airfoil_options
from figures import add_update, machine, tell

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CASES = {"naca0012": ROOT / "cases" / "naca0012" / "case.toml", "gulf_of_mexico": ROOT / "cases" / "gulf_of_mexico" / "medium.toml"}
BALANCED = {"gulf_of_mexico, high": ROOT / "cases" / "gulf_of_mexico" / "high.toml", "gulf_of_mexico, layers": ROOT / "cases" / "gulf_of_mexico" / "layers.toml"}
BALANCED_ON = (4, 8, 16)
TYPES = ("hybrid", "delaunay")
SIZE = 4  # all spacings of the airfoil divided by it in the first tables
FITTED = [(size, ranks) for size in (2, 4, 8) for ranks in (1, 2, 4, 16)] + [(SIZE, 64)]
CHECKED = [(5, 8), (SIZE, 32), (SIZE, 256)]
NEIGHBOURS = 12  # of a rank, at most, in a division of the plane
LARGE = (1e9, 1024)  # cells, ranks
COUNTS = ("work", "inside", "messages", "bytes", "collectives", "collective_bytes")


def build_counter(folder):
    library = folder / "mpi_counts.so"
    subprocess.run(["mpicc", "-shared", "-fPIC", "-O2", "-o", library, HERE / "mpi_counts.c"], check=True)
    return library


def options_of(case, mesh_type, size):
    assignments = airfoil_options(size) if case == "naca0012" else []
    return [word for text in [*assignments, f'mesh.type="{mesh_type}"', 'output.formats=["qmesh"]'] for word in ("--set", text)]


def run_once(quadloop, library, case, mesh_type, size, ranks):
    """One run: the counts of each stage on each rank, and the numbers of cells and segments."""
    with tempfile.TemporaryDirectory(prefix="quadloop_scaling_") as folder:
        counts = Path(folder) / "counts"
        counts.mkdir()
        launcher = [ROOT / "scripts" / "mpirun", "-n", ranks, "-x", f"LD_PRELOAD={library}", "-x", f"MPI_COUNTS={counts}"]
        command = [*launcher, quadloop, "mesh", (CASES | BALANCED)[case], "-o", Path(folder) / "out", "--json", *options_of(case, mesh_type, size)]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
        record = json.loads(done.stdout)
        rows = [read_counts(counts / str(rank)) for rank in range(ranks)]
    run = {"case": case, "type": mesh_type, "size": size, "ranks": ranks, "cells": record["triangles"] + record["quads"], "cut": record["cut_leaves"],
           "peak": [row["peak"] for row in rows], "partners": [row["partners"] for row in rows],
           "stages": {stage: {name: [row["stages"].get(stage, [0] * len(COUNTS))[k] for row in rows] for k, name in enumerate(COUNTS)}
                      for stage in rows[0]["stages"]}}
    print(f"{case} {mesh_type} {size} on {ranks}: {run['cells']} cells, {total(run, 'work').sum():.2f} s, {total(run, 'work').max():.2f} s at most",
          file=sys.stderr, flush=True)
    return run


def read_counts(path):
    first, *rest = [line.split() for line in path.read_text().splitlines()]
    return {"peak": int(first[1]), "partners": int(first[2]), "stages": {row[0]: [float(word) for word in row[1:]] for row in rest}}


def total(run, name):
    """Of each rank, over all stages."""
    return np.sum([np.array(stage[name]) for stage in run["stages"].values()], axis=0)


def measure(args, library):
    runs = [run_once(args.quadloop, library, case, mesh_type, SIZE, ranks) for case in CASES for mesh_type in TYPES for ranks in args.ranks]
    runs += [run_once(args.quadloop, library, case, mesh_type, SIZE, ranks) for case in BALANCED for mesh_type in TYPES for ranks in BALANCED_ON]
    have = {(run["size"], run["ranks"]) for run in runs if (run["case"], run["type"]) == ("naca0012", "hybrid")}
    more = [pair for pair in FITTED + CHECKED if pair not in have]
    runs += [run_once(args.quadloop, library, "naca0012", "hybrid", *pair) for pair in more]
    return runs


def first_tables(runs, ranks):
    heads = ("case", "cells", "ranks", "CPU s, all ranks", "slowest rank", "largest over mean", "smallest over mean", "speed-up by the slowest", "messages",
             "MB sent", "collectives", "MiB")
    lines = ["", "| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for case in CASES:
        for mesh_type in TYPES:
            own = [run for run in runs if (run["case"], run["type"], run["size"]) == (case, mesh_type, SIZE) and run["ranks"] in ranks]
            alone = total(own[0], "work").max()
            for run in own:
                work = total(run, "work")
                lines.append(f"| {case}, {mesh_type} | {run['cells']} | {run['ranks']} | {work.sum():.2f} | {work.max():.2f} | "
                             f"{work.max() / work.mean():.2f} | {work.min() / work.mean():.2f} | "
                             f"{alone / work.max():.2f} | {total(run, 'messages').max():.0f} | {total(run, 'bytes').max() / 1e6:.2f} | "
                             f"{total(run, 'collectives').max():.0f} | {max(run['peak']) / 2**20:.0f} |")
    return lines


def balance_table(runs):
    """The imbalance of all stages together and of the stages that take most of the time."""
    stages = ("layer edge", "refinement", "cutting", "mesh", "smooth", "layers", "other")
    lines = ["", "Larger coasts: largest over mean of the CPU time, of all and by stages.", "",
             "| case | cells | ranks | CPU s, all ranks | slowest rank | all | " + " | ".join(stages) + " |", "|---" * (6 + len(stages)) + "|"]
    for run in [run for run in runs if run["case"] in BALANCED]:
        work = total(run, "work")
        ratios = []
        for stage in stages:
            own = np.array(run["stages"].get(stage.replace(" ", "_"), {"work": []})["work"])
            ratios.append(f"{own.max() / own.mean():.2f}" if own.size and own.max() > 1e-3 else "")
        lines.append(f"| {run['case']}, {run['type']} | {run['cells']} | {run['ranks']} | {work.sum():.2f} | {work.max():.2f} | {work.max() / work.mean():.3f} | "
                     + " | ".join(ratios) + " |")
    return lines


def stage_tables(runs, ranks):
    lines = []
    for case in CASES:
        for mesh_type in TYPES:
            own = {run["ranks"]: run for run in runs if (run["case"], run["type"], run["size"]) == (case, mesh_type, SIZE)}
            lines += ["", f"{case}, {mesh_type}: CPU seconds of the slowest rank, in brackets of all ranks.", "",
                      "| stage | " + " | ".join(f"{n} rank{'s' * (n > 1)}" for n in ranks) + " |", "|---" * (1 + len(ranks)) + "|"]
            for stage in [name for name in own[ranks[0]]["stages"] if max(own[ranks[0]]["stages"][name]["work"]) > 1e-3]:
                cells = [own[n]["stages"][stage]["work"] for n in ranks]
                lines.append(f"| {stage.replace('_', ' ')} | " + " | ".join(f"{max(work):.3f} ({sum(work):.3f})" for work in cells) + " |")
    return lines


# The model: of each figure of the busiest rank a sum of terms with coefficients that are not negative.
TERMS = {
    "1": lambda cells, cut, ranks: 1.0,
    "cells of a rank": lambda cells, cut, ranks: cells / ranks,
    "cut cells of a rank": lambda cells, cut, ranks: cut / ranks,
    "cut cells": lambda cells, cut, ranks: cut,
    "root of cells": lambda cells, cut, ranks: cells**0.5 * (ranks > 1),
    "root of cells of a rank": lambda cells, cut, ranks: (cells / ranks)**0.5 * (ranks > 1),
    "neighbours": lambda cells, cut, ranks: float(min(ranks - 1, NEIGHBOURS)),
    "neighbours times root of cells of a rank": lambda cells, cut, ranks: min(ranks - 1, NEIGHBOURS) * (cells / ranks)**0.5,
    "other ranks": lambda cells, cut, ranks: float(ranks - 1),
    "ranks": lambda cells, cut, ranks: float(ranks),
    "log2 of ranks": lambda cells, cut, ranks: np.log2(ranks),
    "more than one rank": lambda cells, cut, ranks: float(ranks > 1),
}
FIGURES = {
    "partners": (lambda run: max(run["partners"]), ("other ranks",)),
    "CPU seconds": (lambda run: total(run, "work").max(), ("1", "cells of a rank", "cut cells of a rank", "cut cells", "ranks")),
    "messages": (lambda run: total(run, "messages").max(), ("1", "neighbours", "other ranks")),
    "bytes sent": (lambda run: total(run, "bytes").max(), ("1", "root of cells of a rank", "neighbours times root of cells of a rank", "other ranks")),
    "collectives": (lambda run: total(run, "collectives").max(), ("1", "more than one rank", "log2 of ranks", "ranks")),
    "bytes of collectives": (lambda run: total(run, "collective_bytes").max(), ("1", "more than one rank", "root of cells", "ranks")),
    "bytes of memory": (lambda run: max(run["peak"]), ("1", "cells of a rank", "cut cells", "ranks")),
}


def row_of(names, run):
    return np.array([TERMS[name](run["cells"], run["cut"], run["ranks"]) for name in names])


def fit(figure, names, runs):
    """Least squares of the relative deviations."""
    values = np.array([figure(run) for run in runs])
    rows = np.array([row_of(names, run) for run in runs]) / values[:, None]
    scale = np.linalg.norm(rows, axis=0)
    scale[scale == 0] = 1
    return nnls(rows / scale, np.ones(len(runs)))[0] / scale


def runs_of(name, runs):
    """Those that a figure is fitted to: one rank sends no messages, but to itself."""
    return [run for run in runs if run["ranks"] > 1 or name not in ("partners", "messages", "bytes sent")]


def model_tables(runs):
    airfoil = [run for run in runs if (run["case"], run["type"]) == ("naca0012", "hybrid")]
    fitted = [run for run in airfoil if (run["size"], run["ranks"]) in FITTED]
    others = [run for run in airfoil if (run["size"], run["ranks"]) in CHECKED]
    cut_of_cells = np.mean([run["cut"] / run["cells"]**0.5 for run in fitted])
    large = {"cells": LARGE[0], "cut": cut_of_cells * LARGE[0]**0.5, "ranks": LARGE[1]}
    sizes, ranks, cells = (sorted({run[key] for run in fitted}) for key in ("size", "ranks", "cells"))
    lines = ["", f"Fitted: the airfoil, hybrid, smoothed and written, spacings divided by {sizes}, on {ranks} ranks: {cells[0]} to {cells[-1]} cells. "
             "Figures of the busiest rank.", "",
             "| figure | model | largest deviation of the fit | " + " | ".join(f"{run['cells']} cells on {run['ranks']}: model, measured" for run in others) +
             f" | {LARGE[0]:.0e} cells on {LARGE[1]} |", "|---" * (4 + len(others)) + "|"]
    for name, (figure, terms) in FIGURES.items():
        own = runs_of(name, fitted)
        coefficients = fit(figure, terms, own)
        value = lambda run, used=coefficients, of=terms: float(row_of(of, run) @ used)
        worst = max((abs(value(run) / figure(run) - 1) for run in own))
        text = " + ".join(f"{c:.3g} x {term}" if term != "1" else f"{c:.3g}" for c, term in zip(coefficients, terms) if c > 0)
        checks = " | ".join(f"{value(run):.3g}, {figure(run):.3g}" for run in others)
        parts = row_of(terms, large) * coefficients
        lead = terms[int(np.argmax(parts))]
        share = f"{100 * parts.max() / parts.sum():.0f} % of it by \"{lead}\""
        lines.append(f"| {name} | {text} | {100 * worst:.0f} % | {checks} | {value(large):.3g}, {share} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2, 4, 8, 16])
    parser.add_argument("--save", type=Path)
    parser.add_argument("--from", dest="saved", type=Path)
    add_update(parser)
    args = parser.parse_args()
    if args.saved:
        kept = json.loads(args.saved.read_text())
    else:
        with tempfile.TemporaryDirectory() as folder:
            kept = {"machine": machine(), "runs": measure(args, build_counter(Path(folder)))}
    if args.save:
        args.save.write_text(json.dumps(kept))
    runs = kept["runs"]
    ranks = [n for n in args.ranks if any(run["ranks"] == n for run in runs)]
    tell("\n".join(["one run each.", *first_tables(runs, ranks), *stage_tables(runs, ranks), *balance_table(runs), *model_tables(runs)]), "scaling.py", args.update)


if __name__ == "__main__":
    os.environ.setdefault("OMPI_MCA_btl_vader_single_copy_mechanism", "none")
    main()
