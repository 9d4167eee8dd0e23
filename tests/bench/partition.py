#!/usr/bin/env python3
"""Edge cut and balance of the parts that `quadloop convert --parts` makes, beside METIS's (k-way, Debian's libmetis5) on the same mesh.

    partition.py --quadloop PROGRAM [--update docs/performance.md]

Needs numpy. Both weigh a cell by its number of edges; METIS gets the dual graph and its own defaults (a balance of 1.03 is allowed).
"""
import argparse
import ctypes
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from figures import add_update, tell

ROOT = pathlib.Path(__file__).resolve().parents[2]
MESHES = [("naca0012", "hybrid"), ("naca0012", "delaunay"), ("naca0012_layers", "hybrid"), ("three_element_layers", "hybrid")]


def rows(text):
    """The numbers of a native mesh or .links file, without its comments."""
    return np.array(" ".join(line for line in text.splitlines() if not line.startswith("#")).split(), dtype=float)


def cells_of(path):
    """Triangles and quads of a mesh of one block, from 0."""
    numbers = rows(pathlib.Path(path).read_text())
    at = 1 + 2 * int(numbers[0])
    if numbers[at] != 1:
        sys.exit(f"{path}: a mesh of one block is wanted")
    cells = []
    at += 1
    for width in (3, 4):
        count = int(numbers[at])
        cells.append(numbers[at + 1:at + 1 + width * count].astype(np.int64).reshape(count, width) - 1)
        at += 1 + width * count
    return cells


def pairs_of(cells):
    """The two cells of each inner edge, triangles numbered first."""
    first, edges, owners = 0, [], []
    for block in cells:
        for k in range(block.shape[1]):
            edges.append(np.sort(np.stack([block[:, k], block[:, (k + 1) % block.shape[1]]], axis=1), axis=1))
            owners.append(first + np.arange(len(block)))
        first += len(block)
    edges, owners = np.concatenate(edges), np.concatenate(owners)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, owners = edges[order], owners[order]
    same = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    return np.stack([owners[same], owners[same + 1]], axis=1)


def metis(pairs, weights, parts):
    library = ctypes.CDLL("libmetis.so.5")
    both = np.concatenate([pairs, pairs[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    starts = np.searchsorted(both[:, 0], np.arange(len(weights) + 1)).astype(np.int32)
    neighbours, weights = both[:, 1].astype(np.int32), weights.astype(np.int32)
    found, cut = np.zeros(len(weights), dtype=np.int32), ctypes.c_int32()
    number = lambda value: ctypes.byref(ctypes.c_int32(value))
    array = lambda values: values.ctypes.data_as(ctypes.c_void_p)
    status = library.METIS_PartGraphKway(number(len(weights)), number(1), array(starts), array(neighbours), array(weights), None, None,
                                         number(parts), None, None, None, ctypes.byref(cut), array(found))
    if status != 1:
        sys.exit(f"METIS ended with {status}")
    return found


def figures(pairs, weights, of):
    sums = np.bincount(of, weights=weights)
    return int((of[pairs[:, 0]] != of[pairs[:, 1]]).sum()), sums.max() * len(sums) / sums.sum()


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def rows_of(quadloop, case, kind):
    with tempfile.TemporaryDirectory() as folder:
        run(quadloop, "mesh", str(ROOT / "cases" / case / "case.toml"), "--type", kind, "-o", f"{folder}/a", "-q")
        cells = cells_of(f"{folder}/a.mesh")
        pairs, weights = pairs_of(cells), np.repeat([3, 4], [len(block) for block in cells])
        for parts in (4, 7, 16, 64):
            record = json.loads(run(quadloop, "convert", f"{folder}/a.mesh", f"{folder}/b.mesh", "--parts", str(parts), "--json", "-q"))
            cut, balance = figures(pairs, weights, metis(pairs, weights, parts))
            yield (f"| {case}, {kind} | {len(weights)} | {parts} | {record['edge_cut']} | {cut} | {record['edge_cut'] / cut:.2f} "
                   f"| {record['part_balance']:.4f} | {balance:.4f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    add_update(parser)
    args = parser.parse_args()
    rows = [row for case, kind in MESHES for row in rows_of(args.quadloop, case, kind)]
    tell("\n".join(["METIS 5.1.", "", "| mesh | cells | parts | edge cut | METIS | ratio | balance | METIS |", "|---|---|---|---|---|---|---|---|",
                    *rows]), "partition.py", args.update)


if __name__ == "__main__":
    main()
