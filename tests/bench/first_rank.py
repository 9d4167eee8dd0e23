#!/usr/bin/env python3
"""Which memory the first rank needs beside the others, in each command. Standard library only.

    first_rank.py --quadloop PROGRAM [--ranks N ...] [--finer F] [--update docs/performance.md] [--require]

The figures are the largest resident memory of each rank's process, one run each.

--finer    divides every spacing of the case cases/naca0012 (4: a million cells)
--require  exit status 1 where the first rank needs more than a tenth above the mean of the others
"""
import argparse
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import AIRFOIL, airfoil_options
from figures import add_update, tell

ROOT = Path(__file__).resolve().parents[2]
FLOW = ["--set", "solver.mach=0.3", "solver.iterations=1"]
COMMANDS = {
    "mesh": ["mesh", AIRFOIL, "-o", "new", "--set", 'output.formats=["mesh","cgns"]'],
    "smooth": ["smooth", "a.mesh", "-o", "new.mesh", "--sweeps", "1"],
    "solve": ["solve", AIRFOIL, "a.mesh", "-o", "new.mesh", *FLOW],
    "remesh": ["remesh", AIRFOIL, "--tree", "a.tree.h5", "--solution", "s.mesh", "-o", "new", "--set", "adapt.variable=\"density\""],
    "convert to .qmesh": ["convert", "a.mesh", "new.qmesh"],
    "convert from .qmesh to .vtu": ["convert", "a.qmesh", "new.vtu"],
    "convert from .cgns": ["convert", "a.cgns", "new.mesh"],
    "convert from .su2": ["convert", "a.su2", "new.mesh"],
    "convert from .vtu": ["convert", "a.vtu", "new.mesh"],
    "extrude to .vtu": ["extrude", "a.mesh", "-o", "new.vtu", "--layers", "2", "--thickness", "1"],
    "morph": ["morph", "a.mesh", "--geometry", "a.geom", "--from", "a.geom", "-o", "new.mesh"],
    "check": ["check", "a.mesh"],
    "plot": ["plot", "a.mesh", "-o", "new.png"],
}


def as_rank(folder, *command):
    """One rank: runs the program; notes its output and its largest memory in the folder."""
    rank = int(os.environ.get("OMPI_COMM_WORLD_RANK", "0"))
    with open(Path(folder) / f"{rank:06}.out", "w", encoding="utf-8") as output:
        status = subprocess.call(command, stdout=output)
    (Path(folder) / f"{rank:06}.kib").write_text(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))
    return status


def options_of(name, arguments, finer):
    takes_case = str(AIRFOIL) in map(str, arguments)
    return [*arguments, "-q", *(word for text in (airfoil_options(finer) if takes_case else []) for word in ("--set", text))]


def memory(quadloop, arguments, ranks, folder):
    """MiB of each rank, and what the first one printed."""
    with tempfile.TemporaryDirectory() as notes:
        program = [ROOT / "scripts" / "mpirun", "-n", ranks, sys.executable, "-B", __file__, "--as-rank", notes, quadloop, *arguments]
        done = subprocess.run([str(word) for word in program], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        mebibytes = [int(note.read_text()) / 1024 for note in sorted(Path(notes).glob("*.kib"))]
        return mebibytes, (Path(notes) / "000000.out").read_text()


def prepare(args, folder):
    """The mesh as a.*, its geometry, and a solution on it."""
    def run(name, *arguments):
        subprocess.run([str(word) for word in (args.quadloop, *options_of(name, arguments, args.finer))], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    run("mesh", "mesh", AIRFOIL, "-o", "a", "--geometry-out", "a.geom", "--set", 'output.formats=["mesh","qmesh","cgns","su2","vtu"]')
    run("solve", "solve", AIRFOIL, "a.mesh", "-o", "s.mesh", *FLOW)


def main():
    if sys.argv[1:2] == ["--as-rank"]:
        return as_rank(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--ranks", type=int, nargs="+", default=[4, 16])
    parser.add_argument("--finer", type=float, default=4)
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    rows, missed = [], False
    with tempfile.TemporaryDirectory(prefix="quadloop_bench_first_rank_") as folder:
        prepare(args, folder)
        for name, arguments in COMMANDS.items():
            row = [name]
            for ranks in args.ranks:
                (first, *others), _ = memory(args.quadloop, options_of(name, arguments, args.finer), ranks, folder)
                mean = sum(others) / len(others)
                missed |= first > 1.1 * mean
                row += [f"{first:.0f}", f"{mean:.0f}", f"{100 * (first / mean - 1):+.0f} %"]
            rows.append("| " + " | ".join(row) + " |")
            print(rows[-1], file=sys.stderr, flush=True)
    head = [f"{ranks} ranks: {what}" if what == "first" else what for ranks in args.ranks for what in ("first", "mean of the others", "difference")]
    tell("\n".join([f"one run each, MiB. A mesh of a million cells (`--finer {args.finer:g}`).", "", "| command | " + " | ".join(head) + " |", "|---" * (1 + len(head)) + "|",
                    *rows, "", "Goal: the first rank needs at most 10 % more than the others."]), "first_rank.py", args.update)
    return 1 if args.require and missed else 0


if __name__ == "__main__":
    sys.exit(main())
