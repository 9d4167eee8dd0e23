#!/usr/bin/env python3
"""The same files whatever the number of ranks: .mesh and .tree.h5 byte for byte, every array of the .cgns.

    run_ranks.py --quadloop PROGRAM --case CASE.toml --ranks 1 2 3 4 5 8 16 [--type delaunay]
"""
import argparse
import filecmp
import tempfile
from pathlib import Path

from quadloop_runs import fail, mesh_case


def arrays(path):
    """{path in the file: (type, shape, bytes)} of every dataset of an HDF5 file."""
    import h5py
    found = {}

    def keep(name, item):
        # The type and the version of the library that wrote the file stand beside the mesh and say nothing about it.
        if isinstance(item, h5py.Dataset) and not name.startswith(" "):
            value = item[()]
            found[name] = (str(item.dtype), item.shape, value.tobytes())

    with h5py.File(path, "r") as file:
        file.visititems(keep)
    return found


def compare_arrays(one, other):
    left, right = arrays(one), arrays(other)
    if left.keys() != right.keys():
        fail(f"{one} and {other} hold different arrays: {sorted(left.keys() ^ right.keys())[:6]}")
    different = [name for name in left if left[name] != right[name]]
    if different:
        fail(f"{one} and {other} differ in {len(different)} arrays, first {different[0]}")
    if not any("CoordinateX" in name for name in left):
        fail(f"{one} holds no coordinates")


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
            for suffix in (".mesh", ".tree.h5"):
                if not filecmp.cmp(f"{first}{suffix}", f"{prefix}{suffix}", shallow=False):
                    fail(f"{suffix} on {ranks} ranks is not what it is on {args.ranks[0]}")
            compare_arrays(f"{first}.cgns", f"{prefix}.cgns")
    print("the same on", ", ".join(map(str, args.ranks)), "ranks")


if __name__ == "__main__":
    main()
