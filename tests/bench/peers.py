#!/usr/bin/python3 -B
"""quadloop beside other mesh generators on the same outlines, in turns, one after another: Triangle, Gmsh, MMG2D and BAMG, whichever are on the PATH
(`triangle`, `gmsh`, `mmg2d_O3`, `ffbamg` or `bamg`). Needs numpy.

    peers.py --quadloop PROGRAM [--cells N] [--repeats N] [--cases A B gulf] [--sized PROGRAM] [--timeout S] [--update docs/performance.md]

A       cases/naca0012, small cells in all of its far field
B       the same airfoil, cells that grow by 0.3 of the distance from the wall: most of them near it
gulf    the coast of cases/gulf_of_mexico: the others from the outline's vertices alone, quadloop with sizes as fine
--cells    about how many triangles in A (within a factor of two) and B; the coast of the Gulf is the high one from 500 thousand on, the medium one from 100 thousand on
--sized    Triangle built for B with the size function of airfoil_size.c, which stands in that file; without one it gets no sizes there
--timeout  seconds for one run (60); a program that takes longer is left out of that case, and its row says so
--update   puts the figures into the file, between this script's two markers

Kernel is what each program says of itself, without reading and writing files (BAMG, which says nothing, has none): Triangle's and Gmsh's own clocks,
quadloop's stages, smoothing among them. Process is the processor's time of all, files too; wall is the clock's. Ratios are times per triangle over
those of quadloop's smoothed mesh; a program that takes twenty times as long as it in a case runs once there. Quality is 4 sqrt(3) area over the sum of squared edges, over all triangles, by this script for all programs alike.
"""
import argparse
import json
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bench import wall_options
from figures import add_update, tell
from peer_files import FAR, SLOPE, Task, read_medit, read_msh, read_qmesh, read_triangle, split_loops, write_geo, write_medit, write_poly

ROOT = Path(__file__).resolve().parents[2]
AIRFOIL = ROOT / "cases" / "naca0012" / "case.toml"
GULF = ROOT / "cases" / "gulf_of_mexico"
TOO_SLOW = 20  # times quadloop's seconds: not repeated


@dataclass
class Run:
    kernel: float  # seconds, nan where the program does not say
    process: float
    wall: float
    peak: int      # bytes
    points: np.ndarray
    triangles: np.ndarray


def read_geom(path):
    """Loops of a .geom file, open chains joined end to end."""
    rows = iter([line for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")])
    closed, chains = [], []
    for _ in range(int(next(rows))):
        is_open = next(rows).split()[-1] == "open"
        points = np.array([next(rows).replace(",", " ").split() for _ in range(int(next(rows)))], dtype=float)
        (chains if is_open else closed).append(points)
    while chains:
        loop = chains.pop(0)
        while (loop[0] != loop[-1]).any():
            following = next(i for i, chain in enumerate(chains) if (chain[0] == loop[-1]).all())
            loop = np.vstack([loop, chains.pop(following)[1:]])
        closed.append(loop[:-1])
    return closed


def airfoil_loops():
    body = read_geom(AIRFOIL.parent / "naca0012.geom")
    centre = (np.min(body[0], axis=0) + np.max(body[0], axis=0)) / 2
    return [*body, centre + FAR * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])]


def task_named(name, cells):
    if name == "A":
        finer = 2.0 ** round(np.log2(cells / 135000) / 2)  # leaves halve; so many triangles where finer = 1
        values = {"spacing.min": 0.002, "spacing.max": 0.08, "boundary.airfoil.spacing": 0.005}
        return Task(name, AIRFOIL, [f"{key}={value / finer!r}" for key, value in values.items()], airfoil_loops(), 0.08 / finer * 1.2, cells)
    if name == "B":
        wall = 16.0 / cells
        return Task(name, AIRFOIL, wall_options(cells, SLOPE), airfoil_loops(), 0.0, cells, wall)
    size = "high" if cells >= 500000 else "medium" if cells >= 100000 else "coarse"
    case = GULF / ("case.toml" if size == "coarse" else f"{size}.toml")
    return Task(f"gulf {size}", case, [], read_geom(GULF / f"gulf_of_mexico_{size}.geom"), 0.0, cells)


# A process counts what its parent held when it was started among its own memory at most; so a small one starts it, and tells in a file how it went.
STARTER = """
import os, sys, time
begin = time.monotonic()
_, status, usage = os.wait4(os.spawnvp(os.P_NOWAIT, sys.argv[2], sys.argv[2:]), 0)
print(os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss * 1024, file=open(sys.argv[1], "w"))
"""


class TooLong(Exception):
    """A run that was broken off."""


def timed(command, folder, timeout):
    """Its output, processor and wall seconds, and bytes at most; none where it fails."""
    starter = [sys.executable, "-I", "-S", "-c", STARTER, folder / "took.txt", *command]
    with open(folder / "said.txt", "w+", encoding="utf-8", errors="replace") as said:
        child = subprocess.Popen([str(word) for word in starter], cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            child.wait(timeout)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            raise TooLong from None
        said.seek(0)
        text = said.read()
    status, process, wall, peak = (folder / "took.txt").read_text().split()
    if int(status) != 0:
        print(f"{Path(str(command[0])).name}: {' '.join(re.findall('.*rror.*', text)[:3]) or text[-400:]}", file=sys.stderr)
        return None
    return text, float(process), float(wall), int(peak)


def first_number(pattern, text):
    found = re.search(pattern, text)
    return float(found[1]) if found else float("nan")


# --- programs

def run_quadloop(program, task, folder, timeout, sweeps):
    sets = [word for text in [*task.settings, 'output.formats=["qmesh"]', 'mesh.type="delaunay"', *sweeps] for word in ("--set", text)]
    done = timed([program, "mesh", task.case, "-o", "out", "--json", "-q", *sets], folder, timeout)
    if done is None:
        return None
    text, process, wall, peak = done
    seconds = json.loads(text[text.index("{"):])["seconds"]
    kernel = sum(stage["slowest"] for name, stage in seconds.items() if name not in ("read", "write"))
    return Run(kernel, process, wall, peak, *read_qmesh(folder / "out.qmesh"))


def run_triangle(program, task, folder, timeout, _):
    write_poly(folder / "t.poly", task.loops)
    sized = task.wall > 0 and "sized" in program.name
    area = f"a{np.sqrt(3) / 4 * task.largest**2:.17f}" if task.largest > 0 else ""
    done = timed([program, f"-pq30{'u' if sized else ''}{area}jz", "t.poly"], folder, timeout)
    if done is None:
        return None
    text, process, wall, peak = done
    stages = ("Delaunay", "Segment", "Hole", "Quality")
    milliseconds = [first_number(rf"{stage} milliseconds: +([\d.]+)", text) for stage in stages]
    return Run(np.nansum(milliseconds) / 1000, process, wall, peak, *read_triangle(folder / "t.1"))


def run_gmsh(program, task, folder, timeout, _):
    write_geo(folder / "g.geo", task)
    done = timed([program, "-2", "-v", "5", "-nopopup", "-o", "g.msh", "g.geo"], folder, timeout)
    if done is None:
        return None
    text, process, wall, peak = done
    kernel = first_number(r"Done meshing 1D \(Wall ([\d.e+-]+)s", text) + first_number(r"Done meshing 2D \(Wall ([\d.e+-]+)s", text)
    return Run(kernel, process, wall, peak, *read_msh(folder / "g.msh"))


def run_mmg(program, task, folder, timeout, _):
    write_medit(folder / "m.mesh", split_loops(task), False)
    largest = task.largest or task.wall + SLOPE * FAR
    sizes = ["-hgrad", str(1 + SLOPE), *(["-hmax", repr(largest)] if task.largest or task.wall else [])]
    done = timed([program, "-in", "m.mesh", "-out", "n.mesh", "-nr", *sizes], folder, timeout)
    if done is None:
        return None
    text, process, wall, peak = done
    kernel = sum(map(float, re.findall(r"PHASE \d COMPLETED\. +([\d.]+)s", text))) or float("nan")
    return Run(kernel, process, wall, peak, *read_medit(folder / "n.mesh"))


def run_bamg(program, task, folder, timeout, _):
    write_medit(folder / "b.msh", split_loops(task), True)
    done = timed([program, "-g", "b.msh", "-o", "c.mesh", "-nbv", str(max(100000, 4 * task.cells)), "-ratio", str(1 + SLOPE)], folder, timeout)
    if done is None:
        return None
    _, process, wall, peak = done
    return Run(float("nan"), process, wall, peak, *read_medit(folder / "c.mesh"))


def programs(args):
    """{name: (how it is run, its program, what is passed on)}, quadloop's smoothed mesh first: the others are measured by it."""
    ours = args.quadloop.resolve()
    found = {"quadloop, smoothed": (run_quadloop, ours, []), "quadloop, cut": (run_quadloop, ours, ["smooth.sweeps=0"])}
    for name, run, words in (("Triangle", run_triangle, ("triangle",)), ("Gmsh", run_gmsh, ("gmsh",)), ("MMG2D", run_mmg, ("mmg2d_O3", "mmg2d")),
                             ("BAMG", run_bamg, ("ffbamg", "bamg"))):
        program = next(filter(None, map(shutil.which, words)), None)
        if program:
            found[name] = (run, Path(program), None)
    if args.sized:
        found["Triangle, sized"] = (run_triangle, args.sized.resolve(), None)
    return found


# --- figures

def shape_of(run):
    """Smallest angle in degrees; mean and 1 % quality."""
    corners = run.points[run.triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    squared = (sides**2).sum(axis=2)
    area = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]) / 2
    quality = 4 * np.sqrt(3) * area / squared.sum(axis=1)
    shortest = squared.min(axis=1)
    sine = 2 * area / np.sqrt(squared.prod(axis=1) / shortest)  # between the two longer sides lies the smallest angle
    return np.degrees(np.arcsin(np.clip(sine, 0, 1))).min(), quality.mean(), np.quantile(quality, 0.01)


def measure(task, found, args):
    """{name: its runs}, in turns, and the names of those that took too long; a program that fails once is left out."""
    runs, too_long = {name: [] for name in found}, []
    with tempfile.TemporaryDirectory(prefix="quadloop_peers_") as folder:
        for repeat in range(args.repeats):
            for name in list(runs):
                start, program, more = found[name]
                if repeat > 0 and runs[name][0].wall > TOO_SLOW * next(iter(runs.values()))[0].wall:
                    continue
                try:
                    run = start(program, task, Path(folder), args.timeout, more)
                except TooLong:
                    run = None
                    too_long.append(name)
                if run is None:
                    del runs[name]
                else:
                    runs[name].append(run)
    return runs, too_long


def rows_of(task, runs, too_long, timeout):
    def per_triangle(some, field):
        return statistics.median(getattr(run, field) for run in some) / len(some[0].triangles)
    ours = next((some for name, some in runs.items() if name == "quadloop, smoothed"), None)
    rows = []
    for name, some in runs.items():
        kernel, process, wall, peak = (per_triangle(some, field) for field in ("kernel", "process", "wall", "peak"))
        ratios = [here / per_triangle(ours, field) if ours else float("nan") for here, field in ((kernel, "kernel"), (wall, "wall"))]
        angle, mean, worst = shape_of(some[0])
        texts = [f"{value:.{digits}f}" if value == value else ""
                 for value, digits in ((1e6 * kernel, 2), (ratios[0], 2), (1e6 * process, 2), (1e6 * wall, 2), (ratios[1], 2), (peak, 0), (angle, 1), (mean, 3), (worst, 3))]
        rows.append(f"| {task.name} | {name} | {len(some[0].triangles)} | {' | '.join(texts)} |")
    return rows + [f"| {task.name} | {name} | more than {timeout:g} s |{' |' * 9}" for name in too_long]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=Path)
    parser.add_argument("--cells", type=int, default=1000000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--cases", nargs="+", choices=("A", "B", "gulf"), default=["A", "B", "gulf"])
    parser.add_argument("--sized", type=Path)
    parser.add_argument("--timeout", type=float, default=60)
    add_update(parser)
    args = parser.parse_args()
    found = programs(args)
    lines = [f"medians of {args.repeats} runs in turns.", "",
             "| case | program | triangles | us of kernel a triangle | over quadloop's | us of the processor | us of wall | over quadloop's | bytes | smallest angle | mean quality | 1 % |",
             "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for name in args.cases:
        task = task_named(name, args.cells)
        if args.sized and task.wall > 0:
            os.environ["AIRFOIL_SIZE"] = repr(task.wall)
        of_case = {key: value for key, value in found.items() if key != "Triangle, sized" or task.wall > 0}
        rows = rows_of(task, *measure(task, of_case, args), args.timeout)
        print("\n".join(rows), file=sys.stderr, flush=True)
        lines += rows
    tell("\n".join(lines), "peers.py", args.update)


if __name__ == "__main__":
    main()
