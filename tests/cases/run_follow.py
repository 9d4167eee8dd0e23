#!/usr/bin/env python3
"""Layers whose first height follows the wall shear in the loop, and their thickness the boundary layer: the heights are those of the y+ wanted, the thickness is
that of Blasius's layer, the mesh stays within max_nodes, files are the same on any number of ranks, after --resume, and of a mesh made again from a cycle's tree.

    run_follow.py --quadloop PROGRAM
"""
import argparse
import filecmp
import json
import math
import shutil
import tempfile
from pathlib import Path

from adapt_runs import adapt, require, require_same_folders
from quadloop_runs import ROOT, run
from run_laminar import walls

CASE = ROOT / "cases" / "naca0012_laminar" / "adapt.toml"
Y_PLUS, VISCOSITY, MOST = 0.4, 0.5 / 5000, 7000
FOLLOWING = f"""
[flow]
reynolds = 5000
"""


def following_case(folder):
    text = CASE.read_text().replace("first = 0.001", f'first = "yplus:{Y_PLUS}"').replace("../naca0012", str(ROOT / "cases" / "naca0012"))
    text = text.replace("count = 15 }", 'count = 15, thickness = "flow" }')
    text = text.replace("max_nodes = 10000", f"max_nodes = {MOST}").replace("cycles = 3", "cycles = 2")
    case = folder / "follow.toml"
    case.write_text(text.replace("tolerance = 1e-6", "tolerance = 1e-6\niterations = 12") + FOLLOWING)
    return case


def first_heights(path):
    """{wall node: height of the next node off the wall} by the cells at the wall, and the nodes' places."""
    lines = Path(path).read_text().splitlines()
    points = [tuple(map(float, line.split())) for line in lines[2:2 + int(lines[1])]]

    def rows(title):
        start = next(i for i, line in enumerate(lines) if line.startswith(title))
        return [[int(word) - 1 for word in line.split()] for line in lines[start + 2:start + 2 + int(lines[start + 1])]]

    name = next(line for line in lines if line.startswith("#Number of edges") and line.endswith("(airfoil)"))
    wall = {tuple(edge) for edge in rows(name)}
    heights = {}
    for quad in rows("#Number of quadrilateral elements"):
        for k in range(4):
            a, b, c = quad[k], quad[(k + 1) % 4], quad[(k + 2) % 4]
            if (a, b) not in wall:
                continue
            (xa, ya), (xb, yb), (xc, yc) = points[a], points[b], points[c]
            heights[points[b]] = ((xb - xa) * (yc - ya) - (yb - ya) * (xc - xa)) / math.hypot(xb - xa, yb - ya)
    return heights


def friction(path):
    """Nodes (x, y) of the airfoil along x, and how many wall units go into a chord there."""
    nodes = walls(path, "airfoil")
    lines = Path(path).read_text().splitlines()
    places = {tuple(map(float, line.split())): row for row, line in enumerate(lines[2:2 + int(lines[1])])}
    rows = lines[-len(places):]
    return [(x, y, math.sqrt(abs(shear) * float(rows[places[x, y]].split()[0])) / VISCOSITY) for x, y, shear in nodes]


def check_heights(made):
    """On the fore part of both sides, where friction is neither lost nor new."""
    before = friction(made / "cycle_01" / "mesh.mesh")
    checked = 0
    for (x, y), height in first_heights(made / "cycle_02" / "mesh.mesh").items():
        if not 0.15 < x < 0.5:
            continue
        side = [(at, wall_units) for at, off, wall_units in before if off * y > 0]
        (x0, low), (x1, high) = next(pair for pair in zip(side, side[1:]) if pair[0][0] <= x <= pair[1][0])
        y_plus = height * (low + (x - x0) / (x1 - x0) * (high - low))
        require(abs(y_plus - Y_PLUS) < 0.03 * Y_PLUS, f"y+ is {y_plus} at ({x}, {y})")
        checked += 1
    require(checked > 20, f"only {checked} columns looked at")


def check_thickness(record):
    """At the nose layers are thin. At Reynolds number 5000 Blasius's layer is 0.07 thick at the end; the airfoil's is thicker there."""
    least, largest = record["layer_thickness"]["airfoil"]
    require(least < 0.05 and 0.07 < largest < 0.3, f"layers are {least} to {largest} thick")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="quadloop_follow_") as name:
        folder = Path(name)
        case = following_case(folder)
        alone = folder / "alone"
        told = adapt(args.quadloop, case, alone)
        require("target first heights on airfoil" in told, told)
        require("target thickness of layers on airfoil" in told, told)
        check_heights(alone)
        check_thickness(json.loads((alone / "cycle_02" / "record.json").read_text()))
        for cycle in (0, 1, 2):
            nodes = json.loads((alone / f"cycle_0{cycle}" / "record.json").read_text())["nodes"]
            require(nodes <= MOST and (cycle == 0 or nodes >= 0.95 * MOST), f"cycle {cycle} has {nodes} nodes")
        for ranks in (2, 3, 5):
            adapt(args.quadloop, case, folder / f"on_{ranks}", ranks)
            require_same_folders(alone, folder / f"on_{ranks}", f"on {ranks} ranks")
        parts = folder / "parts"
        shutil.copytree(alone, parts)
        shutil.rmtree(parts / "cycle_02")
        adapt(args.quadloop, case, parts, 3, ["--resume"])
        require_same_folders(alone, parts, "resumed")
        run([args.quadloop, "mesh", case, "--tree", alone / "cycle_02" / "mesh.tree.h5", "-o", folder / "again"])
        require(filecmp.cmp(folder / "again.tree.h5", alone / "cycle_02" / "mesh.tree.h5", shallow=False), "the tree made again differs")
    print("good")


if __name__ == "__main__":
    main()
