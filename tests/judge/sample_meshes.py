"""Small meshes for the judge's own tests, and files of them, written by nobody else's code."""
import numpy as np

from mesh_files import Mesh, no_rows


def table(rows, width):
    return np.array(rows, dtype=np.int64).reshape(-1, width) if len(rows) else no_rows(width)


def frame(triangles_alone=False):
    """The square from 0 to 4 without its middle, the square from 1 to 3: quads of edge 1 and, above y = 3 or everywhere, triangles."""
    number = {}
    points, triangles, quads = [], [], []

    def node(x, y):
        if (x, y) not in number:
            number[x, y] = len(points)
            points.append((float(x), float(y)))
        return number[x, y]
    for y in range(4):
        for x in range(4):
            if 1 <= x < 3 and 1 <= y < 3:
                continue
            a, b, c, d = node(x, y), node(x + 1, y), node(x + 1, y + 1), node(x, y + 1)
            if triangles_alone or y == 3:
                triangles += [(a, b, c), (a, c, d)]
            else:
                quads.append((a, b, c, d))
    outer = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 1), (4, 2), (4, 3), (4, 4), (3, 4), (2, 4), (1, 4), (0, 4), (0, 3), (0, 2), (0, 1)]
    inner = [(1, 1), (1, 2), (1, 3), (2, 3), (3, 3), (3, 2), (3, 1), (2, 1)]
    loops = {name: [number[p] for p in loop] for name, loop in (("outer", outer), ("inner", inner))}
    boundaries = {name: np.array(list(zip(loop, loop[1:] + loop[:1]))) for name, loop in loops.items()}
    return Mesh(np.array(points), table(triangles, 3), table(quads, 4), boundaries)


def two_blocks():
    """The square from 0 to 4, the square from 1 to 3 in it a block of its own: quads of edge 1."""
    mesh = frame()
    number = {tuple(p): i for i, p in enumerate(mesh.points.tolist())}
    middle = number.setdefault((2.0, 2.0), len(number))
    inner = table([(number[x, y], number[x + 1, y], number[x + 1, y + 1], number[x, y + 1]) for y in (1.0, 2.0) for x in (1.0, 2.0)], 4)
    assert middle == len(mesh.points)
    blocks = np.repeat([0, 0, 1], [len(mesh.triangles), len(mesh.quads), len(inner)])
    return Mesh(np.vstack([mesh.points, [2, 2]]), mesh.triangles, np.vstack([mesh.quads, inner]), mesh.boundaries, ("ring", "core"), blocks)


def outline_of_two_blocks():
    """The line between the blocks in both directions."""
    outline = outline_of_frame()
    (_, points), = outline["inner"]
    outline["inner"].append((True, points[::-1].copy()))
    return outline


def outline_of_frame():
    """As `read_geometry` would give it."""
    return {"outer": [(True, np.array([(0.0, 0), (4, 0), (4, 4), (0, 4)]))], "inner": [(True, np.array([(1.0, 1), (1, 3), (3, 3), (3, 1)]))]}


def squares(*places):
    """Quads of edge `size` from (x, y) on, each a loop of its own; nodes at one place are one."""
    number, quads, boundaries = {}, [], {}
    for i, (x, y, size) in enumerate(places):
        loop = [number.setdefault(p, len(number)) for p in ((x, y), (x + size, y), (x + size, y + size), (x, y + size))]
        quads.append(loop)
        boundaries[f"loop_{i}"] = np.array(list(zip(loop, loop[1:] + loop[:1])))
    return Mesh(np.array(list(number), dtype=float), no_rows(3), table(quads, 4), boundaries)


def double_fan():
    """Triangles that go twice round one node, on a spiral that ends where it began."""
    steps = 16
    angles = np.arange(steps) * 4 * np.pi / steps
    radii = 1 + np.where(np.arange(steps) <= steps // 2, np.arange(steps), steps - np.arange(steps)) * 0.1
    points = np.vstack([[0, 0], np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])])
    ring = [(1 + i, 1 + (i + 1) % steps) for i in range(steps)]
    return Mesh(points, table([(0, a, b) for a, b in ring], 3), no_rows(4), {"rim": np.array(ring)})


def two_triangles(height):
    """A rhombus about the x axis, divided by its diagonal along that axis: Delaunay where `height` is at least 1."""
    points = np.array([(-1.0, 0), (1, 0), (0, height), (0, -height)])
    return Mesh(points, table([(0, 1, 2), (1, 0, 3)], 3), no_rows(4), {"rim": np.array([(1, 2), (2, 0), (0, 3), (3, 1)])})


def native_text(mesh):
    def rows(cells):
        return [str(len(cells)), *(" ".join(str(n + 1) for n in cell) for cell in cells)]
    lines = ["#Number of grid points", str(len(mesh.points)), *(f"{float(x)!r} {float(y)!r}" for x, y in mesh.points), "#Number of blocks",
             str(len(mesh.blocks))]
    for block, name in enumerate(mesh.blocks):
        triangles, quads = (cells[of == block] for cells, of in zip(mesh.kinds(), np.split(mesh.block_of(), [len(mesh.triangles)])))
        lines += [f"# block {name}"] * (mesh.of_cells is not None) + ["#Number of triangular elements", *rows(triangles), "#Number of quadrilateral elements", *rows(quads)]
    lines += ["#Number of boundaries", str(len(mesh.boundaries))]
    for i, (name, edges) in enumerate(mesh.boundaries.items()):
        lines += [f"#Number of edges for boundary {i + 1} ({name})", *rows(edges)]
    return "\n".join(lines) + "\n"


def write_cgns(mesh, path):
    """What the judge reads of a CGNS file: one base, one zone, sections TRI_3, QUAD_4 and BAR_2, a condition for each boundary."""
    import h5py
    first = 1

    def add(parent, name, label, data=None):
        node = parent.create_group(name)
        node.attrs["label"] = np.bytes_(label)
        if data is not None:
            node[" data"] = np.frombuffer(data.encode(), dtype=np.int8) if isinstance(data, str) else data
        return node

    def add_section(zone, name, kind, rows):
        nonlocal first
        section = add(zone, name, "Elements_t", np.array([kind, 0]))
        span = [first, first + len(rows) - 1]
        add(section, "ElementRange", "IndexRange_t", np.array(span))
        add(section, "ElementConnectivity", "DataArray_t", np.ravel(rows) + 1)
        first += len(rows)
        return span
    with h5py.File(path, "w") as file:
        base = add(file, "Base", "CGNSBase_t", np.array([2, 2]))
        zone = add(base, "domain", "Zone_t", np.array([[len(mesh.points)], [len(mesh.triangles) + len(mesh.quads)], [0]]))
        grid = add(zone, "GridCoordinates", "GridCoordinates_t")
        for axis, values in zip("XY", mesh.points.T):
            add(grid, f"Coordinate{axis}", "DataArray_t", values)
        add_section(zone, "TRI_3", 5, mesh.triangles)
        add_section(zone, "QUAD_4", 7, mesh.quads)
        conditions = add(zone, "ZoneBC", "ZoneBC_t")
        for name, edges in mesh.boundaries.items():
            condition = add(conditions, name, "BC_t", "BCWall")
            add(condition, "FamilyName", "FamilyName_t", name)
            add(condition, "PointRange", "IndexRange_t", np.array(add_section(zone, name, 3, edges)).reshape(2, 1))
