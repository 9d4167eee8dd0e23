"""The L1 error of the density on a mesh of the wedge case against the exact oblique shock."""
import math
import sys
from pathlib import Path

import numpy as np

MACH, GAMMA, SHOCK_DEGREES = 2.0, 1.4, 39.313931846481904
NORMAL = (MACH * math.sin(math.radians(SHOCK_DEGREES))) ** 2
DENSITY_BEHIND = (GAMMA + 1) * NORMAL / ((GAMMA - 1) * NORMAL + 2)
PRESSURE_RATIO = 1 + 2 * GAMMA / (GAMMA + 1) * (NORMAL - 1)


def exact_density(x, y):
    """1 before the shock, which begins at the origin, and DENSITY_BEHIND after it."""
    return np.where(y < x * math.tan(math.radians(SHOCK_DEGREES)), DENSITY_BEHIND, 1.0)


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


def density_error(path, splits=4):
    """Number of nodes, and the integral of |density - exact| by the midpoints of splits^2 parts of each triangle."""
    points, triangles, variables = read_native(path)
    corners, values = points[triangles], variables["density"][triangles]
    edges = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = 0.5 * (edges[0][:, 0] * edges[1][:, 1] - edges[0][:, 1] * edges[1][:, 0])
    total = np.zeros(len(triangles))
    for i in range(splits):
        for j in range(splits - i):
            for third in (1, 2) if i + j < splits - 1 else (1,):
                a, b = (i + third / 3) / splits, (j + third / 3) / splits
                weights = np.array([1 - a - b, a, b])
                p = np.einsum("tcd,c->td", corners, weights)
                total += np.abs(values @ weights - exact_density(p[:, 0], p[:, 1]))
    return len(points), float((total * areas).sum() / splits**2)


def slope(sizes, errors):
    """Of log error over log size, by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(name, *density_error(name))
