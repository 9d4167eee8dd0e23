#!/usr/bin/env python3
"""How fast a plane mesh of about a million cells is drawn out to 10 layers, into each binary format, and with how much memory on any rank. Standard library only.

    extrude.py --quadloop PROGRAM [--repeats N] [--ranks N ...] [--finer F] [--update docs/performance.md] [--require]

The rate is 3D cells by the seconds of the whole run, reading included. Memory is what each rank holds at most: of the whole run, reading included, above the
program (which draws out a tiny mesh) and the plane mesh, which the first rank reads whole; and what writing adds to what was held when it began.

--finer    divides every spacing of the case cases/naca0012 (4: a million cells)
--require  exit status 1 where a goal is missed
"""
import argparse
import json
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

ROOT = Path(__file__).resolve().parents[2]
LAYERS, FORMATS = 10, ("lb8.ugrid", "vtu", "cgns")
LEAST_RATE, MOST_ABOVE = 1e6, 64 * 2**20


@dataclass
class Run:
    cells: int
    seconds: float    # of the clock
    processor: float  # seconds of the busiest rank's processor time
    peak: int         # bytes that a rank held at most
    writing: int      # bytes that a rank held at most while it wrote, above what it held before
    plane: int        # bytes of the plane mesh


def memory_of(process, key):
    """Bytes; 0 once the process has ended."""
    try:
        for line in Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith(key):
                return int(line.split()[1]) * 1024
    except OSError:
        pass
    return 0


def as_rank(report, *command):
    """Runs a rank's program and writes what it held, looked at every few milliseconds, to the file `report` with the rank's process number."""
    folder = Path(report).parent
    child = subprocess.Popen(command)
    peak, before, most = 0, 0, 0
    while child.poll() is None:
        now, peak = memory_of(child.pid, "VmRSS"), max(peak, memory_of(child.pid, "VmHWM"))
        before = before or (now if any(folder.glob(".quadloop-*.part")) else 0)
        most = max(most, now) if before else 0
        time.sleep(0.002)
    usage = os.times()
    Path(f"{report}.{os.getpid()}").write_text(json.dumps(
        {"status": child.returncode, "processor": usage.children_user + usage.children_system, "peak": peak, "writing": most - before}))
    return child.returncode


def run_once(quadloop, mesh, suffix, ranks, folder):
    for file in folder.iterdir():
        file.unlink()
    launcher = [ROOT / "scripts" / "mpirun", "-n", str(ranks)] if ranks > 1 else []
    program = [sys.executable, "-B", __file__, "--as-rank", folder / "rank", quadloop, "extrude", mesh, "-o", folder / f"a.{suffix}",
               "--layers", str(LAYERS), "--thickness", "1", "--json", "-q"]
    began = time.perf_counter()
    done = subprocess.run([str(word) for word in [*launcher, *program]], capture_output=True, text=True)
    seconds = time.perf_counter() - began
    if done.returncode != 0:
        sys.exit(done.stderr)
    said = json.loads(done.stdout)
    reports = [json.loads(file.read_text()) for file in folder.glob("rank.*")]
    most = {key: max(report[key] for report in reports) for key in ("processor", "peak", "writing")}
    plane = 16 * said["nodes"] // (LAYERS + 1) + (12 * said["prisms"] + 16 * said["hexahedra"]) // LAYERS
    return Run(said["prisms"] + said["hexahedra"], seconds, most["processor"], most["peak"], most["writing"], plane)


def plane_mesh(quadloop, folder, name, finer):
    sets = [word for text in [*airfoil_options(finer), 'output.formats=["mesh"]'] for word in ("--set", text)]
    subprocess.run([str(word) for word in (quadloop, "mesh", AIRFOIL, "-o", folder / name, "-q", *sets)], check=True)
    return folder / f"{name}.mesh"


def measure(args, folder):
    mesh, tiny = plane_mesh(args.quadloop, folder, "plane", args.finer), plane_mesh(args.quadloop, folder, "tiny", 0.05)
    (folder / "out").mkdir()
    for ranks in args.ranks:
        for suffix in FORMATS:
            program = run_once(args.quadloop, tiny, suffix, ranks, folder / "out").peak
            runs = [run_once(args.quadloop, mesh, suffix, ranks, folder / "out") for _ in range(args.repeats)]
            median = lambda key: statistics.median(getattr(run, key) for run in runs)
            yield suffix, ranks, runs[0].cells, median("seconds"), median("processor"), median("peak"), median("peak") - program - runs[0].plane, median("writing")


def main():
    if sys.argv[1:2] == ["--as-rank"]:
        return as_rank(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--finer", type=float, default=4)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    rows, missed = [], False
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_extrude_") as folder:
        for suffix, ranks, cells, seconds, processor, peak, above, writing in measure(args, Path(folder)):
            missed |= cells < LEAST_RATE * seconds or above > MOST_ABOVE
            rows.append(f"| `.{suffix}` | {ranks} | {cells} | {seconds:.2f} | {cells / seconds / 1e6:.2f} | {processor:.2f} | {peak / 2**20:.0f} | {above / 2**20:.0f} | {writing / 2**20:.1f} |")
            print(rows[-1], file=sys.stderr, flush=True)
    tell("\n".join([f"median of {args.repeats} runs.", "",
                    "| format | ranks | 3D cells | s | million cells/s | s of the busiest rank's processor | most MiB on a rank | above program and mesh | added by writing |",
                    "|---|---|---|---|---|---|---|---|---|", *rows, "",
                    f"Goals: {LEAST_RATE / 1e6:g} million cells/s, at most {MOST_ABOVE >> 20} MiB above program and mesh."]), "extrude.py", args.update)
    return 1 if args.require and missed else 0


if __name__ == "__main__":
    sys.exit(main())
