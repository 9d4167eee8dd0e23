"""Meshes by BAMG (`ffbamg` or `bamg` on the PATH) for a loop with quadloop's solver: an outline for its first mesh, adapted meshes from a flow on the last one, and
both as native meshes. Needs numpy.
"""
import shutil
import subprocess
from dataclasses import dataclass

import numpy as np

PROGRAM = shutil.which("ffbamg") or shutil.which("bamg")


@dataclass
class Outline:
    """Points in rows, edges as rows (point, point, boundary from 1), boundaries' names, the size of cells asked for at each point of the first mesh, and
    which points are corners; numbers begin with 0."""
    points: np.ndarray
    edges: list
    names: tuple
    sizes: list
    corners: list


@dataclass
class Bounds:
    """Of sizes: the least, the largest, and the ratio by which they grow from cell to cell; the largest level of error that is tried; and the degrees
    from which a wall's turn is a corner."""
    least: float
    largest: float
    ratio: float
    error: float = 1.0
    corner: float = 30.0


def run(*command, where):
    return subprocess.run([str(word) for word in command], cwd=where, capture_output=True, text=True, check=False)


def write_outline(path, outline):
    """One domain, to the left of the first edge."""
    points, edges, corners = outline.points, outline.edges, outline.corners
    with open(path, "w", encoding="ascii") as file:
        file.write("MeshVersionFormatted 0\nDimension 2\nAngleOfCornerBound 30\n")
        file.write(f"Vertices {len(points)}\n" + "".join(f"{p[0]!r} {p[1]!r} 0\n" for p in points.tolist()))
        file.write(f"Edges {len(edges)}\n" + "".join(f"{a + 1} {b + 1} {mark}\n" for a, b, mark in edges))
        file.write("hVertices\n" + "".join(f"{size:.8g}\n" for size in outline.sizes))
        file.write(f"Corners {len(corners)}\n" + "".join(f"{corner + 1}\n" for corner in corners) + "SubDomain 1\n2 1 1 0\nEnd\n")


def read_mesh(path):
    """Points, triangles and edges with their boundaries; numbers begin with 1."""
    words = path.read_text().split()

    def table(title, width, kind):
        at = words.index(title) + 1
        return np.array(words[at + 1:at + 1 + int(words[at]) * width], dtype=kind).reshape(-1, width)
    return table("Vertices", 3, float)[:, :2], table("Triangles", 4, int)[:, :3], table("Edges", 3, int)


def write_native(mesh, names, path):
    points, triangles, edges = mesh
    directed = {pair for t in triangles.tolist() for pair in zip(t, t[1:] + t[:1])}
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(points)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in points.tolist()))
        file.write(f"1\n{len(triangles)}\n" + "".join("{} {} {}\n".format(*t) for t in triangles.tolist()) + f"0\n{len(names)}\n")
        for mark, name in enumerate(names, 1):
            own = [(a, b) if (a, b) in directed else (b, a) for a, b, m in edges.tolist() if m == mark]
            file.write(f"#Number of edges for boundary {mark} ({name})\n{len(own)}\n" + "".join(f"{a} {b}\n" for a, b in own))


def write_background(mesh, path):
    """Without the outline: with it BAMG 1.02 ends in a fault of memory. It takes walls to be smooth through the mesh's own nodes."""
    points, triangles, edges = mesh
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(points)} {len(triangles)} {len(edges)}\n" + "".join(f"{x!r} {y!r} 0\n" for x, y in points.tolist()))
        file.write("".join("{} {} {} 0\n".format(*t) for t in triangles.tolist()) + "".join("{} {} {}\n".format(*e) for e in edges.tolist()))


def first_mesh(outline, bounds, folder):
    write_outline(folder / "outline.msh", outline)
    run(PROGRAM, "-g", "outline.msh", "-o", "next.msh", "-hmax", bounds.largest, "-ratio", bounds.ratio, "-v", 0, where=folder)
    return read_mesh(folder / "next.msh")


def adapted(mesh, variables, wanted, bounds, folder):
    """The next mesh, of 95 to 100 % of the nodes wanted where a level of error leads there; `variables`: arrays over the nodes of the last mesh."""
    write_background(mesh, folder / "background.msh")
    values = np.stack(variables, axis=1)
    (folder / "flow.bb").write_text(f"2 {len(variables)} {len(values)} 2\n" + "".join(" ".join(map(repr, v)) + "\n" for v in values.tolist()))
    low, high = 1e-5, bounds.error
    for _ in range(25):
        error = (low * high) ** 0.5
        run(PROGRAM, "-b", "background.msh", "-thetamax", bounds.corner, "-Mbb", "flow.bb", "-o", "next.msh", "-err", error, "-hminaniso", bounds.least,
            "-hmax", bounds.largest, "-ratio", bounds.ratio, "-nbv", 100000, "-v", 0, where=folder)
        made = read_mesh(folder / "next.msh")
        if 0.95 * wanted <= len(made[0]) <= wanted:
            break
        low, high = (error, high) if len(made[0]) > wanted else (low, error)
    return made
