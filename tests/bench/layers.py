#!/usr/bin/env python3
"""What layers cost: time and memory of a mesh with layers over those of a mesh without, of as many cells as the first has outside its layers; whole
processes, medians, the two run in turn. Standard library only.

    layers.py --quadloop PROGRAM [--repeats N] [--case FILE ...] [--update docs/performance.md] [--require]

--require  exit status 1 where a ratio of times is above 1.3
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

from figures import add_update, tell

ROOT = Path(__file__).resolve().parents[2]
CASES = [ROOT / "cases" / name / "case.toml" for name in ("naca0012_layers", "three_element_layers", "flat_plate")]
LARGEST_RATIO, EQUAL, MOST_TRIALS = 1.3, 0.02, 12


@dataclass
class Run:
    seconds: float    # from start to end
    stages: float     # the sum of its stages: without the start of MPI
    peak: int         # bytes
    said: dict


def run_once(quadloop, case, folder):
    command = [str(quadloop), "mesh", str(case), "-o", str(Path(folder) / "out"), "--json"]
    began = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said, complaints = child.stdout.read(), child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.perf_counter() - began
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{complaints}")
    return Run(seconds, sum(stage["slowest"] for stage in json.loads(said)["seconds"].values()), usage.ru_maxrss * 1024, json.loads(said))


def without_layers(case, folder, factor):
    """The case as a file in the folder, without its layers; spacings along the walls that had them are so many times those of the case."""
    text = case.read_text()
    tables = tomllib.loads(text)
    for name, table in tables["boundary"].items():
        if "layers" not in table:
            continue
        wanted = factor * table.get("spacing", tables["spacing"]["min"])
        block = re.search(rf'^\[boundary\."?{re.escape(name)}"?\].*\n[^\[]*', text, re.M)[0]
        plain = re.sub(r"^(layers|spacing) *=.*\n", "", block, flags=re.M).rstrip("\n")
        text = text.replace(block, f"{plain}\nspacing = {wanted!r}\n\n")
    text = re.sub(r'^file *= *"(.*)"', lambda found: f'file = "{case.parent / found[1]}"', text, flags=re.M)
    path = Path(folder) / "plain.toml"
    path.write_text(text)
    return path


def cells_of(run):
    return run.said["triangles"] + run.said["quads"]


def plain_of_equal_cells(quadloop, case, folder, cells):
    """The case without layers whose cells are nearest to so many; leaves come in powers of two, so it may not reach them."""
    low, high, best = 0.02, 4.0, None
    for _ in range(MOST_TRIALS):
        factor = (low * high) ** 0.5
        found = cells_of(run_once(quadloop, without_layers(case, folder, factor), folder))
        if best is None or abs(found - cells) < abs(best[1] - cells):
            best = (factor, found)
        if abs(found - cells) <= EQUAL * cells:
            break
        low, high = (factor, high) if found > cells else (low, factor)
    return without_layers(case, folder, best[0])


def measure(quadloop, case, repeats):
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_layers_") as folder:
        first = run_once(quadloop, case, folder)
        plain = plain_of_equal_cells(quadloop, case, folder, first.said["outer_cells"])
        pairs = [(run_once(quadloop, case, folder), run_once(quadloop, plain, folder)) for _ in range(repeats)]
    median = lambda which, key: statistics.median(getattr(pair[which], key) for pair in pairs)
    figures = {key: (median(0, key), median(1, key)) for key in ("seconds", "stages", "peak")}
    stages = {name: statistics.median(pair[0].said["seconds"][name]["slowest"] for pair in pairs) for name in pairs[0][0].said["seconds"]}
    return pairs[0][0].said, cells_of(pairs[0][1]), figures, stages


def row_of(case, said, plain_cells, figures):
    (layered, plain), (stages, stages_plain), (peak, peak_plain) = figures["seconds"], figures["stages"], figures["peak"]
    return (f"| {case.parent.name} | {said['layer_cells']} | {said['outer_cells']} | {plain_cells} | {layered:.2f} | {plain:.2f} | {layered / plain:.2f} | "
            f"{stages / stages_plain:.2f} | {peak / peak_plain:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--case", nargs="+", type=Path, default=CASES)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    rows, missed = [], False
    for case in args.case:
        case = case.resolve()
        said, plain_cells, figures, stages = measure(args.quadloop, case, args.repeats)
        missed |= figures["seconds"][0] > LARGEST_RATIO * figures["seconds"][1]
        rows.append(row_of(case, said, plain_cells, figures))
        print(rows[-1], {name: round(seconds, 3) for name, seconds in stages.items()}, file=sys.stderr, flush=True)
    tell("\n".join([f"median of {args.repeats} runs.", "",
                    "| case | cells in layers | outside | cells without layers | s | s without | ratio | of the stages | of peak memory |",
                    "|---|---|---|---|---|---|---|---|---|", *rows, "", f"Goal: a ratio of at most {LARGEST_RATIO}."]), "layers.py", args.update)
    return 1 if args.require and missed else 0


if __name__ == "__main__":
    sys.exit(main())
