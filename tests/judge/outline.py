"""A mesh against the outline that it was made for."""
import numpy as np

SHARP = np.radians(30)  # a point of the outline that turns by more is a corner
ON_OUTLINE = 1e-9  # of the outline's extent
BLOCK_AREA = 0.02  # how much the area of a block may differ from the outline's, relative
SQUARES = 64  # of the grid, each way, in which nodes look for their segments


def check(mesh, geometry, corners):
    """(rule, what) of each fault: the outline's boundaries are all there, their nodes lie on them and, if asked, their sharp corners are nodes."""
    missing, unknown = set(geometry) - set(mesh.boundaries), set(mesh.boundaries) - set(geometry)
    faults = [("every boundary of the outline is the mesh's", f"'{name}'") for name in sorted(missing)]
    faults += [("every boundary of the mesh is the outline's", f"'{name}'") for name in sorted(unknown)]
    everything = np.concatenate([points for chains in geometry.values() for _, points in chains])
    tolerance = ON_OUTLINE * float(np.ptp(everything, axis=0).max())
    for name in sorted(set(geometry) & set(mesh.boundaries)):
        nodes = mesh.points[np.unique(mesh.boundaries[name])]
        away = distances(nodes, *segments(geometry[name]))
        worst = int(away.argmax())
        if away[worst] > tolerance:
            faults.append(("boundary nodes lie on the outline", f"'{name}': ({nodes[worst][0]!r}, {nodes[worst][1]!r}) by {away[worst]:g}"))
        lost = [] if not corners else [c for closed, points in geometry[name] for c in sharp_corners(closed, points)
                                       if np.abs(nodes - c).max(axis=1).min() > tolerance]
        faults += [("sharp corners are nodes", f"'{name}': ({c[0]!r}, {c[1]!r})") for c in lost]
    return faults


def check_blocks(mesh, geometry, areas, beside):
    """(rule, what) of each block whose area is not the one that the outline encloses. The outline has the domain on its left, and lines
    between two blocks twice; which block that is tells the mesh's edge nearby. `areas`: of the mesh's blocks by name; `beside(edges)`: the
    blocks left and right of edges."""
    found = np.zeros(len(mesh.blocks))
    for name in sorted(set(geometry) & set(mesh.boundaries)):
        edges = mesh.boundaries[name]
        left, right = beside(edges)
        tails, heads = mesh.points[edges[:, 0]], mesh.points[edges[:, 1]]
        a, b = segments(geometry[name])
        away = np.linalg.norm((a + b)[:, None, :] - (tails + heads), axis=2)
        near = away.argmin(axis=1)
        same = ((heads - tails)[near] * (b - a)).sum(axis=1) > 0
        block = np.where(same, left[near], right[near])
        if (block < 0).any():
            return [("lines between two blocks have cells on both sides", f"'{name}'")]
        np.add.at(found, block, (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2)
    return [("areas of blocks", f"'{name}': {areas[name]:g}, in the outline {outlined:g}") for name, outlined in zip(mesh.blocks, found)
            if not abs(areas[name] - outlined) <= BLOCK_AREA * abs(areas[name])]


def segments(chains):
    starts, ends = [], []
    for closed, points in chains:
        last = len(points) if closed else len(points) - 1
        starts.append(points[:last])
        ends.append(np.roll(points, -1, axis=0)[:last])
    return np.concatenate(starts), np.concatenate(ends)


def distances(nodes, a, b):
    """From each node to the nearest segment: the nearest of those whose boxes reach into the node's square of a grid, if any do, else of all."""
    low, edge = nodes.min(axis=0), max(float(np.ptp(nodes, axis=0).max()) / SQUARES, np.finfo(float).tiny)

    def square_of(points):
        return np.clip(np.floor((points - low) / edge), -1, SQUARES + 1).astype(np.int64)
    first, last = square_of(np.minimum(a, b) - 1e-3 * edge), square_of(np.maximum(a, b) + 1e-3 * edge)
    reaching = {}
    for segment, ((x0, y0), (x1, y1)) in enumerate(zip(first.tolist(), last.tolist())):
        for x in range(x0, x1 + 1):
            for y in range(y0, y1 + 1):
                reaching.setdefault((x, y), []).append(segment)
    together = {}
    for node, square in enumerate(map(tuple, square_of(nodes).tolist())):
        together.setdefault(square, []).append(node)
    result = np.empty(len(nodes))
    for square, members in together.items():
        near = reaching.get(square, slice(None))
        result[members] = nearest(nodes[members], a[near], b[near])
    return result


def nearest(nodes, a, b):
    along = b - a
    lengths = np.maximum((along * along).sum(axis=1), np.finfo(float).tiny)
    to_node = nodes[:, None, :] - a
    share = np.clip((to_node * along).sum(axis=2) / lengths, 0, 1)
    off = to_node - share[:, :, None] * along
    return np.sqrt((off * off).sum(axis=2).min(axis=1))


def sharp_corners(closed, points):
    before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    turn = np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    sharp = np.abs(turn) > SHARP
    if not closed:
        sharp[[0, -1]] = False
    return points[sharp]
