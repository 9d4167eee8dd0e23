"""Whether cells that fit together edge by edge also cover their domain once: nothing folded over, no boundary across another."""
import numpy as np

import exact

TURN = 2 * np.pi
ANGLE_TOLERANCE = 1e-6  # radians: far above rounding, far below the whole turn by which a fold differs


def check(mesh, boundary):
    """(rule, what) of each fault; cells must be convex and fit together. `boundary`: the edges of one cell."""
    faults = [("cells go once round a node", f"node {n + 1} ({mesh.points[n][0]!r}, {mesh.points[n][1]!r})") for n in wrong_turns(mesh, boundary)]
    faults += [("boundaries meet at nodes alone", f"edges {a} and {b}") for a, b in crossings(mesh.points, boundary)]
    return faults or [("the domain is covered once", f"{times} cells cover the place beside edge {edge}") for edge, times in covers(mesh, boundary)]


def angles_at_nodes(mesh):
    sums = np.zeros(len(mesh.points))
    for cells in mesh.kinds():
        width = cells.shape[1]
        for k in range(width):
            p, q, r = (mesh.points[cells[:, (k + i) % width]] for i in (0, 1, -1))
            u, v = q - p, r - p
            np.add.at(sums, cells[:, k], np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1)))
    return sums


def wrong_turns(mesh, boundary):
    """Nodes round which the cells' angles do not make up a whole turn, or on a boundary the angle between its edges."""
    sums = angles_at_nodes(mesh)
    expected = np.full(len(mesh.points), TURN)
    leaving = np.bincount(boundary[:, 0], minlength=len(mesh.points))
    after, before = np.zeros((2, len(mesh.points)), dtype=np.int64)
    after[boundary[:, 0]], before[boundary[:, 1]] = boundary[:, 1], boundary[:, 0]
    once = np.flatnonzero(leaving == 1)
    u, v = mesh.points[after[once]] - mesh.points[once], mesh.points[before[once]] - mesh.points[once]
    between = np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
    expected[once] = np.where(between > 0, between, between + TURN)
    wrong = np.abs(sums - expected) > ANGLE_TOLERANCE
    several = leaving > 1  # loops that touch: less than a turn in all
    return np.flatnonzero(np.where(several, sums > TURN + ANGLE_TOLERANCE, wrong))


def crossings(points, edges):
    """Pairs of boundary edges that have more in common than an end."""
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    low, high = np.minimum(a, b), np.maximum(a, b)
    order = np.argsort(low[:, 0], kind="stable")
    first_x = low[order, 0]
    for rank, e in enumerate(order):
        later = order[rank + 1:np.searchsorted(first_x, high[e, 0], side="right")]
        later = later[(low[later, 1] <= high[e, 1]) & (high[later, 1] >= low[e, 1])]
        for f in later:
            if edges_meet(points, edges[e], edges[f]):
                yield tuple(edges[e] + 1), tuple(edges[f] + 1)


def edges_meet(points, e, f):
    """Whether two edges meet elsewhere than at a common end. Exact."""
    def turn(p, q, r):
        return int(exact.orientations(points[[p]], points[[q]], points[[r]])[0])
    common = set(e.tolist()) & set(f.tolist())
    if len(common) == 2:
        return True
    if common:
        hub, = common
        p, q = (next(n for n in edge.tolist() if n != hub) for edge in (e, f))
        return turn(hub, p, q) == 0 and float((points[p] - points[hub]) @ (points[q] - points[hub])) > 0
    (a, b), (c, d) = e.tolist(), f.tolist()
    ends = turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)
    if any(ends):
        return ends[0] * ends[1] <= 0 and ends[2] * ends[3] <= 0
    return True  # on one line, and their boxes meet


def covers(mesh, boundary):
    """(edge, how many cells) beside one edge of each boundary loop where these are not one. As no two boundaries cross, a part of the plane that is
    covered more than once is bounded by whole loops, and the part covered most lies on the left of all its own."""
    cell_beside = {}
    for cells in mesh.kinds():
        for k in range(cells.shape[1]):
            ends = zip(cells[:, k].tolist(), cells[:, (k + 1) % cells.shape[1]].tolist())
            cell_beside.update({edge: cell for edge, cell in zip(ends, cells)})
    boxes = [(mesh.points[cells].min(axis=1), mesh.points[cells].max(axis=1)) for cells in mesh.kinds()]
    for edge in first_edges(boundary):
        middle = mesh.points[list(edge)].mean(axis=0)
        place = middle + 0.01 * (mesh.points[cell_beside[edge]].mean(axis=0) - middle)
        times = sum(cells_over(mesh.points, cells, box, place) for cells, box in zip(mesh.kinds(), boxes))
        if times != 1:
            yield (edge[0] + 1, edge[1] + 1), times


def first_edges(boundary):
    """One edge of each connected part of the boundaries."""
    leaving = {}
    for a, b in boundary.tolist():
        leaving.setdefault(a, []).append(b)
    seen = set()
    for a, b in boundary.tolist():
        if a in seen:
            continue
        yield a, b
        stack = [a]
        while stack:
            node = stack.pop()
            if node not in seen:
                seen.add(node)
                stack += leaving.get(node, [])


def cells_over(points, cells, boxes, place):
    """How many cells hold the place in their inside."""
    low, high = boxes
    near = cells[(low[:, 0] < place[0]) & (place[0] < high[:, 0]) & (low[:, 1] < place[1]) & (place[1] < high[:, 1])]
    inside = np.ones(len(near), dtype=bool)
    width = cells.shape[1]
    for k in range(width):
        u, v = points[near[:, (k + 1) % width]] - points[near[:, k]], place - points[near[:, k]]
        inside &= u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0
    return int(inside.sum())
