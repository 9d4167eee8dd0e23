"""Meshes as arrays."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from . import _core
from ._cases import Case, points_of
from ._common import collective, communicator_of, handle_of, numbers_of, path_of, reporter, require, warn
from ._core import InputError


@dataclasses.dataclass(frozen=True)
class Quality:
    """Numbers of cells over all ranks, and the quality of their shapes: 1 for the best, 0 for a degenerate cell, near 0 for flat cells in layers. Angles in degrees."""
    nodes: int
    triangles: int
    quads: int
    boundary_edges: int
    smallest_angle: float
    largest_angle: float
    worst_quality: float
    mean_quality: float


@dataclasses.dataclass(frozen=True)
class LayerReport:
    """The layers of one boundary or line, over all ranks. Lengths in the unit of the geometry, normal to the wall.

    boundary        name of the boundary or line
    count           requested number of layers
    count_reached   number of layers in the column with the fewest
    columns         number of columns of layer cells
    y_plus          requested y+ of the first layer, from which its heights follow; 0: heights are given
    first           smallest first height
    growth          smallest growth ratio
    thickness       requested thickness of all layers together
    smallest_share  of the requested thickness that the thinnest column has
    coverage        share of the length of the wall with the requested thickness, from 0 to 1
    thinnest_at     (x, y) of the thinnest column
    """
    boundary: str
    count: int
    count_reached: int
    columns: int
    y_plus: float
    first: float
    growth: float
    thickness: float
    smallest_share: float
    coverage: float
    thinnest_at: tuple


class Mesh:
    """A mesh, or the part of it that belongs to this rank. Arrays are read-only views, without copies.

    points      (n, 2) float64: the `owned` nodes of this rank, then copies of other ranks' nodes that its cells use
    triangles   (t, 3) int32: rows of `points`, counter-clockwise
    quads       (q, 4) int32
    edges       boundary -> (e, 2) int32, with the domain to the left
    conditions  boundary -> its boundary condition, "none" without one
    blocks      {"names", "triangles", "quads"}: the block of each cell as index into the names; empty for one block
    named_nodes name -> global number of a node
    global_ids  (n,) int64: the number of each node over all ranks
    """

    def __init__(self, core, warnings=()):
        self._core = core
        self._number = core.comm.next_number()  # the same on all ranks
        self.warnings = list(warnings)

    points = property(lambda self: self._core.points)
    triangles = property(lambda self: self._core.triangles)
    quads = property(lambda self: self._core.quads)
    edges = property(lambda self: self._core.edges)
    conditions = property(lambda self: self._core.conditions)
    blocks = property(lambda self: self._core.blocks)
    named_nodes = property(lambda self: self._core.named_nodes)
    global_ids = property(lambda self: self._core.global_ids)
    owned = property(lambda self: self._core.owned)

    @property
    def cell_ids(self) -> np.ndarray:
        """The number of each cell over all ranks, triangles, then quads. On several ranks: collective."""
        self._meet("Mesh.cell_ids")
        return self._core.cell_ids()

    @property
    def layers(self) -> dict:
        """The layers of each boundary and line that has some, as LayerReport."""
        return {row["boundary"]: LayerReport(**row) for row in self._core.layers()}

    @property
    def quality(self) -> Quality:
        """On several ranks: collective."""
        self._meet("Mesh.quality")
        return Quality(**self._core.quality())

    @property
    def nodes(self) -> int:
        """Number of nodes over all ranks. On several ranks: collective."""
        return self.quality.nodes

    def check(self) -> list:
        """One line for each fault of the mesh, with its place; empty for a valid mesh. On several ranks: collective."""
        self._meet("Mesh.check()")
        return self._core.check()

    def gathered(self) -> "Mesh":
        """The whole mesh on rank 0, an empty one on the others. On several ranks: collective."""
        self._meet("Mesh.gathered()")
        return Mesh(self._core.gathered(), self.warnings)

    def write(self, path, solution: Mapping | None = None):
        """Writes the mesh, with a solution if the format can hold it; the suffix selects the format. On several ranks: collective.

        solution  variable -> a value for each owned node, or for each cell (triangles, then quads)
        """
        with self._collective("Mesh.write()") as call:
            path, rows = path_of(path), self._rows(call, solution)
            call.same(path=path)
        warn(self._core.write(path, rows), self._core.comm.rank)

    def _collective(self, call: str) -> collective:
        return collective(self._core.comm, call, number_of_the_mesh=self._number)

    def _rows(self, call: collective, solution) -> _core._Tables:
        """A solution as tables, of the same variables on all ranks."""
        rows = rows_of(self, solution)
        call.same(variables=(rows[0], rows[2]))
        return rows

    def _meet(self, call: str):
        with self._collective(call):
            pass

    def extrude(self, path, heights, solution: Mapping | None = None, axis: str = "z"):
        """Writes the 3D mesh of prisms and hexahedra between levels at these heights; the suffix selects the format. On several ranks: collective.

        heights   coordinates of the levels along the axis, two or more, ascending: [0, 1] for a mesh that is one cell thick
        solution  as for write(); the same on each level
        axis      "z", or "y": the y of the plane mesh becomes z

        Formats: .cgns, .vtu, .su2, .msh, .b8.ugrid, .fluent.msh, polyMesh (a folder). With N levels, node n of the mesh is the nodes n N to n N + N - 1.
        """
        with self._collective("Mesh.extrude()") as call:
            if axis not in ("y", "z"):
                raise InputError(f"axis is 'y' or 'z', not {axis!r}")
            levels, path, rows = numbers_of(heights, (-1,), "heights").tolist(), path_of(path), self._rows(call, solution)
            call.same(path=path, heights=levels, axis=axis)
        warn(self._core.extrude(levels, path, rows, axis == "y"), self._core.comm.rank)

    def picture(self, format: str = "png", field: str = "", solution: Mapping | None = None, size: float = 800) -> bytes:
        """The file of a picture of the mesh, or of a variable of the solution, `size` pixels wide or high. Empty on all ranks but the first.

        format    "png", "svg" or "pdf"
        solution  as for write(); "mach" is computed from a flow that lacks it
        """
        with self._collective("Mesh.picture()") as call:
            if format not in ("png", "svg", "pdf"):
                raise InputError(f"format is 'png', 'svg' or 'pdf', not {format!r}")
            rows = self._pictured(call, field, solution, size)
            call.same(format=format)
        return self._core.picture(format, field, rows, size)

    def _pictured(self, call: collective, field: str, solution, size) -> _core._Tables:
        """The tables of the solution of which `field` is shown."""
        require(field, str, "field")
        if not isinstance(size, (int, float, np.number)) or not 50 <= size <= 20000:
            raise InputError(f"size is a number of pixels from 50 to 20000, not {size!r}")
        call.same(field=field, size=float(size))
        return self._rows(call, solution if field else None)

    def png(self, field: str = "", solution: Mapping | None = None, size: float = 800) -> bytes:
        """picture() as PNG."""
        return self.picture("png", field, solution, size)

    def plot(self, path, field: str = "", solution: Mapping | None = None, size: float = 800):
        """Writes picture() to a file: .png, .svg or .pdf. On several ranks: collective."""
        with self._collective("Mesh.plot()") as call:
            path, rows = path_of(path), self._pictured(call, field, solution, size)
            call.same(path=path)
        self._core.plot(path, field, rows, size)

    def _repr_png_(self):
        return self.png() if self._core.comm.size == 1 else None

    def _repr_html_(self):
        if self._core.comm.size > 1:
            return None
        rows = [(name.replace("_", " "), f"{value:.4g}" if isinstance(value, float) else f"{value:,}")
                for name, value in dataclasses.asdict(self.quality).items()]
        rows += [(f"edges of {name}", f"{len(edges):,}") for name, edges in self.edges.items()]
        return "<table>" + "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows) + "</table>"

    def __repr__(self):
        return f"<quadloop.Mesh: {self.owned} nodes, {len(self.triangles)} triangles, {len(self.quads)} quads on rank {self._core.comm.rank} of {self._core.comm.size}>"

    def to_meshio(self, solution: Mapping | None = None):
        """A meshio.Mesh with the names of boundaries and blocks as cell sets. For meshes on one rank."""
        import meshio  # type: ignore
        lines = list(self.edges.items())
        cells = [("triangle", self.triangles), ("quad", self.quads)] + [("line", edges) for _, edges in lines]
        empty = np.zeros(0, dtype=int)
        sets = {name: [np.arange(len(edges)) if k == i + 2 else empty for k in range(len(cells))] for i, (name, edges) in enumerate(lines)}
        blocks = self.blocks
        for number, name in enumerate(blocks["names"]):
            sets[name] = [np.flatnonzero(blocks[kind] == number) for kind in ("triangles", "quads")] + [empty] * len(lines)
        data = {name: np.asarray(values) for name, values in (solution or {}).items()}
        return meshio.Mesh(np.column_stack([self.points, np.zeros(len(self.points))]), cells, point_data=data, cell_sets=sets)

    def to_pyvista(self, solution: Mapping | None = None):
        """A pyvista.UnstructuredGrid of the cells; block numbers are the cell array `block`. For meshes on one rank."""
        import pyvista  # type: ignore
        faces = [np.column_stack([np.full(len(cells), cells.shape[1]), cells]).ravel() for cells in (self.triangles, self.quads)]
        kinds = np.repeat([5, 9], [len(self.triangles), len(self.quads)])  # VTK_TRIANGLE, VTK_QUAD
        grid = pyvista.UnstructuredGrid(np.concatenate(faces), kinds, np.column_stack([self.points, np.zeros(len(self.points))]))
        for name, values in (solution or {}).items():
            grid.point_data[name] = np.asarray(values)
        if self.blocks["names"]:
            grid.cell_data["block"] = np.concatenate([self.blocks["triangles"], self.blocks["quads"]])
        return grid


def rows_of(mesh: Mesh, solution) -> _core._Tables:
    """A solution as tables: names and values at nodes, names and values in cells. Raises InputError for one that does not fit."""
    nodal, cellwise = [], []
    cells = len(mesh.triangles) + len(mesh.quads)
    if solution is not None and not isinstance(solution, Mapping):
        raise InputError(f"a solution is a dictionary of arrays by variable, not {type(solution).__name__}")
    for name, given in (solution or {}).items():
        if not isinstance(name, str) or not name or any(letter.isspace() for letter in name):
            raise InputError(f"{name!r} is no name of a variable: use text without blanks")
        values = numbers_of(given, (-1,), f"variable '{name}'")
        if len(values) in (mesh.owned, len(mesh.points)):  # perhaps with the copies of other ranks' nodes
            nodal.append((name, values[:mesh.owned]))
        elif len(values) == cells:
            cellwise.append((name, values))
        else:
            raise InputError(f"variable '{name}': {len(values)} values for {mesh.owned} owned nodes and {cells} cells")

    def table(columns, rows):
        return np.ascontiguousarray(np.column_stack([values for _, values in columns])) if columns else np.zeros((rows, 0))

    return ([name for name, _ in nodal], table(nodal, mesh.owned), [name for name, _ in cellwise], table(cellwise, cells))


def solution_of(tables: _core._Tables) -> dict:
    names, values, cell_names, cell_values = tables
    return {**{name: values[:, k] for k, name in enumerate(names)}, **{name: cell_values[:, k] for k, name in enumerate(cell_names)}}


def mesh(case: Case, comm=None, progress=None) -> Mesh:
    """The initial mesh of a case, smoothed. Raises InputError, naming boundary and place, if the geometry cannot be meshed.

    progress  progress(Progress) is called at each stage, on several ranks on each that has one; if it returns False on one
              of them, all raise Cancelled. Its exception, or Ctrl-C, is raised on its rank, and Cancelled on the others.
    """
    with collective(communicator_of(comm), "mesh()") as call:
        report = reporter(progress)
        require(case, Case, "case")._meet(call, comm)
    core, messages = case._core(comm).mesh(report)
    warn(messages, core.comm.rank)
    return Mesh(core, messages)


def read(path, comm=None) -> tuple:
    """A mesh from a file and its solution, a dictionary of arrays: (Mesh, solution). The suffix selects the format: .mesh, .cgns, .vtu, .su2, .msh."""
    with collective(communicator_of(comm), "read()") as call:
        path = path_of(path)
        call.same(path=path)
    core, field, messages = _core.read(path, handle_of(comm))
    warn(messages, core.comm.rank)
    return Mesh(core, messages), solution_of(field)


def from_arrays(points, triangles=(), quads=(), edges: Mapping | None = None) -> Mesh:
    """A mesh of this process from arrays, e.g. to check it or to write it to a file: shapes (n, 2), (t, 3), (q, 4), and boundary -> (e, 2).

    Cells are counter-clockwise; edges have the domain to their left. Raises InputError for numbers of nodes that do not exist.
    """
    def numbers(rows, width):
        array = np.asarray(rows, dtype=np.int32).reshape(-1, width) if len(rows) == 0 else np.asarray(rows)
        if array.ndim != 2 or array.shape[1] != width or not np.issubdtype(array.dtype, np.integer):
            raise InputError(f"node numbers are whole numbers of shape (n, {width}), not {array.dtype} of shape {array.shape}")
        return array
    named = [(name, numbers(rows, 2)) for name, rows in (edges or {}).items()]
    return Mesh(_core.mesh_from_arrays(points_of(points), numbers(triangles, 3), numbers(quads, 4), named))


def from_meshio(given) -> Mesh:
    """The triangles and quadrilaterals of a meshio.Mesh. Cell sets of lines become boundaries."""
    def joined(kind, width):
        blocks = [block.data for block in given.cells if block.type == kind]
        return np.vstack(blocks) if blocks else np.zeros((0, width), dtype=int)
    edges = {}
    for name, chosen in given.cell_sets.items():
        lines = [block.data[rows] for block, rows in zip(given.cells, chosen) if block.type == "line" and rows is not None and len(rows)]
        if lines:
            edges[name] = np.vstack(lines)
    return from_arrays(np.asarray(given.points)[:, :2], joined("triangle", 3), joined("quad", 4), edges)


def smooth(case: Case, given: Mesh, comm=None, progress=None) -> Mesh:
    """A smoothed copy of a mesh of the case; boundary nodes slide along its geometry, layers stay. `progress` as in mesh(). On several ranks: collective."""
    ranks = communicator_of(comm)
    with collective(ranks, "smooth()") as call:
        report = reporter(progress)
        if not require(given, Mesh, "given")._core.comm.is_same(ranks):
            raise InputError("the mesh is on another communicator")
        require(case, Case, "case")._meet(call, comm)
        call.same(number_of_the_mesh=given._number)
    return Mesh(case._core(comm).smoothed(given._core, report))
