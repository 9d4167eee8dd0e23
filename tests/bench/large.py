#!/usr/bin/env python3
"""Memory and time of each command for a mesh of 100 million cells on few ranks. Standard library only. Needs 16 GiB of memory and 40 GB of disk.

    large.py --quadloop PROGRAM [--ranks N ...] [--finer F] [--folder FOLDER] [--update docs/performance.md] [--require]

Bytes per cell are the sum of the largest resident memories of all ranks over the number of cells. Seconds are those of the whole command, one run.

--finer    divides every spacing of the case cases/naca0012 (39: 100 million cells)
--require  exit status 1 where a command needs more than 150 bytes per cell
"""
import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

from bench import AIRFOIL
from figures import add_update, tell
from first_rank import memory, options_of

MOST = 150  # bytes per cell
COMMANDS = {
    "mesh, smoothed, written as .mesh and .qmesh": ["mesh", AIRFOIL, "-o", "a", "--set", 'output.formats=["mesh","qmesh"]'],
    "check .mesh": ["check", "a.mesh"],
    "smooth .mesh to .qmesh": ["smooth", "a.mesh", "-o", "new.qmesh"],
    "convert .mesh to .cgns": ["convert", "a.mesh", "new.cgns"],
    "convert .cgns to .qmesh": ["convert", "new.cgns", "again.qmesh"],
    "extrude .qmesh to .vtu, one layer": ["extrude", "a.qmesh", "-o", "new.vtu", "--layers", "1", "--thickness", "1"],
}
LEFT_OVER = {"smooth .mesh to .qmesh": ["new.qmesh"], "convert .cgns to .qmesh": ["new.cgns", "again.qmesh"], "extrude .qmesh to .vtu, one layer": ["new.vtu"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True, type=lambda text: Path(text).resolve())
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 4])
    parser.add_argument("--finer", type=float, default=39)
    parser.add_argument("--folder", type=Path, help="where the files are written")
    add_update(parser)
    parser.add_argument("--require", action="store_true")
    args = parser.parse_args()
    rows, missed, cells = [], False, 0
    for ranks in args.ranks:
        with tempfile.TemporaryDirectory(prefix="quadloop_bench_large_", dir=args.folder) as folder:
            for name, arguments in COMMANDS.items():
                begin = time.monotonic()
                mebibytes, said = memory(args.quadloop, [*options_of(name, arguments, args.finer), "--json"], ranks, folder)
                seconds = time.monotonic() - begin
                if arguments[0] == "mesh":
                    record = json.loads(said)
                    cells = record["triangles"] + record["quads"]
                per_cell = sum(mebibytes) * 2**20 / cells
                missed |= per_cell > MOST
                rows.append(f"| {name} | {ranks} | {seconds:.0f} | {min(mebibytes):.0f} to {max(mebibytes):.0f} | {per_cell:.0f} |")
                print(rows[-1], file=sys.stderr, flush=True)
                for file in LEFT_OVER.get(name, []):
                    (Path(folder) / file).unlink()
    tell("\n".join([f"one run each. A mesh of {cells / 1e6:.1f} million cells (`--finer {args.finer:g}`).", "",
                    "| command | ranks | s | MiB on a rank | bytes per cell, all ranks |", "|---|---|---|---|---|", *rows, "",
                    f"Goal: at most {MOST} bytes per cell."]), "large.py", args.update)
    return 1 if args.require and missed else 0


if __name__ == "__main__":
    sys.exit(main())
