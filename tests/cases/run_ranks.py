#!/usr/bin/env python3
"""The same files whatever the number of ranks: .mesh, .cgns and .tree.h5, byte for byte.

    run_ranks.py --quadloop PROGRAM --case CASE.toml --ranks 1 2 3 4 5 8 16 [--type delaunay]
"""
import argparse
import filecmp
import tempfile
from pathlib import Path

from quadloop_runs import fail, mesh_case


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--ranks", required=True, type=int, nargs="+")
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_ranks_") as folder:
        prefixes = {ranks: Path(folder) / f"on_{ranks}" for ranks in args.ranks}
        first = prefixes[args.ranks[0]]
        for ranks, prefix in prefixes.items():
            mesh_case(args.quadloop, args.case, prefix, ranks, ["--type", args.type])
            for suffix in (".mesh", ".cgns", ".tree.h5"):
                if not filecmp.cmp(f"{first}{suffix}", f"{prefix}{suffix}", shallow=False):
                    fail(f"{suffix} on {ranks} ranks is not what it is on {args.ranks[0]}")
    print("the same on", ", ".join(map(str, args.ranks)), "ranks")


if __name__ == "__main__":
    main()
