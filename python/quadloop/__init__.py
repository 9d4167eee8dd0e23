"""Parallel 2D mesh generation, smoothing and adaptive remeshing for flow solvers.

    import numpy as np, quadloop as ql
    case = ql.Case(outlines={"airfoil": ql.spline(points)}, geometry={"far_field": 50.0}, spacing={"max": 5.0},
                   boundary={"airfoil": {"spacing": 0.01, "bc": "wall"}})
    mesh = ql.mesh(case)
    mesh.points, mesh.triangles, mesh.quads, mesh.edges["airfoil"]
    mesh.write("airfoil.su2")

The keyword arguments of `Case` are the tables of a case file, with the same keys. On several ranks pass mpi4py's
communicator as `comm`: each rank holds its part of the mesh, and all ranks call the same functions in the same
order. The mesh is the same, bit for bit, on any number of ranks. Lengths are in the unit of the outlines.

Errors: InputError (a ValueError) for a case, mesh or field that cannot be used; TooFar (an InputError) for a mesh that cannot
follow a change of its outline, with the share of the change that it can follow; SolverError (a RuntimeError);
OutputError (an OSError). The message names the key or the place, and a remedy. Warnings go to `warnings.warn` with
the category QuadloopWarning.
"""
from __future__ import annotations

import atexit
import dataclasses
import json
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from . import _core
from ._core import InputError, OutputError, SolverError, TooFar

__all__ = ["AdaptationCycle", "Case", "InputError", "LayerReport", "Mesh", "Morphed", "OutputError", "Outline", "QuadloopWarning",
           "Quality", "Run", "SolverError", "TooFar", "adapt", "curve", "keys", "mesh", "polygon", "read", "spline"]

atexit.register(_core.finish)


class QuadloopWarning(UserWarning):
    """A warning of the library about a case, a mesh or a file."""


def _warn(messages, rank=0, level=3):
    """Warnings are the same on all ranks: the first one shows them."""
    for message in messages if rank == 0 else []:
        warnings.warn(message, QuadloopWarning, stacklevel=level)


def _handle(comm):
    """Fortran handle of a communicator of mpi4py; None: this process alone."""
    return None if comm is None else comm.py2f()


# Outlines and cases


@dataclasses.dataclass(frozen=True)
class Outline:
    """A curve through points, an array of shape (n, 2). See polygon(), spline() and curve()."""
    points: np.ndarray
    kind: str = "polygon"
    spline: bool = False


def _points(points):
    array = np.asarray(points, dtype=float)
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(f"an outline is an array of shape (n, 2), not {array.shape}")
    return array


def polygon(points) -> Outline:
    """A closed outline of straight lines through points of shape (n, 2), in either direction. The last point may repeat the first one."""
    array = _points(points)
    return Outline(array[:-1] if len(array) > 1 and (array[0] == array[-1]).all() else array)


def spline(points) -> Outline:
    """A closed outline of cubic splines from corner to corner. Corners turn by more than the outline's `corner` angle, 30 degrees by default."""
    return dataclasses.replace(polygon(points), spline=True)


def curve(points, spline: bool = False) -> Outline:
    """An open curve. Curves that meet at their ends form an outline with a name for each side."""
    return Outline(_points(points), "curve", spline)


def _toml(value) -> str:
    """A value of Python as TOML."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, np.ndarray):
        return _toml(value.tolist())
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise InputError(f"{value!r} is no value of a case: use numbers, texts, True, False, lists and dictionaries")


def _shape(name: str, given) -> dict:
    outline = given if isinstance(given, Outline) else polygon(given)
    return {"name": name, "kind": outline.kind, "points": outline.points, "spline": outline.spline}


def _merged(tables: Mapping, changes: Mapping) -> dict:
    merged = dict(tables)
    for key, value in changes.items():
        both = isinstance(value, Mapping) and isinstance(merged.get(key), Mapping)
        merged[key] = _merged(merged[key], value) if both else value
    return merged


def _assignments(changes: Mapping, above: str = "") -> list:
    """Changes of a case file, as for --set."""
    result = []
    for key, value in changes.items():
        name = f"{above}{json.dumps(key) if not key.replace('_', 'a').isalnum() else key}"
        result += _assignments(value, name + ".") if isinstance(value, Mapping) else [f"{name}={_toml(value)}"]
    return result


class Case:
    """Geometry, sizes, layers, smoothing and adaptation: what a case file says.

    outlines  name of a boundary -> an Outline, an array of shape (n, 2) (a polygon), or a list of them
    tables    the tables of a case file by their names (keys() lists all), e.g. spacing={"min": 1e-3}. Paths are
              relative to the working folder.

    Raises InputError for unknown keys, wrong values and outlines that cannot be meshed.
    """

    def __init__(self, outlines: Mapping | None = None, **tables):
        shapes = list(tables.pop("shape", []))
        for name, given in (outlines or {}).items():
            parts = given if isinstance(given, (list, tuple)) and given and isinstance(given[0], (Outline, np.ndarray)) else [given]
            shapes += [_shape(name, part) for part in parts]
        self._outlines = dict(outlines or {})
        self._file, self._tables = None, {**tables, **({"shape": shapes} if shapes else {})}
        self._cores: dict = {}
        self._core(None)

    @classmethod
    def from_file(cls, path, **tables) -> "Case":
        """The case of a file. Keyword arguments override keys of its tables."""
        case = cls.__new__(cls)
        case._file, case._tables, case._cores, case._outlines = os.fspath(path), tables, {}, {}
        case._core(None)
        return case

    def changed(self, **tables) -> "Case":
        """The same case with other values of some keys."""
        case = Case.__new__(Case)
        case._file, case._tables, case._cores, case._outlines = self._file, _merged(self._tables, tables), {}, self._outlines
        case._core(None)
        return case

    @property
    def title(self) -> str:
        return self._core(None).title

    @property
    def warnings(self) -> list:
        """Warnings about the case and its geometry."""
        return self._core(None).warnings

    @property
    def toml(self) -> str:
        """The case as the text of a case file; of a case from a file only what was changed."""
        return "".join(f"{key} = {_toml(value)}\n" for key, value in self._tables.items())

    def _core(self, comm):
        handle = _handle(comm)
        if handle not in self._cores:
            if self._file is None:
                core = _core.Case("case", self.toml, [], handle)
            else:
                core = _core.Case(self._file, None, _assignments(self._tables), handle)
            if not self._cores:
                _warn(core.warnings, core.rank, 4)
            self._cores[handle] = core
        return self._cores[handle]


def keys() -> dict:
    """Every key of a case: table -> key -> (value, default as JSON or "", meaning)."""
    return _core.keys()


# Meshes


@dataclasses.dataclass(frozen=True)
class Quality:
    """Numbers of cells over all ranks, and the quality of their shapes: 1 for the best, 0 for a degenerate cell. Angles in degrees."""
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
    """The layers of one boundary or line. Lengths in the unit of the geometry, normal to the wall."""
    boundary: str
    count: int  # requested number of layers
    count_reached: int  # in the column with the fewest
    columns: int
    y_plus: float  # target of the first layer; 0: none
    first: float  # smallest first height
    growth: float  # smallest growth ratio
    thickness: float  # requested
    smallest_share: float  # of the requested thickness
    coverage: float  # fraction of the wall with the requested thickness
    thinnest_at: tuple


class Mesh:
    """A mesh, or the part of it that belongs to this rank. Arrays are read-only views, without copies.

    points      (n, 2) float64: the `owned` nodes of this rank, then copies of other ranks' nodes that its cells use
    triangles   (t, 3) int32: rows of `points`, counter-clockwise
    quads       (q, 4) int32
    edges       boundary -> (e, 2) int32, with the domain to the left
    conditions  boundary -> its boundary condition, "" for none
    blocks      {"names", "triangles", "quads"}: the block of each cell as index into the names; empty for one block
    named_nodes name -> global number of a node
    global_ids  (n,) int64: the number of each node over all ranks
    """

    def __init__(self, core, warnings=()):
        self._core = core
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
    def layers(self) -> dict:
        """The layers of each boundary and line that has some, as LayerReport."""
        return {row["boundary"]: LayerReport(**row) for row in self._core.layers()}

    @property
    def quality(self) -> Quality:
        """On several ranks: collective."""
        return Quality(**self._core.quality())

    @property
    def nodes(self) -> int:
        """Number of nodes over all ranks. On several ranks: collective."""
        return self.quality.nodes

    def check(self) -> list:
        """One line for each fault of the mesh, with its place; empty for a valid mesh. On several ranks: collective."""
        return self._core.check()

    def gathered(self) -> "Mesh":
        """The whole mesh on rank 0, an empty one on the others. On several ranks: collective."""
        return Mesh(self._core.gathered(), self.warnings)

    def write(self, path, solution: Mapping | None = None):
        """Writes the mesh, with a solution if the format can hold it; the suffix selects the format. On several ranks: collective.

        solution  variable -> a value for each owned node, or for each cell (triangles, then quads)
        """
        _warn(self._core.write(os.fspath(path), _rows(self, solution)), self._core.rank)

    def png(self, field: str = "", solution: Mapping | None = None, size: float = 800) -> bytes:
        """A picture of the mesh, or of a nodal field of the solution, `size` pixels wide or high. Empty on all ranks but the first."""
        return self._core.png(field, _rows(self, {field: (solution or {})[field]}) if field else (), size)

    def _repr_png_(self):
        return self.png() if self._core.ranks == 1 else None

    def _repr_html_(self):
        if self._core.ranks > 1:
            return None
        rows = [(name.replace("_", " "), f"{value:.4g}" if isinstance(value, float) else f"{value:,}")
                for name, value in dataclasses.asdict(self.quality).items()]
        rows += [(f"edges of {name}", f"{len(edges):,}") for name, edges in self.edges.items()]
        return "<table>" + "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows) + "</table>"

    def __repr__(self):
        return f"<quadloop.Mesh: {self.owned} nodes, {len(self.triangles)} triangles, {len(self.quads)} quads on rank {self._core.rank} of {self._core.ranks}>"

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


def _rows(mesh: Mesh, solution: Mapping | None) -> _core.Tables:
    """A solution as tables: names and values at nodes, names and values in cells."""
    nodal, cellwise = [], []
    cells = len(mesh.triangles) + len(mesh.quads)
    for name, given in (solution or {}).items():
        values = np.asarray(given, dtype=float)
        if values.shape == (mesh.owned,):
            nodal.append((name, values))
        elif values.shape == (len(mesh.points),):  # with the copies of other ranks' nodes
            nodal.append((name, values[:mesh.owned]))
        elif values.shape == (cells,):
            cellwise.append((name, values))
        else:
            nodal.append((name, values.ravel()))  # refused by the library on all ranks

    def table(columns, rows):
        if any(len(values) != rows for _, values in columns):
            return np.concatenate([values for _, values in columns])
        return np.ascontiguousarray(np.column_stack([values for _, values in columns])) if columns else np.zeros((rows, 0))

    return ([name for name, _ in nodal], table(nodal, mesh.owned), [name for name, _ in cellwise], table(cellwise, cells))


def _solution(tables: _core.Tables) -> dict:
    names, values, cell_names, cell_values = tables
    return {**{name: values[:, k] for k, name in enumerate(names)}, **{name: cell_values[:, k] for k, name in enumerate(cell_names)}}


def mesh(case: Case, comm=None) -> Mesh:
    """The initial mesh of a case, smoothed. Raises InputError, naming boundary and place, if the geometry cannot be meshed."""
    core, messages = case._core(comm).mesh()
    _warn(messages, core.rank)
    return Mesh(core, messages)


def read(path, comm=None) -> tuple:
    """A mesh from a file and its solution, a dictionary of arrays: (Mesh, solution). The suffix selects the format: .mesh, .cgns, .vtu, .su2, .msh."""
    core, field, messages = _core.read(os.fspath(path), _handle(comm))
    _warn(messages, core.rank)
    return Mesh(core, messages), _solution(field)


# Adaptation


@dataclasses.dataclass(frozen=True)
class AdaptationCycle:
    """A cycle of adapt(): its mesh and solution.

    record  what `quadloop adapt` writes to record.json, without digests and timings, as a dictionary
    """
    number: int
    mesh: Mesh
    solution: dict
    record: dict
    warnings: list

    @property
    def indicator(self) -> float:
        """Mean of log10 of the sensor's indicator over the quadtree cells."""
        return self.record["indicator"]["mean"]

    @property
    def drift(self) -> dict:
        """For each variable: integral over this mesh minus that over the mesh before, by the transfer."""
        return self.record.get("drift", {})


def adapt(case: Case, solve, comm=None, folder=None, resume: bool = False, **keys_of_adapt) -> Iterator[AdaptationCycle]:
    """Meshes, solves and adapts, cycle by cycle. Meshes and solutions have the same bits on any number of ranks.

    solve     solve(mesh, start) -> {variable: values at the owned nodes or in the cells}; `start` is the solution transferred
              from the mesh before, in the same form, or None in cycle 0
    folder    each cycle writes the files of `quadloop adapt` there; resume=True continues after the last complete cycle
    keys      keys of the table [adapt], e.g. variable="u", cycles=6, max_nodes=50_000

    An exception in `solve` on one rank becomes an error on all ranks: SolverError on the others.
    """
    if keys_of_adapt:
        case = case.changed(adapt=keys_of_adapt)
    core = case._core(comm)
    run = _core.Adaptation(core, "" if folder is None else os.fspath(folder), resume)
    while run.begin_cycle():
        mesh_of_cycle = Mesh(run.mesh())
        start = _solution(run.initial_state()) or None
        solution, failure = None, None
        try:
            solution = solve(mesh_of_cycle, start)
        except Exception as error:  # raised below, when all ranks know
            failure = error
        try:
            core.raise_together("" if failure is None else f"solve() failed: {type(failure).__name__}: {failure}")
        except SolverError:
            if failure is not None:
                raise failure
            raise
        record, messages = run.finish_cycle(_rows(mesh_of_cycle, solution))
        _warn(messages, core.rank)
        mesh_of_cycle.warnings = messages
        of_cycle = {key: value for key, value in json.loads(record).items() if not key.endswith("_digest")}
        yield AdaptationCycle(run.cycle, mesh_of_cycle, _solution(run.solution()), of_cycle, messages)


# Design


class Morphed:
    """A mesh whose nodes have followed a change of its outline; the cells are the same. Made by Run.morph().

    mesh           the moved Mesh
    outlines       boundary -> the points of the new outline, shape (n, 2)
    worst_quality  of the cells outside layers: 1 for the best shape
    smoothed       whether cells had to be smoothed; then the nodes have no derivative
    """

    def __init__(self, core, outlines: dict):
        self._core, self.outlines = core, outlines
        self.mesh = Mesh(core.mesh())
        self.worst_quality, self.smoothed = core.worst_quality, core.smoothed

    def push_forward(self, velocities: Mapping) -> np.ndarray:
        """Velocities of the owned nodes, shape (owned, 2), for velocities of the points of outlines: boundary -> shape (n, 2); 0 for those not given.

        The derivative of the node positions is exact. Raises InputError if the mesh was smoothed.
        """
        unknown = set(velocities) - set(self.outlines)
        if unknown:
            raise InputError(f"'{unknown.pop()}' is no boundary that moves; these are {', '.join(self.outlines)}")
        return self._core.push_forward([np.asarray(velocities.get(name, np.zeros_like(points)), dtype=float) for name, points in self.outlines.items()])

    def pull_back(self, gradient) -> dict:
        """The transpose: from dJ/dX at the owned nodes, shape (owned, 2), to boundary -> dJ/d(points), shape (n, 2). On several ranks: collective."""
        return dict(zip(self.outlines, self._core.pull_back(np.asarray(gradient, dtype=float))))


class Run:
    """A mesh of a case for designs: its outlines move, the mesh follows.

    mesh      the Mesh of the case
    outlines  boundary -> its points, shape (n, 2), for the closed polygons of the case
    """

    def __init__(self, case: Case, comm=None):
        self.case = case
        self.mesh = mesh(case, comm)
        polygons = {name: polygon(given) if not isinstance(given, Outline) else given for name, given in case._outlines.items()
                    if isinstance(given, (Outline, np.ndarray)) or not isinstance(given[0], (Outline, np.ndarray))}
        self.outlines = {name: outline.points for name, outline in polygons.items() if outline.kind == "polygon" and not outline.spline}

    def morph(self, outlines: Mapping, min_quality: float = 0.0) -> Morphed:
        """Moves the mesh to new outlines with as many points: boundary -> shape (n, 2). Other boundaries stay in place.

        Raises TooFar if cells would become inverted, or the quality of the worst one would fall below `min_quality` (0 to 1).
        On several ranks: collective.
        """
        unknown = set(outlines) - set(self.outlines)
        if unknown:
            raise InputError(f"'{unknown.pop()}' is no closed polygon of the case; these are {', '.join(self.outlines) or 'none'}")
        old = [(name, self.outlines[name]) for name in outlines]
        new = [(name, polygon(points).points) for name, points in outlines.items()]
        return Morphed(_core.Morph(self.mesh._core, old, new, min_quality), dict(new))

    def verify(self, outlines: Mapping, step: float = 1e-6, seed: int = 0) -> tuple:
        """Compares the derivatives at new outlines with central differences, and the transpose with the derivative.

        Returns (largest deviation of a node velocity from the difference, deviation of the scalar products), relative to the
        largest velocity and product. `step` is relative to the extent of the outlines.
        """
        random = np.random.default_rng(seed)
        here = self.morph(outlines)
        ways = {name: random.uniform(-1, 1, points.shape) for name, points in here.outlines.items()}
        length = step * max(np.ptp(points, axis=0).max() for points in here.outlines.values())
        ahead, behind = (self.morph({name: points + sign * length * ways[name] for name, points in here.outlines.items()}).mesh for sign in (1, -1))
        velocity = here.push_forward(ways)
        difference = (ahead.points - behind.points)[:here.mesh.owned] / (2 * length)
        gradient = random.uniform(-1, 1, velocity.shape)
        back = here.pull_back(gradient)
        comm_sum = self.mesh._core.sum
        product = comm_sum(float((gradient * velocity).sum()))
        transposed = sum(float((back[name] * ways[name]).sum()) for name in ways)
        largest = self.mesh._core.maximum(float(np.abs(velocity).max(initial=0)))
        deviation = self.mesh._core.maximum(float(np.abs(velocity - difference).max(initial=0)))
        return deviation / largest, abs(product - transposed) / abs(product)
