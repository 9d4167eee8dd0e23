#!/usr/bin/env python3
"""How time and memory grow: with the cells, NACA 0012 with small cells in all of its far field (the case of bench.py), and with the segments of an
outline, a wavy circle in few cells. One rank. Each run is repeated, the sizes in turns; the median counts. Standard library only.

    growth.py --quadloop PROGRAM [--repeats N] [--finest F] [--most-segments N] [--update docs/performance.md] [--require]

--finest   the last of the powers of two that all spacings of the airfoil are divided by, from 1 on (16: from 72 thousand to 17 million cells)
--most-segments  of the outline (a million); the first has a thousandth of them
--update   puts the figures into the file, between this script's two markers
--require  exit status 1 where a goal is missed
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell

OUTLINE_CASE = '[geometry]\nfile = "outline.geom"\n[spacing]\nmin = 1.0\nmax = 5.0\n[smooth]\nsweeps = 0\n[output]\nformats = ["mesh"]\n'


@dataclass
class Run:
    size: int
    reading: float    # seconds of wall
    in_memory: float  # of all stages but reading and writing
    processor: float  # seconds of the whole process
    peak: int         # bytes
    cut_share: float  # of the leaves


def run_once(quadloop, case, settings, folder, segments=0):
    sets = [word for text in settings for word in ("--set", text)]
    command = [str(word) for word in (quadloop, "mesh", case, "-o", folder / "out", "--json", "-q", *sets)]
    with open(folder / "said.json", "w+", encoding="utf-8") as said:
        child = subprocess.Popen(command, stdout=said)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            sys.exit(" ".join(command))
        said.seek(0)
        record = json.load(said)
    seconds = {name: stage["slowest"] for name, stage in record["seconds"].items()}
    reading = seconds.pop("read")
    seconds.pop("write")
    return Run(segments or record["triangles"] + record["quads"], reading, sum(seconds.values()), usage.ru_utime + usage.ru_stime,
               usage.ru_maxrss * 1024, record["cut_leaves"] / record["leaves"])


def write_outline(path, segments):
    """Clockwise round the origin, in a square."""
    with open(path, "w", encoding="ascii") as file:
        file.write(f"2\nwall\n{segments}\n")
        for i in range(segments):
            angle = -2 * math.pi * i / segments
            radius = 1 + 0.1 * math.sin(50 * angle) + 1e-4 * math.sin(7001 * angle)
            file.write(f"{radius * math.cos(angle)!r} {radius * math.sin(angle)!r}\n")
        file.write("far\n4\n-5 -5\n5 -5\n5 5\n-5 5\n")


def medians(runs):
    fields = ("reading", "in_memory", "processor", "peak")
    return Run(runs[0].size, *(statistics.median(getattr(run, field) for run in runs) for field in fields), runs[0].cut_share)


def with_cells(quadloop, finest, repeats, folder):
    wanted = [2**k for k in range(finest.bit_length())]
    runs = {finer: [] for finer in wanted}
    for _ in range(repeats):
        for finer in wanted:
            settings = [*airfoil_options(finer), "smooth.sweeps=0", 'output.formats=["mesh"]']
            runs[finer].append(run_once(quadloop, AIRFOIL, settings, folder))
    return [medians(some) for some in runs.values()]


def with_segments(quadloop, most, repeats, folder):
    wanted = [most // 1000, most // 100, most // 10, most]
    runs = {segments: [] for segments in wanted}
    (folder / "case.toml").write_text(OUTLINE_CASE)
    for segments in wanted:
        write_outline(folder / "outline.geom", segments)
        for _ in range(repeats):
            runs[segments].append(run_once(quadloop, folder / "case.toml", [], folder, segments))
    return [medians(some) for some in runs.values()]


def beyond(runs, field):
    """What one more of the largest costs: the differences of the two largest sizes, so that what a process takes in any case does not count."""
    return (getattr(runs[-1], field) - getattr(runs[-2], field)) / (runs[-1].size - runs[-2].size)


def goals(cells, segments):
    """(what, figure, bound)"""
    per_cell = [run.in_memory / run.size for run in cells]
    read = [run.reading / run.size for run in segments[-2:]]
    return [("time per cell in memory, largest over smallest", max(per_cell) / min(per_cell), 1.2),
            ("bytes a cell more", beyond(cells, "peak"), 150),
            ("us of reading a segment", 1e6 * beyond(segments, "reading"), 0.2),
            ("reading a segment, the most over a tenth of them", read[1] / read[0], 1.2),
            ("bytes a segment more", beyond(segments, "peak"), 64)]


def report(cells, segments, repeats):
    lines = [f"median of {repeats} runs.", "", "| cells | us in memory a cell | us of the processor, all in all | bytes a cell | leaves cut |", "|---|---|---|---|---|"]
    lines += [f"| {run.size} | {1e6 * run.in_memory / run.size:.3f} | {1e6 * run.processor / run.size:.3f} | {run.peak / run.size:.0f} | {100 * run.cut_share:.2f} % |"
              for run in cells]
    lines += ["", "| segments | us of reading a segment | us in memory | us of the processor, all in all | bytes a segment |", "|---|---|---|---|---|"]
    lines += [f"| {run.size} | {1e6 * run.reading / run.size:.3f} | {1e6 * run.in_memory / run.size:.3f} | {1e6 * run.processor / run.size:.3f} | {run.peak / run.size:.0f} |"
              for run in segments]
    lines += ["", "| goal | figure | bound | |", "|---|---|---|---|"]
    lines += [f"| {what} | {figure:.3g} | <= {bound} | {'met' if figure <= bound else 'missed'} |" for what, figure, bound in goals(cells, segments)]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--finest", type=int, default=16)
    parser.add_argument("--most-segments", type=int, default=1000000)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_growth_") as name:
        cells = with_cells(args.quadloop.resolve(), args.finest, args.repeats, Path(name))
        segments = with_segments(args.quadloop.resolve(), args.most_segments, args.repeats, Path(name))
    tell(report(cells, segments, args.repeats), "growth.py", args.update)
    return 1 if args.require and any(figure > bound for _, figure, bound in goals(cells, segments)) else 0


if __name__ == "__main__":
    sys.exit(main())
