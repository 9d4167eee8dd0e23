#!/usr/bin/env python3
"""A case with inner lines, both types of mesh: valid for `quadloop check`, the same bytes on 1, 2, 3 and 5 ranks in every format that holds
lines, each line of the case followed from its first point to its last, also after conversion; the face zones of a polyMesh; as expected
(expected.toml). Without baffles, whose nodes coincide, the mesh is also valid for the other judge.

    run_lines.py --quadloop PROGRAM --case CASE.toml [--write-expected]
"""
import argparse
import math
import re
import sys
import tempfile
import tomllib
from pathlib import Path

from quadloop_runs import JUDGE, NativeMesh, beside_the_checkout, digest, fail, mesh_case, run
from run_case import check_cgns, compare, expected_file, values_of, write_expected

sys.path.append(str(Path(JUDGE).parent))
from mesh_files import distances_from  # noqa: E402

FORMATS = ("mesh", "qmesh", "vtu", "msh", "fluent.msh", "cgns")
SAME_BYTES = ("mesh", "qmesh", "vtu", "msh", "fluent.msh", "tree.h5")  # libcgns writes the time into a file


def points_and_lines(path):
    """The points of a .mesh file, and its inner lines as lists of edges."""
    text = Path(path).read_text().splitlines()
    count = int(text[1])
    points = [tuple(map(float, row.split())) for row in text[2:2 + count]]
    lines, at = {}, 0
    while at < len(text):
        words = text[at].split()
        at += 1
        if words[:3] != ["#", "inner", "line"]:
            continue
        rows = text[at:at + int(words[4])]
        lines[words[3]] = [tuple(int(word) - 1 for word in row.split()[1:]) for row in rows]
        at += len(rows)
    return points, lines


def check_line(name, path, points, edges):
    """A line is one row of edges from the first point of its path to the last; without a path it is a closed row. Nodes where it crosses a baffle
    are doubled."""
    follows = {points[start]: points[end] for start, end in edges}
    starts = set(follows) - set(follows.values())
    if path is None and len(follows) == len(edges) and not starts:
        return
    if path is None or len(follows) != len(edges) or len(starts) != 1:
        fail(f"line {name} is not one row of edges in its direction")
    place = starts.pop()
    if math.dist(place, path[0]) > 1e-9:
        fail(f"line {name} begins at {place}, not at {path[0]}")
    while place in follows:
        place = follows[place]
    if math.dist(place, path[-1]) > 1e-9:
        fail(f"line {name} ends at {place}, not at {path[-1]}")


def foam_lists(path):
    """The texts between the parentheses that hold the lists of numbers, or of faces, of an OpenFOAM file, in their order."""
    return [part.split() for part in re.findall(r"\n\(\n([-0-9. e()\n]*?)\n?\)\n", Path(path).read_text())]


def check_face_zones(mesh, folder):
    """The face zones of a polyMesh are the inner lines of the .mesh file, flipped where the owner is on the right."""
    points, lines = points_and_lines(mesh)
    names = re.findall(r"\n(\w+)\n\{\n    type faceZone", (folder / "faceZones").read_text())
    lists = foam_lists(folder / "faceZones")
    if names != list(lines) or len(lists) != 2 * len(names):
        fail(f"the face zones are {names}")
    rows = re.findall(r"^4\(([0-9 ]+)\)$", (folder / "faces").read_text(), re.MULTILINE)
    places = [tuple(map(float, row.split())) for row in re.findall(r"^\(([^()]+)\)$", (folder / "points").read_text(), re.MULTILINE)]
    for name, labels, flips in zip(names, lists[::2], lists[1::2]):
        found = []
        for label, flip in zip(map(int, labels), flips, strict=True):
            nodes = list(map(int, rows[label].split()))
            while places[nodes[0]][2] != 0 or places[nodes[1]][2] != 0:
                nodes = nodes[1:] + nodes[:1]
            edge = tuple(places[node][:2] for node in nodes[:2])
            found.append(edge if flip == "0" else edge[::-1])
        if sorted(found) != sorted((points[start], points[end]) for start, end in lines[name]):
            fail(f"the faces of zone {name} are others than the edges of the line")


def check_nodes(mesh, geometry):
    """All nodes of boundaries and lines lie on those of the geometry, to 1e-12 of its extent."""
    points, lines = points_and_lines(mesh)
    extent = max(max(column) - min(column) for column in zip(*points))
    rows = {**NativeMesh(mesh).boundaries, **lines}
    for name, edges in rows.items():
        nodes = sorted({node for edge in edges for node in edge})
        off = distances_from(geometry, name, [points[node] for node in nodes])
        if not off.max() <= 1e-12 * extent:
            fail(f"a node of {name} at {points[nodes[off.argmax()]]} is {off.max()} off")


def moved(row, by):
    """The row of a point of a `.geom` file, moved with the control points of its curve."""
    coordinates, *rest = re.split(r" (?=weights|spacing)", row, maxsplit=1)
    words = coordinates.split()
    numbers = [i for i, word in enumerate(words) if word != "curve"]
    for k, i in enumerate(numbers):
        words[i] = repr(float(words[i]) + by[k % 2])
    return " ".join([*words, *rest])


def check_geometry(quadloop, case, work):
    """The lines of a mesh lie on those of its geometry, and not on one with a moved line."""
    mesh, geometry = work / "fits.mesh", work / "fits.geom"
    run([quadloop, "mesh", case, "-o", work / "fits", "--geometry-out", geometry])
    run([quadloop, "check", mesh, "--geometry", geometry])
    rows = geometry.read_text().splitlines()
    line = next(iter(points_and_lines(mesh)[1]))
    heads = [i for i, row in enumerate(rows) if row.split() in ([line], [line, "open"])]  # a line is written in both directions
    for head in heads:
        for row in range(head + 2, head + 2 + int(rows[head + 1])):
            rows[row] = moved(rows[row], (0.01, 0.02))  # in both directions of the line
    other = work / "moved.geom"
    other.write_text("\n".join(rows) + "\n")
    said = run([quadloop, "check", mesh, "--geometry", other, "--verbose"], accept=range(1, 5))
    if f"a node of boundary {line} lies off it" not in said:
        fail(f"it is not noticed that line {line} is moved: {said}")
    return geometry


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadloop", required=True)
    parser.add_argument("--case", required=True, type=Path)
    parser.add_argument("--write-expected", action="store_true")
    args = parser.parse_args()
    tables = tomllib.loads(args.case.read_text())["line"]
    options = ["--set", "output.formats=[" + ",".join(f'"{name}"' for name in (*FORMATS, "polyMesh")) + "]"]
    with tempfile.TemporaryDirectory(prefix="quadloop_lines_") as folder:
        work = Path(folder)
        geometry = check_geometry(args.quadloop, args.case, work)
        for mesh_type in ("hybrid", "delaunay"):
            prefix = work / mesh_type
            for ranks in (1, 2, 3, 5):
                other = prefix if ranks == 1 else work / "other"
                mesh_case(args.quadloop, args.case, other, ranks, [*options, "--type", mesh_type])
                for name in SAME_BYTES:
                    if digest(f"{other}.{name}") != digest(f"{prefix}.{name}"):
                        fail(f"{name} differs on {ranks} ranks")
            for name in FORMATS:
                run([args.quadloop, "check", f"{prefix}.{name}"])
                again = work / f"again_{name}.mesh"
                run([args.quadloop, "convert", f"{prefix}.{name}", str(again)])
                if name == "cgns":
                    of_ranks = work / "of_ranks.mesh"
                    run([args.quadloop, "convert", f"{other}.cgns", str(of_ranks)])
                    if digest(again) != digest(of_ranks):
                        fail("cgns differs on 5 ranks")
                points, lines = points_and_lines(again)
                wanted = {t.get("name", t.get("boundary")): t.get("path") for t in tables if t.get("kind", "line") == "line"}
                if set(lines) != set(wanted):
                    fail(f"{name} has the lines {sorted(lines)}")
                for line, path in wanted.items():
                    check_line(line, path, points, lines[line])
                check_nodes(again, geometry)
            script = beside_the_checkout("QUADLOOP_MESHCHECK", "tools/meshcheck.py")
            if script is not None and len(wanted) == len(tables):
                run([sys.executable, script, f"{prefix}.mesh"])
            check_cgns(prefix)
            for file in ("points", "faces", "owner", "neighbour", "boundary", "faceZones"):
                if (work / f"{mesh_type}.polyMesh" / file).read_bytes() != (work / "other.polyMesh" / file).read_bytes():
                    fail(f"{file} of the polyMesh differs on 5 ranks")
            check_face_zones(f"{prefix}.mesh", work / f"{mesh_type}.polyMesh")
            found = values_of(prefix)
            expected = expected_file(args.case, mesh_type)
            if args.write_expected:
                write_expected(expected, found)
            else:
                compare(found, tomllib.loads(expected.read_text()))
    print("good")


if __name__ == "__main__":
    main()
