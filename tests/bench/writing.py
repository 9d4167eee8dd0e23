#!/usr/bin/env python3
"""Time and bytes of each rank when a mesh of some million cells is written, for each format. Standard library only.

    writing.py --quadloop PROGRAM [--before PROGRAM] [--repeats N] [--ranks N ...] [--finer F] [--formats NAME ...] [--update docs/performance.md]

Each figure is that of `quadloop mesh` with the format less that of a run that writes only the tree file, medians of both. Seconds are those of the stage "write";
the first number of ranks is the one that others are compared with. Processor time is that of the busiest rank, user and system; MPI's waiting is in it, so that
runs beside other programs differ. Bytes are those that a rank passed to write(2) and pwrite(2).

--before   an earlier program, measured in turn with the other one
--finer    divides every spacing of the case cases/naca0012 (6: two million cells)
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell

ROOT = Path(__file__).resolve().parents[2]
FORMATS = ("mesh", "qmesh", "vtu", "vtkhdf", "su2", "msh", "cgns")
NONE = "csv"  # has no mesh: only the tree is written


def as_rank(report, *command):
    """Runs a rank's program; writes its processor time and bytes to the file `report` with the rank's process number."""
    child = subprocess.Popen(command)
    os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
    counted = dict(line.split(": ") for line in Path(f"/proc/{child.pid}/io").read_text().splitlines())
    status = child.wait()
    usage = os.times()
    Path(f"{report}.{os.getpid()}").write_text(json.dumps({"processor": usage.children_user + usage.children_system, "bytes": int(counted["wchar"])}))
    return status


def run_once(program, name, ranks, finer, folder):
    """Seconds of the stage "write", processor seconds of the busiest rank, the largest and the sum of the ranks' bytes, and the number of cells."""
    for file in folder.iterdir():
        file.unlink()
    launcher = [ROOT / "scripts" / "mpirun", "-n", str(ranks)] if ranks > 1 else []
    sets = [word for text in [*airfoil_options(finer), "smooth.sweeps=0", f'output.formats=["{name}"]'] for word in ("--set", text)]
    command = [sys.executable, "-B", __file__, "--as-rank", folder / "rank", program, "mesh", AIRFOIL, "-o", folder / "a", "--json", "-q", *sets]
    done = subprocess.run([str(word) for word in [*launcher, *command]], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    said = json.loads(done.stdout)
    reports = [json.loads(file.read_text()) for file in folder.glob("rank.*")]
    written = [report["bytes"] for report in reports]
    processor = max(report["processor"] for report in reports)
    return said["seconds"]["write"]["slowest"], processor, max(written), sum(written), said["triangles"] + said["quads"]


def measure(args, program, ranks, folder):
    """Medians for each format, and of the run without, which is the first."""
    runs = {name: [] for name in (NONE, *args.formats)}
    for _ in range(args.repeats):
        for name, results in runs.items():
            results.append(run_once(program, name, ranks, args.finer, folder))
    return {name: [statistics.median(values) for values in zip(*results)] for name, results in runs.items()}


def main():
    if sys.argv[1:2] == ["--as-rank"]:
        return as_rank(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--before", type=lambda text: Path(text).resolve())
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--finer", type=float, default=6)
    parser.add_argument("--formats", nargs="+", default=FORMATS)
    add_update(parser)
    args = parser.parse_args()
    rows, cells, alone = [], 0, {}
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_writing_") as folder:
        for ranks in args.ranks:
            for label, program in (("before", args.before), ("now", args.quadloop)):
                if program is None:
                    continue
                medians = measure(args, program, ranks, Path(folder))
                for name in args.formats:
                    *figures, cells = (value - none for value, none in zip(medians[name], [*medians[NONE][:4], 0]))
                    seconds, processor, most, all_bytes = figures
                    faster = alone.setdefault((name, label), seconds) / seconds
                    rows.append(f"| `.{name}` | {ranks} | {label} | {seconds:.2f} | {faster:.2f} | {processor:.2f} | {most / 1e6:.0f} | {all_bytes / 1e6:.0f} |")
                    print(rows[-1], file=sys.stderr, flush=True)
    tell("\n".join([f"{cells / 1e6:.2f} million cells, median of {args.repeats} runs.", "",
                    f"| format | ranks | program | s | times as fast as {args.ranks[0]} | s of the busiest rank's processor | most MB written by a rank | MB written by all |",
                    "|---|---|---|---|---|---|---|---|", *rows]), "writing.py", args.update)
    return 0


if __name__ == "__main__":
    sys.exit(main())
