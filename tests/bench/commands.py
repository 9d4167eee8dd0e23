#!/usr/bin/env python3
"""What the commands beside `mesh` take: start-up, and `check`, `smooth` and `convert` on a Delaunay mesh of an airfoil with two million triangles, with
their files, on one rank. Each is repeated, all of them in turns; the median counts. Standard library only.

    commands.py --quadloop PROGRAM [--repeats N] [--cells N] [--update docs/performance.md] [--require]

--update   puts the figures into the file, between this script's two markers
--require  exit status 1 where a goal is missed
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell


@dataclass
class Task:
    name: str
    words: list      # of the command
    most: float      # goal: seconds of wall; none: 0
    rows: float = 0  # goal: million rows of text a second of wall


@dataclass
class Took:
    wall: float       # seconds
    processor: float  # seconds, the system's too
    peak: int         # bytes


def tasks(mesh, folder):
    return [
        Task("start-up (`--version`)", ["--version"], 0.03),
        Task("`check`", ["check", mesh], 0.9),
        Task("`smooth` what is not smoothed yet", ["smooth", mesh, "-o", folder / "smoothed.qmesh"], 3.5),
        Task("`convert`, `.qmesh` to `.qmesh`", ["convert", mesh, folder / "copy.qmesh"], 0),
        Task("`convert`, `.qmesh` to `.vtu`", ["convert", mesh, folder / "copy.vtu"], 0),
        Task("`convert`, `.qmesh` to `.mesh` (text)", ["convert", mesh, folder / "copy.mesh"], 0, 2),
        Task("`convert`, `.mesh` (text) to `.qmesh`", ["convert", folder / "copy.mesh", folder / "copy.qmesh"], 0, 2),
    ]


def run(words):
    words = [str(word) for word in words]
    began = time.perf_counter()
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    complaints = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.perf_counter() - began
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{complaints}")
    return Took(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def make_mesh(quadloop, cells, folder):
    """About so many triangles, as they are cut."""
    finer = (cells / 128e3) ** 0.5
    sets = [word for text in [*airfoil_options(finer), 'mesh.type="delaunay"', "smooth.sweeps=0", 'output.formats=["qmesh"]'] for word in ("--set", text)]
    run([quadloop, "mesh", AIRFOIL, "-o", folder / "mesh", "-q", *sets])
    return folder / "mesh.qmesh"


def rows_of(text_file):
    with open(text_file, "rb") as file:
        return sum(part.count(b"\n") for part in iter(lambda: file.read(1 << 20), b""))


def median_of(runs):
    return Took(*(statistics.median(getattr(each, field) for each in runs) for field in ("wall", "processor", "peak")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--cells", type=int, default=2_000_000)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    lines, missed = [], False
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_commands_") as name:
        folder = Path(name)
        mesh = make_mesh(args.quadloop, args.cells, folder)
        all_tasks = tasks(mesh, folder)
        runs = [[] for _ in all_tasks]
        for _ in range(args.repeats):
            for task, own in zip(all_tasks, runs):
                own.append(run([args.quadloop, *task.words]))
        rows = rows_of(folder / "copy.mesh") / 1e6
        for task, took in zip(all_tasks, map(median_of, runs)):
            most = task.most or (rows / task.rows if task.rows else 0)
            missed |= 0 < most < took.wall
            goal = f"{most:.2g}" if most else ""
            lines.append(f"| {task.name} | {took.wall:.3f} | {took.processor:.3f} | {took.peak / 2**20:.0f} | {goal} |")
    tell("\n".join([f"medians of {args.repeats} runs in turns; {rows:.2f} million rows in the text file.", "",
                    "| command | s of wall | s of the processor | MiB | goal, s of wall |", "|---|---|---|---|---|", *lines]), "commands.py", args.update)
    return 1 if args.require and missed else 0


if __name__ == "__main__":
    sys.exit(main())
