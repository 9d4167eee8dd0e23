"""The L1 error of a variable on a native mesh against a function that is known, as it is on triangles and halves of quads."""
from pathlib import Path

import numpy as np


def read_native(path):
    """Nodes, triangles (quads in halves) and a dictionary of the solution's variables."""
    numbers, names = [], []
    for line in Path(path).read_text().splitlines():
        if line.startswith("#names:"):
            names = line.split()[1:]
        elif not line.startswith("#"):
            numbers.extend(line.split())
    at = iter(numbers)

    def table(width):
        rows = int(next(at))
        return np.array([float(next(at)) for _ in range(rows * width)]).reshape(rows, width)

    points = table(2)
    next(at)  # blocks
    triangles, quads = table(3).astype(int) - 1, table(4).astype(int) - 1
    for _ in range(int(next(at))):
        table(2)
    table(1)
    width = int(next(at))
    values = np.array([float(next(at)) for _ in range(len(points) * width)]).reshape(len(points), width)
    halves = np.vstack([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return points, halves, {name: values[:, i] for i, name in enumerate(names)}


def parts_of_triangle(splits):
    """Barycentric coordinates of the middles of splits^2 equal parts."""
    for i in range(splits):
        for j in range(splits - i):
            for third in (1, 2) if i + j < splits - 1 else (1,):
                a, b = (i + third / 3) / splits, (j + third / 3) / splits
                yield np.array([1 - a - b, a, b])


def l1_error(path, variable, exact, splits=6):
    """Number of nodes, and the integral of |variable - exact(x, y)| by the middles of splits^2 parts of each triangle; `exact` takes arrays."""
    points, triangles, variables = read_native(path)
    corners, values = points[triangles], variables[variable][triangles]
    edges = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = 0.5 * (edges[0][:, 0] * edges[1][:, 1] - edges[0][:, 1] * edges[1][:, 0])
    total = np.zeros(len(triangles))
    for weights in parts_of_triangle(splits):
        p = np.einsum("tcd,c->td", corners, weights)
        total += np.abs(values @ weights - exact(p[:, 0], p[:, 1]))
    return len(points), float((total * areas).sum() / splits**2)
