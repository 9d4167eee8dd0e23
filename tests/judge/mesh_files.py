"""Reads meshes and outlines for the judge: native files, CGNS files (as HDF5, with no help from libcgns), `.geom` files. Written from the
formats' descriptions alone: it shares nothing with the program. numpy; h5py for CGNS."""
import re
from dataclasses import dataclass, field
from math import comb
from pathlib import Path

import numpy as np

NODES_OF_ELEMENT = {3: 2, 5: 3, 7: 4}  # BAR_2, TRI_3, QUAD_4 of the SIDS


class Unreadable(Exception):
    """The file is not what its format demands."""


def no_rows(width):
    return np.empty((0, width), dtype=np.int64)


@dataclass
class Mesh:
    """Nodes from 0; boundaries are directed edges (from, to) under their name; `of_cells` has the block of each cell,
    triangles first; None: there is one block."""
    points: np.ndarray
    triangles: np.ndarray = field(default_factory=lambda: no_rows(3))
    quads: np.ndarray = field(default_factory=lambda: no_rows(4))
    boundaries: dict = field(default_factory=dict)
    blocks: tuple = ("domain",)
    of_cells: np.ndarray = None

    def block_of(self):
        return np.zeros(len(self.triangles) + len(self.quads), dtype=np.int64) if self.of_cells is None else self.of_cells

    def kinds(self):
        return (self.triangles, self.quads)


class Rows:
    """The lines of a text file that hold values, and the comment before each."""

    def __init__(self, path):
        self.path_ = path
        self.lines_ = [line.strip() for line in Path(path).read_text(encoding="utf-8").splitlines()]
        self.at_ = 0
        self.comment = ""
        self.comments = []

    def next(self):
        while self.at_ < len(self.lines_):
            line = self.lines_[self.at_]
            self.at_ += 1
            if line.startswith("#"):
                self.comment = line
                self.comments.append(line)
            elif line:
                return line.split()
        raise Unreadable(f"{self.path_} ends early")

    def count(self):
        words = self.next()
        if len(words) != 1 or not words[0].isdigit():
            raise Unreadable(f"{self.path_}:{self.at_}: '{' '.join(words)}' is no count")
        return int(words[0])

    def table(self, width, kind, count=None):
        rows = [self.next() for _ in range(self.count() if count is None else count)]
        if any(len(row) != width for row in rows):
            raise Unreadable(f"{self.path_}: a row before line {self.at_} has not {width} values")
        try:
            return np.array(rows, dtype=object).astype(kind).reshape(-1, width)
        except ValueError as error:
            raise Unreadable(f"{self.path_}: before line {self.at_}: {error}") from error

    def at_end(self):
        return all(not line or line.startswith("#") for line in self.lines_[self.at_:])


def set_cells(mesh, triangles, quads, names):
    """The cells, given block by block."""
    mesh.triangles = np.concatenate([no_rows(3), *triangles])
    mesh.quads = np.concatenate([no_rows(4), *quads])
    mesh.blocks = tuple(names)
    mesh.of_cells = np.concatenate([np.full(len(cells), block) for kind in (triangles, quads) for block, cells in enumerate(kind)])


def read_native(path):
    rows = Rows(path)
    mesh = Mesh(rows.table(2, float))
    triangles, quads, names = [], [], []
    count = rows.count()
    for number in range(1, count + 1):
        rows.comments = []
        triangles.append(rows.table(3, np.int64) - 1)
        given = [comment[len("# block "):] for comment in rows.comments if comment.startswith("# block ")]
        names.append(given[-1] if given else f"block_{number}" if count > 1 else "domain")
        quads.append(rows.table(4, np.int64) - 1)
    set_cells(mesh, triangles, quads, names)
    for number in range(1, rows.count() + 1):
        count = rows.count()
        named = re.search(r"boundary +\d+ +\((.*)\)$", rows.comment)
        name = named[1] if named else f"boundary_{number}"
        mesh.boundaries[name] = np.concatenate([mesh.boundaries.get(name, no_rows(2)), rows.table(2, np.int64, count) - 1])
    if not rows.at_end():  # a solver's solution
        rows.table(1, float)
        rows.table(rows.count(), float, len(mesh.points))
    if not rows.at_end():
        raise Unreadable(f"{path} goes on after its end")
    return checked(mesh, path)


def text_of(node):
    return "" if node is None or " data" not in node else bytes(node[" data"][()].astype(np.uint8)).decode().strip("\0 ")


def children(node, label):
    found = [child for child in node.values() if hasattr(child, "attrs") and child.attrs.get("label", b"").decode() == label]
    return sorted(found, key=lambda child: child.name)


def only_child(node, label, path):
    found = children(node, label)
    if len(found) != 1:
        raise Unreadable(f"{path}: {node.name} has {len(found)} nodes {label}, not one")
    return found[0]


def short_name(node):
    return node.name.rsplit("/", 1)[-1]


def element_tables(zone, path):
    """[first number, last number, type, rows] of each section, from the first on."""
    tables = []
    for section in children(zone, "Elements_t"):
        kind = int(section[" data"][0])
        if kind not in NODES_OF_ELEMENT:
            raise Unreadable(f"{path}: section {short_name(section)} has elements of type {kind}")
        first, last = (int(n) for n in np.ravel(section["ElementRange/ data"][()]))
        rows = section["ElementConnectivity/ data"][()].astype(np.int64).reshape(-1, NODES_OF_ELEMENT[kind]) - 1
        if last - first + 1 != len(rows):
            raise Unreadable(f"{path}: section {short_name(section)} has {len(rows)} elements, its range is {first} to {last}")
        tables.append((first, last, kind, rows))
    tables.sort(key=lambda table: table[0])
    if [t[0] for t in tables[1:]] != [t[1] + 1 for t in tables[:-1]] or (tables and tables[0][0] != 1):
        raise Unreadable(f"{path}: the sections' ranges do not follow one another from 1 on")
    return tables


def numbers_of_condition(condition):
    """The elements that a boundary condition names, by range or by list."""
    if "PointRange" in condition:
        first, last = (int(n) for n in np.ravel(condition["PointRange/ data"][()]))
        return np.arange(first, last + 1)
    return np.ravel(condition["PointList/ data"][()]).astype(np.int64)


def read_boundaries(zone, tables, path):
    """{name: edges}; each edge belongs to one condition."""
    edges = np.concatenate([no_rows(2), *(t[3] for t in tables if t[2] == 3)])
    numbers = np.concatenate([np.empty(0, dtype=np.int64), *(np.arange(t[0], t[1] + 1) for t in tables if t[2] == 3)])
    boundaries, named = {}, [np.empty(0, dtype=np.int64)]
    for condition in (c for group in children(zone, "ZoneBC_t") for c in children(group, "BC_t")):
        wanted = numbers_of_condition(condition)
        if not np.isin(wanted, numbers).all():
            raise Unreadable(f"{path}: boundary {short_name(condition)} names elements that are no edges")
        name = text_of(condition.get("FamilyName")) or short_name(condition)
        boundaries[name] = np.concatenate([boundaries.get(name, no_rows(2)), edges[np.searchsorted(numbers, wanted)]])
        named.append(wanted)
    if not np.array_equal(np.sort(np.concatenate(named)), numbers):
        raise Unreadable(f"{path}: some edges belong to no boundary condition, or to two")
    return boundaries


def read_zone(zone, path):
    """Points, triangles, quads, boundaries and, for each other zone, the nodes here and there that are one: all numbered in the zones."""
    nodes, cells = (int(n) for n in np.ravel(zone[" data"][()])[:2])
    points = np.column_stack([zone[f"GridCoordinates/Coordinate{axis}/ data"][()] for axis in "XY"])
    tables = element_tables(zone, path)
    triangles, quads = (np.concatenate([no_rows(width), *(t[3] for t in tables if t[2] == kind)]) for kind, width in ((5, 3), (7, 4)))
    if (len(points), len(triangles) + len(quads)) != (nodes, cells):
        raise Unreadable(f"{path}: the zone tells of {nodes} nodes and {cells} cells and holds other numbers of them")
    return points, triangles, quads, read_boundaries(zone, tables, path), read_connections(zone, path)


def read_connections(zone, path):
    found = {}
    for connection in (c for group in children(zone, "ZoneGridConnectivity_t") for c in children(group, "GridConnectivity_t")):
        if text_of(connection["GridConnectivityType"]) != "Abutting1to1" or text_of(connection["GridLocation"]) != "Vertex":
            raise Unreadable(f"{path}: {connection.name} does not connect vertex with vertex")
        here, there = (np.ravel(connection[f"{name}/ data"][()]).astype(np.int64) - 1 for name in ("PointList", "PointListDonor"))
        if len(here) != len(there):
            raise Unreadable(f"{path}: {connection.name} connects {len(here)} nodes with {len(there)}")
        if text_of(connection) != short_name(zone):  # else the two sides of a periodic pair
            found[text_of(connection)] = (here, there)
    return found


def glue(zones, names, path):
    """For each zone the numbers of its nodes in the whole mesh: that of the first zone that has the node, by the lists on both sides."""
    starts = np.cumsum([0, *(len(zone[0]) for zone in zones)])
    first = np.arange(starts[-1])
    for number, zone in enumerate(zones):
        for donor, (here, there) in zone[4].items():
            if donor not in names:
                raise Unreadable(f"{path}: zone {names[number]} is connected with '{donor}', which there is not")
            other = names.index(donor)
            back = zones[other][4].get(names[number], (no_rows(1), no_rows(1)))
            if {*zip(here.tolist(), there.tolist())} != {*zip(back[1].tolist(), back[0].tolist())}:
                raise Unreadable(f"{path}: zones {names[number]} and {donor} list different nodes")
            if not np.array_equal(zone[0][here], zones[other][0][there]):
                raise Unreadable(f"{path}: connected nodes of {names[number]} and {donor} lie at different places")
            if other < number:
                first[starts[number] + here] = np.minimum(first[starts[number] + here], first[starts[other] + there])
    kept, numbers = np.unique(first, return_inverse=True)
    return kept, [numbers[a:b] for a, b in zip(starts[:-1], starts[1:])]


def read_cgns(path):
    """Several zones are one mesh: connected nodes are one, and an edge of two zones is that of the first."""
    import h5py
    with h5py.File(path, "r") as file:
        base = only_child(file, "CGNSBase_t", path)
        found = sorted(children(base, "Zone_t"), key=lambda zone: base.id.links.get_info(short_name(zone).encode()).corder)
        names = [short_name(zone) for zone in found]
        blocks = [text_of(zone.get("FullName")) or short_name(zone) for zone in found]
        zones = [read_zone(zone, path) for zone in found]
    if not zones:
        raise Unreadable(f"{path} has no zone")
    for zone in zones:
        checked(Mesh(zone[0], zone[1], zone[2], zone[3]), path)
    kept, numbers = glue(zones, names, path)
    mesh = Mesh(np.concatenate([zone[0] for zone in zones])[kept])
    set_cells(mesh, [n[zone[1]] for n, zone in zip(numbers, zones)], [n[zone[2]] for n, zone in zip(numbers, zones)], blocks)
    taken = set()
    for own, zone in zip(numbers, zones):
        for name, edges in zone[3].items():
            rows = own[edges]
            new = np.array([(b, a) not in taken for a, b in rows.tolist()], dtype=bool)
            taken.update(map(tuple, rows.tolist()))
            if new.any() or not len(rows):
                mesh.boundaries[name] = np.concatenate([mesh.boundaries.get(name, no_rows(2)), rows[new]])
    return checked(mesh, path)


def checked(mesh, path):
    """The mesh, of whose tables no index leads out."""
    for table in (mesh.triangles, mesh.quads, *mesh.boundaries.values()):
        if table.size and (table.min() < 0 or table.max() >= len(mesh.points)):
            raise Unreadable(f"{path}: a node that there is not, of {len(mesh.points)}")
    return mesh


def read_mesh(path):
    readers = {".mesh": read_native, ".cgns": read_cgns}
    suffix = Path(path).suffix
    if suffix not in readers:
        raise Unreadable(f"{path}: only {' and '.join(readers)} are judged")
    return readers[suffix](path)


FLATNESS = 1e-10  # of the outline's extent: how far a curve may be from the lines between the points that stand for it


def read_geometry(path):
    """{name: [(closed, points)]} of a `.geom` file. Many points stand for a curve."""
    rows = Rows(path)
    chains = []
    for _ in range(rows.count()):
        name, *kind = rows.next()
        chains.append((name, kind != ["open"], [segment(rows.next(), path) for _ in range(rows.count())]))
    poles = np.concatenate([poles for _, _, segments in chains for poles, _ in segments])
    tolerance = FLATNESS * float(np.ptp(poles, axis=0).max())
    found = {}
    for name, closed, segments in chains:
        starts = np.array([poles[0] for poles, _ in segments])
        pieces = [points_of(np.vstack([poles, end]), weights, tolerance)
                  for (poles, weights), end in zip(segments, np.roll(starts, -1, axis=0))]
        if not closed:
            pieces[-1] = starts[-1:]
        found.setdefault(name, []).append((closed, np.concatenate(pieces)))
    return found


def distances_from(path, name, points):
    """The distances of points from the boundaries of one name in a `.geom` file, to rounding; infinite for points far from them. No curve turns
    by 90 degrees, so that each has one point above a point of its chord."""
    rows = Rows(path)
    points = np.asarray(points, float)
    nearest = np.full(len(points), np.inf)
    for _ in range(rows.count()):
        chain, *kind = rows.next()
        segments = [segment(rows.next(), path) for _ in range(rows.count())]
        if chain != name:
            continue
        for (poles, weights), (end, _) in list(zip(segments, segments[1:] + segments[:1]))[:-1 if kind == ["open"] else None]:
            poles = np.vstack([poles, end[:1]])
            margin = np.ptp(poles, axis=0).max()
            near = np.all((points >= poles.min(axis=0) - margin) & (points <= poles.max(axis=0) + margin), axis=1)
            nearest[near] = np.minimum(nearest[near], distances_from_curve(poles, weights, points[near]))
    return nearest


def distances_from_curve(poles, weights, points):
    """The distances of points from the points of a curve above the same points of its chord, which bisection finds."""
    chord = poles[-1] - poles[0]
    low, high = np.zeros(len(points)), np.ones(len(points))
    for _ in range(60):
        middle = (low + high) / 2
        beyond = (points_at(poles, weights, middle) - points) @ chord > 0
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.linalg.norm(points_at(poles, weights, high) - points, axis=1)


def segment(row, path):
    """A point of a chain with the control points of the curve to the next point, if it is one, and their weights."""
    try:
        if len(row) == 2:
            return np.array([row], float), None
        if len(row) < 4 or row[2] != "curve":
            raise ValueError("no segment")
        words = " ".join(row[3:]).split("spacing")[0].split("weights")
        inner = np.array(words[0].split(), float).reshape(-1, 2)
        return np.vstack([np.array(row[:2], float), inner]), np.array(words[1].split(), float) if len(words) > 1 else None
    except ValueError as error:
        raise Unreadable(f"{path}: '{' '.join(row)}': {error}") from error


def points_of(poles, weights, tolerance):
    """Points of a rational Bezier curve, without the last one."""
    degree = len(poles) - 1
    if degree == 1:
        return poles[:1]
    weights = np.ones(len(poles)) if weights is None else weights
    bend = degree * (degree - 1) / 8 * np.abs(np.diff(poles, 2, axis=0)).max() * (weights.max() / weights.min()) ** 2
    count = max(1, int(np.ceil(np.sqrt(2 * bend / tolerance))))
    return points_at(poles, weights, np.arange(count) / count)


def points_at(poles, weights, t):
    """The points of a rational Bezier curve at parameters (its Bernstein form)."""
    degree, t = len(poles) - 1, t[:, None]
    bernstein = np.array([comb(degree, i) for i in range(degree + 1)]) * t ** np.arange(degree + 1) * (1 - t) ** (degree - np.arange(degree + 1))
    shares = bernstein * (1 if weights is None else weights)
    return (shares @ poles) / shares.sum(axis=1)[:, None]
