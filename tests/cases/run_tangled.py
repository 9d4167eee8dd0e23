#!/usr/bin/env python3
"""A mesh whose nodes were thrown about, so that cells invert, must come back valid from `quadloop smooth`.

    run_tangled.py --quadloop PROGRAM --case CASE.toml [--type delaunay] [--seeds 20] [--share 0.2] [--throw 0.9]

--share  of the interior nodes are moved, each in a random direction by up to --throw of its shortest edge
"""
import argparse
import json
import math
import random
import tempfile
from pathlib import Path

from quadloop_runs import NativeMesh, fail, mesh_case, run


def shortest_edges(mesh):
    shortest = [math.inf] * len(mesh.nodes)
    for cell in mesh.cells:
        for k, a in enumerate(cell):
            b = cell[k - 1]
            edge = math.dist(mesh.nodes[a], mesh.nodes[b])
            shortest[a], shortest[b] = min(shortest[a], edge), min(shortest[b], edge)
    return shortest


def thrown(mesh, shortest, share, throw, seed):
    """The nodes, some of them moved."""
    chance = random.Random(seed)
    boundary = {node for edges in mesh.boundaries.values() for edge in edges for node in edge}
    nodes = list(mesh.nodes)
    interior = [node for node in range(len(nodes)) if node not in boundary]
    for node in chance.sample(interior, round(share * len(interior))):
        angle, length = chance.uniform(0, 2 * math.pi), chance.uniform(0, throw) * shortest[node]
        nodes[node] = (nodes[node][0] + length * math.cos(angle), nodes[node][1] + length * math.sin(angle))
    return nodes


def with_nodes(text, nodes):
    """The lines of a native mesh with other coordinates."""
    lines = text.splitlines()
    begin = next(i for i, line in enumerate(lines) if not line.startswith("#")) + 1
    lines[begin:begin + len(nodes)] = [f"{x!r} {y!r}" for x, y in nodes]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--share", type=float, default=0.2)
    parser.add_argument("--throw", type=float, default=0.9)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_tangled_") as folder:
        prefix = Path(folder) / "whole"
        mesh_case(args.quadloop, args.case, prefix, options=["--type", args.type])
        text, mesh = Path(f"{prefix}.mesh").read_text(), NativeMesh(f"{prefix}.mesh")
        shortest = shortest_edges(mesh)
        for seed in range(args.seeds):
            tangled, smoothed = Path(folder) / "tangled.mesh", Path(folder) / "smoothed.mesh"
            tangled.write_text(with_nodes(text, thrown(mesh, shortest, args.share, args.throw, seed)))
            before = json.loads(run([args.quadloop, "check", tangled, "--json"], accept=(0, 1)))
            if before["valid"] and args.throw > 0.8:
                fail(f"seed {seed}: no cell was inverted; the test means nothing")
            run([args.quadloop, "smooth", tangled, "-o", smoothed])
            after = json.loads(run([args.quadloop, "check", smoothed, "--json"]))
            print(f"seed {seed}: {len(before['faults'])} faults before, {len(after['faults'])} after, smallest angle {after['min_angle']:.1f}")
    print("good")


if __name__ == "__main__":
    main()
