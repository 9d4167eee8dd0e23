"""The layers of a mesh, found from its connectivity alone, and figures of their shape. numpy."""
from dataclasses import dataclass, field

import numpy as np

STRAIGHT = 1e-6  # columns are made straight; shares of their height
EXTENT_OF_CORNER = 30  # degrees: where a wall turns by more there is a corner


class CellEdges:
    """The cells' directed edges: which cell has an edge, and where in it."""

    def __init__(self, mesh):
        self.n = len(mesh.points)
        self.cells = np.concatenate([np.pad(mesh.triangles, ((0, 0), (0, 1)), constant_values=-1), mesh.quads])
        self.sizes = np.where(self.cells[:, 3] < 0, 3, 4)
        parts = []
        for k in range(4):
            has = np.flatnonzero(self.sizes > k)
            after = np.where(k + 1 < self.sizes[has], k + 1, 0)
            parts.append(np.column_stack([self.cells[has, k] * self.n + self.cells[has, after], has, np.full(len(has), k)]))
        rows = np.concatenate(parts)
        self.rows = rows[np.argsort(rows[:, 0])]

    def find(self, a, b):
        """(cell, place in it) of each edge a -> b; -1 where no cell has it."""
        numbers = np.asarray(a) * self.n + np.asarray(b)
        at = np.minimum(np.searchsorted(self.rows[:, 0], numbers), len(self.rows) - 1)
        found = self.rows[at, 0] == numbers
        return np.where(found, self.rows[at, 1], -1), np.where(found, self.rows[at, 2], -1)

    def corner(self, cell, place, further):
        return self.cells[cell, (place + further) % self.sizes[cell]]


@dataclass
class Layers:
    """Columns over wall edges: node k of the left side of column i is left[i, k], from the wall on."""
    left: np.ndarray
    right: np.ndarray
    incomplete: int  # wall edges over which there are not so many layers
    in_layers: np.ndarray  # a flag for each cell, triangles first
    edges: CellEdges = field(repr=False)


def distances_from_line(points, feet, through, x):
    """Of nodes x from the lines through two nodes each."""
    along, across = points[through] - points[feet], points[x] - points[feet]
    return np.abs(along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]) / np.hypot(*along.T)


def stands_over_a(points, a, b, feet, x):
    """Whether a triangle's third node is of a's column, or of b's. Columns are straight; the lowest cells are flat, so that the nearer one tells."""
    if feet is None:
        return np.hypot(*(points[x] - points[a]).T) < np.hypot(*(points[x] - points[b]).T)
    return distances_from_line(points, feet[0], a, x) < distances_from_line(points, feet[1], b, x)


def next_row(points, edges, a, b, feet=None):
    """The corners (c, d) over each edge a -> b, -1 where there is no quad or pair of triangles, and the cells. `feet`: where both columns begin."""
    cell, place = edges.find(a, b)
    is_quad = (cell >= 0) & (edges.sizes[cell] == 4)
    x = edges.corner(cell, place, 2)
    over_a = stands_over_a(points, a, b, feet, x)
    other, at = edges.find(np.where(over_a, x, a), np.where(over_a, b, x))  # the triangle beyond the diagonal d-b, or a-c
    beyond = edges.corner(other, at, 2)
    c = np.where(is_quad, x, np.where(over_a, beyond, x))
    d = np.where(is_quad, edges.corner(cell, place, 3), np.where(over_a, x, beyond))
    broken = (cell < 0) | (~is_quad & ((other < 0) | (edges.sizes[other] != 3)))
    return np.where(broken, -1, c), np.where(broken, -1, d), cell, np.where(is_quad, cell, other)


def rows_over(edges, a, b):
    """The corners (c, d) over one edge a -> b where two triangles are over it, cut either way."""
    cell, place = edges.find([a], [b])
    if cell[0] < 0 or edges.sizes[cell[0]] != 3:
        return []
    x = int(edges.corner(cell, place, 2)[0])
    found = []
    for side, over_a in (((a, x), False), ((x, b), True)):
        other, at = edges.find([side[0]], [side[1]])
        if other[0] >= 0 and edges.sizes[other[0]] == 3:
            beyond = int(edges.corner(other, at, 2)[0])
            found.append((beyond, x) if over_a else (x, beyond))
    return found


def bends(points, nodes):
    """Whether nodes are off the straight line from the first to the last one."""
    along, across = points[nodes[-1]] - points[nodes[0]], points[nodes] - points[nodes[0]]
    return np.abs(along[0] * across[:, 1] - along[1] * across[:, 0]).max() > STRAIGHT * (along ** 2).sum()


def straight_column(points, edges, foot, count):
    """The rows (a, b), the wall's edge first, of the one column of pairs of triangles over it whose two sides are straight; None where there is none."""
    columns = [[foot]]
    for _ in range(count):
        columns = [[*rows, (d, c)] for rows in columns for c, d in rows_over(edges, *rows[-1])]
        columns = [rows for rows in columns if not any(bends(points, [row[side] for row in rows]) for side in (0, 1))]
    return np.array(columns[0]) if len(columns) == 1 else None


def find_slanted(points, edges, sides, lost, in_layers):
    """Columns that the nearer foot did not tell, as where cells are as high as wide, or slanted. Returns which of the lost ones are whole."""
    left, right = sides
    found = np.zeros(len(lost), dtype=bool)
    for column in np.flatnonzero(lost):
        rows = straight_column(points, edges, (int(left[0][column]), int(right[0][column])), len(left) - 1)
        if rows is None:
            continue
        found[column] = True
        in_layers[edges.find(*rows[:-1].T)[0]] = in_layers[edges.find(*rows[1:, ::-1].T)[0]] = True
        for row, ends in enumerate(rows):
            left[row][column], right[row][column] = ends
    return found


def find_layers(mesh, walls, count):
    edges = CellEdges(mesh)
    wall = np.concatenate([mesh.boundaries[name] for name in walls])
    left, right = [wall[:, 0]], [wall[:, 1]]
    in_layers = np.zeros(len(edges.cells), dtype=bool)
    whole = np.ones(len(wall), dtype=bool)
    for row in range(count):
        c, d, first, second = next_row(mesh.points, edges, left[-1], right[-1], (left[0], right[0]) if row else None)
        whole &= c >= 0
        in_layers[first[whole]] = in_layers[second[whole]] = True
        left.append(np.where(whole, d, left[-1]))
        right.append(np.where(whole, c, right[-1]))
    whole |= find_slanted(mesh.points, edges, (left, right), ~whole, in_layers)
    layers = Layers(np.column_stack(left)[whole], np.column_stack(right)[whole], int((~whole).sum()), in_layers, edges)
    mark_fans(mesh, layers)
    return layers


def fans(layers):
    """(last column of the wall before, first one behind) of each sharp edge: they share the wall's node and no other."""
    before = dict(zip(layers.right[:, 0], layers.right))
    return [(before[side[0]], side) for side in layers.left if side[0] in before and before[side[0]][1] != side[1]]


def mark_fans(mesh, layers):
    """Cells between the two columns and nearer than the shorter of them."""
    cells, sizes = layers.edges.cells, layers.edges.sizes
    corners = mesh.points[cells]
    corners[sizes == 3, 3] = 0
    centres = corners.sum(axis=1) / sizes[:, None]
    for first, last in fans(layers):
        apex, ends = mesh.points[first[0]], mesh.points[[first[-1], last[-1]]] - mesh.points[first[0]]
        from_apex = centres - apex
        angle = lambda v: np.arctan2(v[..., 1], v[..., 0])
        sweep = (angle(ends[0]) - angle(ends[1])) % (2 * np.pi)
        reach = 0.985 * np.hypot(*ends.T).min()
        layers.in_layers |= (np.hypot(*from_apex.T) < reach) & ((angle(ends[0]) - angle(from_apex)) % (2 * np.pi) < sweep)


def shapes_of(points, cells):
    """Skewness (0 of equal angles, 1 of a flat corner) and least angle of cells with as many corners each."""
    width = cells.shape[1]
    p = points[cells]
    u, v = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    angles = np.degrees(np.abs(np.arctan2(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0], (u * v).sum(axis=2))))
    even = 60 if width == 3 else 90
    return np.maximum((angles.max(axis=1) - even) / (180 - even), (even - angles.min(axis=1)) / even), angles.min(axis=1)


def areas_of(points, cells):
    """Of cells with three or four corners, three where the last one is -1."""
    corners = np.where(cells[:, 3:4] < 0, cells[:, [0, 1, 2, 2]], cells)
    x, y = points[corners, 0], points[corners, 1]
    x, y = x - x[:, :1], y - y[:, :1]
    return ((x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)) / 2


def centroids_of(points, cells):
    corners = points[np.where(cells[:, 3:4] < 0, cells[:, [0, 1, 2, 2]], cells)]
    halves = [(corners[:, [0, 1, 2]].mean(axis=1), doubled(corners[:, 0], corners[:, 1], corners[:, 2])),
              (corners[:, [0, 2, 3]].mean(axis=1), doubled(corners[:, 0], corners[:, 2], corners[:, 3]))]
    whole = halves[0][1] + halves[1][1]
    return (halves[0][0] * halves[0][1][:, None] + halves[1][0] * halves[1][1][:, None]) / whole[:, None]


def doubled(a, b, c):
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def lengths(vectors):
    return np.hypot(vectors[..., 0], vectors[..., 1])


def largest_non_orthogonality(mesh, layers):
    """Degrees between an inner edge's normal and the line from one cell's centroid to the other's."""
    rows, n = layers.edges.rows, layers.edges.n
    a, b = rows[:, 0] // n, rows[:, 0] % n
    other, _ = layers.edges.find(b, a)
    inner = (other >= 0) & (a < b)
    centres = centroids_of(mesh.points, layers.edges.cells)
    between = centres[other[inner]] - centres[rows[inner, 1]]
    along = mesh.points[b[inner]] - mesh.points[a[inner]]
    normal = np.column_stack([along[:, 1], -along[:, 0]])
    cosine = (between * normal).sum(axis=1) / (lengths(between) * lengths(normal))
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).max())


def corners_of(points, left, right):
    """Places where the wall turns by more than 30 degrees, or ends."""
    after, before = dict(zip(left[:, 0], right[:, 0])), dict(zip(right[:, 0], left[:, 0]))
    places = [node for node in after if node not in before] + [node for node in before if node not in after]
    both = np.array([node for node in after if node in before], dtype=np.int64)
    u = points[both] - points[[before[n] for n in both]]
    v = points[[after[n] for n in both]] - points[both]
    turn = np.degrees(np.abs(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))))
    return points[np.concatenate([np.array(places, dtype=np.int64), both[turn > EXTENT_OF_CORNER]])]


def neighbour_ratios(ends):
    """Of the widths of columns that follow each other; `ends` has the points of the fronts' edges and their nodes."""
    nodes, widths = ends
    width_from = dict(zip(nodes[:, 0], widths))
    pairs = np.array([(w, width_from[b]) for (_, b), w in zip(nodes, widths) if b in width_from])
    return np.maximum(pairs[:, 0] / pairs[:, 1], pairs[:, 1] / pairs[:, 0])


def wall_figures(points, layers, first, growth, thickness):
    left, right = points[layers.left], points[layers.right]
    along = right[:, 0] - left[:, 0]
    width = lengths(along)
    normal = np.column_stack([-along[:, 1], along[:, 0]]) / width[:, None]
    height = lambda k: 0.5 * (((left[:, k] - left[:, 0]) * normal).sum(axis=1) + ((right[:, k] - right[:, 0]) * normal).sum(axis=1))
    full = height(-1) / thickness > 0.985
    off = np.abs(height(1) / first - 1)
    steps = np.stack([lengths(np.diff(side, axis=1)) for side in (left, right)])
    growths = steps[:, :, 1:] / steps[:, :, :-1]
    lines = np.stack([side[:, -1] - side[:, 0] for side in (left, right)])
    tilt = np.degrees(np.arccos(np.clip((lines * normal).sum(axis=2) / lengths(lines), -1, 1))).max(axis=0)
    corners = corners_of(points, layers.left, layers.right)
    far = np.ones(len(left), dtype=bool)
    for corner in corners:
        far &= lengths(0.5 * (left[:, 0] + right[:, 0]) - corner) > 2 * thickness
    return {"full": 100 * float(width[full].sum() / width.sum()),
            "least_height": float(height(-1).min() / thickness),
            "first_close": 100 * float((off < 0.005).mean()), "first_worst": float(off.max()),
            "growth_close": 100 * float((np.abs(growths / growth - 1) < 0.01).all(axis=(0, 2)).mean()),
            "growth_most": float(growths.max()), "growth_least": float(growths.min()),
            "tilt_far": float(tilt[far].max()) if far.any() else 0.0, "tilt_99": float(np.percentile(tilt, 99))}


def front_figures(points, layers):
    left, right = points[layers.left], points[layers.right]
    width = lengths(right[:, -1] - left[:, -1])
    last = 0.5 * (lengths(left[:, -1] - left[:, -2]) + lengths(right[:, -1] - right[:, -2]))
    outer, _ = layers.edges.find(layers.left[:, -1], layers.right[:, -1])
    inner, _ = layers.edges.find(layers.right[:, -1], layers.left[:, -1])
    areas = areas_of(points, layers.edges.cells)
    last_area = 0.5 * doubled(left[:, -2], right[:, -2], right[:, -1]) + 0.5 * doubled(left[:, -2], right[:, -1], left[:, -1])
    if (outer < 0).any() or (inner < 0).any():
        raise ValueError("an edge of the front has a cell on one side alone")
    outer_height = areas[outer] / width * np.where(layers.edges.sizes[outer] == 3, 2, 1)
    ratios = neighbour_ratios((np.column_stack([layers.left[:, -1], layers.right[:, -1]]), width))
    by_area = np.maximum(areas[outer] / last_area, last_area / areas[outer])
    return {"widths_95": float(np.percentile(ratios, 95)), "widths_most": float(ratios.max()),
            "outer_5": float(np.percentile(outer_height / last, 5)), "outer_95": float(np.percentile(outer_height / last, 95)),
            "outer_area": float(by_area.max())}


def figures_of(mesh, layers, first, growth, thickness):
    """All of them, by name. `thickness` is that asked for, all lengths in the mesh's own unit."""
    triangles, quads = len(mesh.triangles), len(mesh.quads)
    skew, least = np.empty(triangles + quads), np.empty(triangles + quads)
    for part, cells in ((slice(0, triangles), mesh.triangles), (slice(triangles, None), mesh.quads)):
        if len(cells):
            skew[part], least[part] = shapes_of(mesh.points, cells)
    inside = layers.in_layers
    return {"columns": len(layers.left), "incomplete": layers.incomplete, "layer_cells": int(inside.sum()), "outer_cells": int((~inside).sum()),
            **wall_figures(mesh.points, layers, first, growth, thickness), **front_figures(mesh.points, layers),
            "skew_most": float(skew[inside].max()), "skew_999": float(np.percentile(skew[inside], 99.9)),
            "outer_angle": float(least[~inside].min()), "orthogonality": largest_non_orthogonality(mesh, layers)}
