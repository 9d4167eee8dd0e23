#!/usr/bin/env python3
"""Periodic pairs in files: the nodes on the two sides are images of each other, in every format that stores pairs.

    run_pairs.py --quadloop PROGRAM --case CASE.toml [--type delaunay]

The map is that of the case. OpenFOAM's checkMesh and cgnscheck judge the cyclic patches and the connections of the zone with itself, where they are at hand.
"""
import argparse
import json
import math
import re
import shutil
import subprocess
import tempfile
import tomllib
from pathlib import Path

import numpy as np

from quadloop_runs import MPIRUN, NativeMesh, digest, fail, mesh_case, run
from run_checkmesh import find_checkmesh, write_system

TOLERANCE = 1e-11


def image(pair, points):
    if "translation" in pair:
        return points + np.array(pair["translation"])
    turn, centre = math.radians(pair["rotation"]), np.array(pair.get("centre", (0, 0)))
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    return (points - centre) @ matrix.T + centre


def read_mesh(path):
    mesh = NativeMesh(path)
    return np.array(mesh.nodes), mesh.boundaries


def line(edges):
    """The nodes of an open line in order."""
    after = dict(edges)
    node = (set(after) - set(after.values())).pop()
    nodes = [node]
    while nodes[-1] in after:
        nodes.append(after[nodes[-1]])
    return nodes


def partners(mesh, pair):
    points, edges = mesh
    one, other = line(edges[pair["from"]]), line(edges[pair["to"]])[::-1]
    if len(one) != len(other):
        fail(f"{pair['from']} has {len(one)} nodes, {pair['to']} {len(other)}")
    apart = np.abs(image(pair, points[one]) - points[other]).max()
    if apart > TOLERANCE:
        fail(f"{pair['from']} and {pair['to']} are {apart} apart")
    return list(zip(one, other))


def check_msh(path, pairs, mesh):
    text = Path(path).read_text()
    section = text.split("$Periodic\n")[1].split("$EndPeriodic")[0].split("\n")
    if int(section[0]) != len(pairs):
        fail(f"{path}: {section[0]} links")
    at = 1
    for pair in pairs:
        count = int(section[at + 2])
        rows = [tuple(int(n) - 1 for n in row.split()) for row in section[at + 3:at + 3 + count]]
        if sorted((b, a) for a, b in rows) != sorted(partners(mesh, pair)):
            fail(f"{path}: the nodes of {pair['to']} have other partners")
        at += 3 + count


def check_su2(path, pairs, mesh):
    """The comment for the configuration: one line, as SU2 accepts a key once; its map is that of CPhysicalGeometry::MatchPeriodic."""
    rows = re.findall(r"^% MARKER_PERIODIC= \( (.*) \)$", Path(path).read_text(), re.M)
    words = rows[0].split(", ") if len(rows) == 1 else []
    if len(words) != 11 * len(pairs):
        fail(f"{path} tells {rows} of {len(pairs)} pairs")
    for at, pair in enumerate(pairs):
        name, donor, *numbers = words[11 * at:11 * (at + 1)]
        cx, cy, cz, about_x, about_y, degrees, tx, ty, tz = map(float, numbers)
        if (name, donor) != (pair["from"], pair["to"]) or any((cz, about_x, about_y, tz)):
            fail(f"{path}: {words}")
        turn, centre = math.radians(degrees), np.array((cx, cy))
        for one, other in partners(mesh, pair):
            x, y = mesh[0][one] - centre
            turned = np.array((math.cos(turn) * x - math.sin(turn) * y, math.sin(turn) * x + math.cos(turn) * y))
            if np.abs(turned + centre + (tx, ty) - mesh[0][other]).max() > TOLERANCE:
                fail(f"{path}: SU2 finds no donor for node {one}")


def foam_list(path, pattern):
    text = path.read_text()
    body = text[text.index("\n(\n") + 3:text.rindex(")")]
    return [tuple(map(float, re.findall(pattern, row))) for row in body.split("\n") if row]


def check_foam(folder, pairs, work):
    number = r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
    points = np.array(foam_list(folder / "points", number))
    faces = [tuple(map(int, row[1:])) for row in foam_list(folder / "faces", number)]
    patches = {name: body for name, body in re.findall(r"\n    (\S+)\n    \{(.*?)\}", (folder / "boundary").read_text(), re.S)}
    for pair in pairs:
        sides = []
        for name, partner in ((pair["from"], pair["to"]), (pair["to"], pair["from"])):
            body = patches[name]
            if "type            cyclic;" not in body or f"neighbourPatch  {partner};" not in body:
                fail(f"{folder}: patch {name} is not cyclic with {partner}: {body}")
            start, count = (int(re.search(rf"{key}\s+(\d+);", body)[1]) for key in ("startFace", "nFaces"))
            sides.append(faces[start:start + count])
        for one, other in zip(*sides, strict=True):
            ring = [one[0], *one[:0:-1]]  # the other face is seen from the other side
            if np.abs(image(pair, points[ring][:, :2]) - points[list(other)][:, :2]).max() > TOLERANCE or \
                    np.abs(points[ring][:, 2] - points[list(other)][:, 2]).max() > 0:
                fail(f"{folder}: face {other} does not begin at the partner of {one}")
    program, environment = find_checkmesh()
    case = work / "foam"
    write_system(case)
    shutil.copytree(folder, case / "constant" / "polyMesh")
    said = subprocess.run([program, "-case", case], capture_output=True, text=True, env=environment, check=False).stdout
    failed = re.findall(r"\*\*\*.*", said)
    if "Mesh OK." not in said and not all("aspect ratio" in line for line in failed):
        fail(f"checkMesh: {said[-1500:]}")
    print("checkMesh:", "Mesh OK." if "Mesh OK." in said else failed)


def check_fault(quadloop, path, pair, mesh, work):
    """A node that has left its place is found."""
    node = partners(mesh, pair)[2][1]
    lines = Path(path).read_text().splitlines(keepends=True)
    first = next(i for i, row in enumerate(lines) if not row.startswith("#")) + 1
    x, y = mesh[0][node] + 1e-7 * (mesh[0][partners(mesh, pair)[3][1]] - mesh[0][node])
    lines[first + node] = f"{float(x)!r} {float(y)!r}\n"
    moved = work / "moved.mesh"
    moved.write_text("".join(lines))
    said = run([quadloop, "check", moved], accept=(1,))
    if "no periodic pair" not in said:
        fail(f"check does not see a node out of place: {said[-500:]}")


def check_smoothing(args, pairs, work):
    """`smooth` moves partners together, the same on any number of ranks. Sides whose cells are squares have nothing to move."""
    outline = work / "as_meshed.geom"
    mesh_case(args.quadloop, args.case, work / "rough", 1, ["--type", args.type, "--set", "smooth.sweeps=0", "--geometry-out", outline])
    results = {ranks: work / f"smooth_{ranks}.mesh" for ranks in (1, 3)}
    for ranks, result in results.items():
        run([MPIRUN, "-n", str(ranks), args.quadloop, "smooth", work / "rough.mesh", "--geometry", outline, "-o", result])
    if digest(results[1]) != digest(results[3]):
        fail("smooth on 3 ranks gives another mesh")
    before, after = read_mesh(work / "rough.mesh"), read_mesh(results[1])
    moved = [one for pair in pairs for one, _ in partners(after, pair) if (before[0][one] != after[0][one]).any()]
    print(len(moved), "nodes of pairs moved in smoothing")
    if args.sides_move != bool(moved):
        fail(f"smooth moves {len(moved)} nodes of pairs")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--type", choices=("hybrid", "delaunay"), default="hybrid")
    parser.add_argument("--sides-move", action="store_true", help="smoothing moves nodes of pairs")
    args = parser.parse_args()
    pairs = tomllib.loads(args.case.read_text())["pair"]
    with tempfile.TemporaryDirectory(prefix="quadloop_pairs_") as folder:
        work = Path(folder)
        prefix = work / "case"
        formats = ["mesh", "qmesh", "cgns", "vtu", "msh", "msh41", "su2", "polyMesh"]
        mesh_case(args.quadloop, args.case, prefix, 1, ["--type", args.type, "--set", f"output.formats={json.dumps(formats)}"])
        mesh = read_mesh(f"{prefix}.mesh")
        comments = [row for row in Path(f"{prefix}.mesh").read_text().splitlines() if row.startswith("# pair ")]
        if len(comments) != len(pairs):
            fail(f"the comments are {comments}")
        for pair in pairs:
            print(pair["from"], pair["to"], len(partners(mesh, pair)), "nodes")
        for suffix in ("qmesh", "cgns", "vtu"):
            back = work / f"back_{suffix}.mesh"
            run([args.quadloop, "convert", f"{prefix}.{suffix}", back])
            found = [row for row in back.read_text().splitlines() if row.startswith("# pair ")]
            if found != comments:
                fail(f".{suffix} gives back {found}")
        check_smoothing(args, pairs, work)
        check_msh(f"{prefix}.msh", pairs, mesh)
        check_msh(f"{prefix}.msh41", pairs, mesh)
        check_su2(f"{prefix}.su2", pairs, mesh)
        check_fault(args.quadloop, f"{prefix}.mesh", pairs[0], mesh, work)
        if shutil.which("cgnscheck"):
            said = run(["cgnscheck", f"{prefix}.cgns"])
            if "ERROR" in said or "WARNING" in said or said.count("checking periodic data Translation") != 2 * len(pairs):
                fail(f"cgnscheck: {said[-1500:]}")
        check_foam(Path(f"{prefix}.polyMesh"), pairs, work)


if __name__ == "__main__":
    main()
