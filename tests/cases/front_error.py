"""The L1 error of a variable on a native mesh against a function that is known, as it is on triangles and halves of quads."""
import math
from pathlib import Path


def read_nodes_and_halves(path, variable):
    """Nodes, triangles (quads in halves) and the variable's values at the nodes."""
    words, names = [], []
    for line in Path(path).read_text().splitlines():
        if line.startswith("#names:"):
            names = line.split()[1:]
        elif not line.startswith("#"):
            words.extend(line.split())
    at = iter(words)

    def table(width, kind=float):
        return [[kind(next(at)) for _ in range(width)] for _ in range(int(next(at)))]

    points = table(2)
    next(at)  # blocks
    triangles, quads = table(3, int), table(4, int)
    for _ in range(int(next(at))):
        table(2, int)
    table(1)
    width = int(next(at))
    values = [[float(next(at)) for _ in range(width)][names.index(variable)] for _ in points]
    halves = triangles + [[q[0], q[1], q[2]] for q in quads] + [[q[0], q[2], q[3]] for q in quads]
    return points, [[node - 1 for node in t] for t in halves], values


def parts_of_triangle(splits):
    """Barycentric coordinates of the middles of splits^2 equal parts."""
    for i in range(splits):
        for j in range(splits - i):
            for third in (1, 2) if i + j < splits - 1 else (1,):
                a, b = (i + third / 3) / splits, (j + third / 3) / splits
                yield 1 - a - b, a, b


def l1_error(path, variable, exact, splits=6):
    """Number of nodes, and the integral of |variable - exact(x, y)| by the middles of splits^2 parts of each triangle."""
    points, triangles, values = read_nodes_and_halves(path, variable)
    weights = list(parts_of_triangle(splits))
    total = 0.0
    for t in triangles:
        (ax, ay), (bx, by), (cx, cy) = (points[node] for node in t)
        area = 0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
        off = 0.0
        for u, v, w in weights:
            value = u * values[t[0]] + v * values[t[1]] + w * values[t[2]]
            off += abs(value - exact(u * ax + v * bx + w * cx, u * ay + v * by + w * cy))
        total += area * off / splits**2
    return len(points), total
