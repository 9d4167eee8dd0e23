"""Outlines as the input files of other mesh generators, and what these write as arrays of points and of triangles: Triangle's .poly, .node and .ele, Gmsh's
.geo and .msh, Medit's .mesh of MMG2D and BAMG, quadloop's .qmesh. For peers.py. Needs numpy.
"""
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

FAR = 10.0   # half width of the airfoil's far field
SLOPE = 0.3  # of sizes that grow from a wall


@dataclass
class Task:
    """What is to be meshed."""
    name: str
    case: Path
    settings: list       # of quadloop's
    loops: list          # arrays of points; the domain lies to their left
    largest: float       # edge asked for; 0: none
    cells: int           # about how many triangles
    wall: float = 0.0    # edge asked for at the airfoil, from which sizes grow by SLOPE; 0: sizes are the outline's own


def ring_edges(loops):
    """Each loop's edges by the numbers of all loops' points."""
    first, edges = 0, []
    for loop in loops:
        numbers = first + np.arange(len(loop))
        edges.append(np.column_stack([numbers, np.roll(numbers, -1)]))
        first += len(loop)
    return np.vstack(edges)


def area_of(loop):
    x, y = loop[:, 0], loop[:, 1]
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def point_within(loop):
    """A point inside it: the middle of the longest stretch between two crossings of a level that meets no point."""
    levels = np.unique(loop[:, 1])
    gap = np.argmax(np.diff(levels))
    y = (levels[gap] + levels[gap + 1]) / 2
    a, b = loop, np.roll(loop, -1, axis=0)
    cross = (a[:, 1] < y) != (b[:, 1] < y)
    a, b = a[cross], b[cross]
    x = np.sort(a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0]))
    widest = 2 * np.argmax(x[1::2] - x[0::2])
    return (x[widest] + x[widest + 1]) / 2, y


def write_poly(path, loops):
    points, edges = np.vstack(loops), ring_edges(loops)
    holes = [point_within(loop) for loop in loops if area_of(loop) < 0]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(points)} 2 0 0\n" + "".join(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(points.tolist())))
        file.write(f"{len(edges)} 0\n" + "".join(f"{i} {a} {b}\n" for i, (a, b) in enumerate(edges.tolist())))
        file.write(f"{len(holes)}\n" + "".join(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(holes)))


def read_triangle(stem):
    with open(f"{stem}.node", encoding="ascii") as file:
        count = int(file.readline().split()[0])
        points = np.fromfile(file, count=4 * count, sep=" ").reshape(count, 4)[:, 1:3]
    with open(f"{stem}.ele", encoding="ascii") as file:
        count = int(file.readline().split()[0])
        return points, np.fromfile(file, count=4 * count, sep=" ", dtype=np.int64).reshape(count, 4)[:, 1:]


def write_geo(path, task):
    loops, lines, first = task.loops, [], 1
    points = np.vstack(loops)
    lines += [f"Point({i}) = {{{x!r}, {y!r}, 0}};" for i, (x, y) in enumerate(points.tolist(), 1)]
    edges = ring_edges(loops) + 1
    lines += [f"Line({i}) = {{{a}, {b}}};" for i, (a, b) in enumerate(edges.tolist(), 1)]
    for number, loop in enumerate(loops, 1):
        lines.append(f"Curve Loop({number}) = {{{first}:{first + len(loop) - 1}}};")
        first += len(loop)
    order = sorted(range(len(loops)), key=lambda i: -abs(area_of(loops[i])))
    lines.append(f"Plane Surface(1) = {{{', '.join(str(i + 1) for i in order)}}};")
    lines += ["Mesh.MeshSizeFromPoints = 0;", "Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.Algorithm = 5;", "Mesh.MshFileVersion = 2.2;", "Mesh.Binary = 1;"]
    if task.wall > 0:
        lines += ["Field[1] = Distance;", f"Field[1].CurvesList = {{1:{len(loops[0])}}};", "Field[1].NumPointsPerCurve = 100;", "Field[2] = MathEval;",
                  f'Field[2].F = "{task.wall!r} + {SLOPE} * F1";', "Background Field = 2;"]
    elif task.largest > 0:
        lines.append(f"Mesh.MeshSizeMax = {task.largest!r}; Mesh.MeshSizeMin = {task.largest!r};")
    else:
        lines += ["Mesh.MeshSizeExtendFromBoundary = 1;", "Mesh.MeshSizeFromPoints = 1;"]
        lengths = np.linalg.norm(points[edges[:, 1] - 1] - points[edges[:, 0] - 1], axis=1)
        lines += [f"MeshSize{{{i}}} = {h!r};" for i, h in enumerate(lengths.tolist(), 1)]
    path.write_text("\n".join(lines) + "\n")


def read_msh(path):
    """Gmsh's binary 2.2, of whose elements the triangles are taken."""
    data = path.read_bytes()
    at = data.index(b"$Nodes\n") + 7
    end = data.index(b"\n", at)
    count = int(data[at:end])
    nodes = np.frombuffer(data, dtype=[("number", "<i4"), ("at", "<f8", 3)], count=count, offset=end + 1)
    at = data.index(b"$Elements\n", end + 1 + nodes.nbytes) + 10
    end = data.index(b"\n", at)
    left, at, triangles = int(data[at:end]), end + 1, []
    while left > 0:
        kind, some, tags = np.frombuffer(data, "<i4", 3, at)
        nodes_of = {15: 1, 1: 2, 2: 3}[int(kind)]
        rows = np.frombuffer(data, "<i4", int(some) * (1 + int(tags) + nodes_of), at + 12).reshape(int(some), -1)
        if kind == 2:
            triangles.append(rows[:, -3:])
        at += 12 + rows.nbytes
        left -= int(some)
    index = np.zeros(nodes["number"].max() + 1, dtype=np.int64)
    index[nodes["number"]] = np.arange(count)
    return nodes["at"][:, :2], index[np.vstack(triangles)]


def sizes_at(task):
    """What each vertex of the outline asks for: its boundary's size, or the mean length of its segments."""
    sizes = []
    for number, loop in enumerate(task.loops):
        lengths = np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1)
        own = (lengths + np.roll(lengths, 1)) / 2
        if task.largest > 0:
            own = np.minimum(own, task.largest)
        if task.wall > 0:
            own = np.full(len(loop), task.wall if number == 0 else task.wall + SLOPE * FAR)
        sizes.append(own)
    return np.concatenate(sizes)


def split_loops(task):
    """The outline with segments no longer than what they ask for: those two programs keep them as they are given."""
    if task.wall == 0 and task.largest == 0:
        return task
    loops = []
    for number, loop in enumerate(task.loops):
        wanted = task.largest if task.wall == 0 else task.wall if number == 0 else task.wall + SLOPE * FAR
        rows = []
        for a, b in zip(loop, np.roll(loop, -1, axis=0)):
            parts = max(1, int(np.ceil(np.linalg.norm(b - a) / wanted)))
            rows.append(a + (b - a) * np.arange(parts)[:, None] / parts)
        loops.append(np.vstack(rows))
    return replace(task, loops=loops)


def write_medit(path, task, sizes_too):
    points, edges = np.vstack(task.loops), ring_edges(task.loops) + 1
    with open(path, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted {0 if sizes_too else 2}\n\nDimension 2\n\nVertices {len(points)}\n")
        file.writelines(f"{x!r} {y!r} 1\n" for x, y in points.tolist())
        file.write(f"\nEdges {len(edges)}\n")
        file.writelines(f"{a} {b} 1\n" for a, b in edges.tolist())
        if sizes_too:
            file.write("\nhVertices\n")
            file.writelines(f"{h!r}\n" for h in sizes_at(task).tolist())
            file.write("\nSubDomain 1\n2 1 1 0\n")
        file.write("\nEnd\n")


def read_medit(path):
    words = path.read_text(encoding="ascii").split()
    def section(title, width):
        begin = words.index(title)
        count = int(words[begin + 1])
        return np.array(words[begin + 2:begin + 2 + width * count], dtype=float).reshape(count, width)
    return section("Vertices", 3)[:, :2], section("Triangles", 4)[:, :3].astype(np.int64) - 1


def read_qmesh(path):
    data = path.read_bytes()
    size = int(data[:64].split(b"\n")[1].split()[1])
    head = data[:size].decode().splitlines()
    nodes = int(next(line for line in head if line.startswith("nodes ")).split()[1])
    number = "<i4" if "node_bytes 4" in head else "<i8"
    triangles = sum(int(line.split()[1]) for line in head if line.startswith("block "))
    points = np.frombuffer(data, "<f8", 2 * nodes, size).reshape(nodes, 2)
    return points, np.frombuffer(data, number, 3 * triangles, size + points.nbytes).reshape(triangles, 3)
