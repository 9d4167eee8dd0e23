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
import traceback
import warnings
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from . import _core
from ._core import InputError, OutputError, SolverError, TooFar

__all__ = ["AdaptationCycle", "Case", "InputError", "LayerReport", "Mesh", "Morphed", "OutputError", "Outline", "QuadloopWarning",
           "Quality", "Run", "SolverError", "TooFar", "adapt", "curve", "from_arrays", "from_meshio", "keys", "mesh", "polygon", "read", "smooth",
           "spline"]

atexit.register(_core.finish)


class QuadloopWarning(UserWarning):
    """A warning of the library about a case, a mesh or a file."""


def _warn(messages, rank=0, level=3):
    """Warnings are the same on all ranks: the first one shows them."""
    for message in messages if rank == 0 else []:
        warnings.warn(message, QuadloopWarning, stacklevel=level)


def _handle(comm):
    """Fortran handle of a communicator of mpi4py; None: this process alone."""
    if comm is None:
        return None
    if not hasattr(comm, "py2f") or not comm:
        raise InputError(f"comm is a communicator of mpi4py or None, not {comm!r}")
    return comm.py2f()


def _require(given, kind, what: str):
    if not isinstance(given, kind):
        raise TypeError(f"{what} is a {kind.__name__}, not {type(given).__name__}")
    return given


def _numbers(given, shape: tuple, what: str) -> np.ndarray:
    """Finite real numbers of a shape, in which -1 stands for any number of rows."""
    try:
        array = np.asarray(given)
        fits = array.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, array.shape)) and array.dtype.kind in "iuf"
    except ValueError:  # rows of different lengths
        fits = False
    if not fits:
        wanted = ", ".join("n" if size == -1 else str(size) for size in shape)
        found = f"{array.dtype} of shape {array.shape}" if isinstance(given, np.ndarray) else repr(given)[:60]
        raise InputError(f"{what}: needs real numbers of shape ({wanted}), not {found}")
    array = array.astype(float)
    if not np.isfinite(array).all():
        raise InputError(f"{what}: contains values that are not finite, the first in row {np.argwhere(~np.isfinite(array))[0][0]}")
    return array


# Outlines and cases


@dataclasses.dataclass(frozen=True, eq=False)
class Outline:
    """A curve through points, an array of shape (n, 2). See polygon(), spline() and curve()."""
    points: np.ndarray
    kind: str = "polygon"
    spline: bool = False


def _points(points, what: str = "outline"):
    """A read-only copy of points."""
    array = _numbers(points, (-1, 2), what)
    if len(array) < 2:
        raise InputError(f"{what}: needs at least two points, not {len(array)}")
    array.setflags(write=False)
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


def _outlines(given) -> dict:
    """Boundary -> the list of its Outlines."""
    result = {}
    for name, parts in _require(given if given is not None else {}, Mapping, "outlines").items():
        is_list = isinstance(parts, (list, tuple)) and len(parts) > 0 and isinstance(parts[0], (Outline, np.ndarray))
        try:
            result[name] = [part if isinstance(part, Outline) else polygon(part) for part in (parts if is_list else [parts])]
        except InputError as error:
            raise InputError(f"outline '{name}': {str(error).removeprefix('outline: ')}") from None
    return result


def _shapes(outlines: Mapping) -> list:
    return [{"name": name, "kind": part.kind, "points": part.points, "spline": part.spline} for name, parts in outlines.items() for part in parts]


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
        self._set(None, tables, _outlines(outlines))

    def _set(self, file, tables: Mapping, outlines: Mapping):
        self._file, self._tables, self._outlines = file, dict(tables), dict(outlines)
        self._cores: dict = {}
        self._core(None)

    @classmethod
    def from_file(cls, path, **tables) -> "Case":
        """The case of a file. Keyword arguments override keys of its tables."""
        case = cls.__new__(cls)
        case._set(os.fspath(path), tables, {})
        return case

    def changed(self, outlines: Mapping | None = None, **tables) -> "Case":
        """The same case with other values of some keys, or other points of some outlines. Lists such as `wake` are replaced."""
        if outlines and self._file is not None:
            raise InputError(f"{self._file}: outlines of a case file cannot be changed; name another file, geometry={{'file': ...}}")
        case = Case.__new__(Case)
        case._set(self._file, _merged(self._tables, tables), {**self._outlines, **_outlines(outlines)})
        return case

    def __reduce__(self):
        return _case_of, (self._file, self._tables, self._outlines)

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
        shapes = [*self._tables.get("shape", []), *_shapes(self._outlines)]
        tables = {**self._tables, "shape": shapes} if shapes else self._tables
        return "".join(f"{key} = {_toml(value)}\n" for key, value in tables.items())

    def _core(self, comm):
        handle = _handle(comm)
        if handle not in self._cores:
            if self._file is None:
                core = _core.Case("case", self.toml, [], handle)
            else:
                core = _core.Case(self._file, None, _assignments(self._tables), handle)
            if not self._cores:
                _warn(core.warnings, core.rank, 5)
            core.agree(self.toml, "the case is another one")
            self._cores[handle] = core
        return self._cores[handle]


def _case_of(file, tables, outlines) -> Case:
    case = Case.__new__(Case)
    case._set(file, tables, outlines)
    return case


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
        _warn(self._core.write(os.fspath(path), self._together(lambda: _rows(self, solution))), self._core.rank)

    def _together(self, work):
        """Runs work on each rank. Its error on one rank is raised there and, as SolverError or InputError, on all others. Collective."""
        result, failure = None, None
        try:
            result = work()
        except BaseException as error:  # raised below, when all ranks know
            failure = error
            if self._core.ranks > 1:
                traceback.print_exc()  # at once, as other ranks may wait for this one in calls of their own
        try:
            self._core.raise_together("" if failure is None else f"{type(failure).__name__}: {failure}", isinstance(failure, InputError))
        except (SolverError, InputError):
            if failure is not None:
                raise failure
            raise
        return result

    def png(self, field: str = "", solution: Mapping | None = None, size: float = 800) -> bytes:
        """A picture of the mesh, or of a nodal field of the solution, `size` pixels wide or high. Empty on all ranks but the first."""
        if not 50 <= size <= 20000:
            raise InputError(f"size is a number of pixels from 50 to 20000, not {size}")
        if not field:
            return self._core.png("", (), size)
        if field not in (solution or {}):
            raise InputError(f"the solution has no variable '{field}'")
        rows = self._together(lambda: _rows(self, {field: (solution or {})[field]}))
        if rows[2]:
            raise InputError(f"variable '{field}' is given in cells; a picture needs values at the nodes")
        return self._core.png(field, rows, size)

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


def _rows(mesh: Mesh, solution) -> _core._Tables:
    """A solution as tables: names and values at nodes, names and values in cells. Raises InputError for one that does not fit."""
    nodal, cellwise = [], []
    cells = len(mesh.triangles) + len(mesh.quads)
    if solution is not None and not isinstance(solution, Mapping):
        raise InputError(f"a solution is a dictionary of arrays by variable, not {type(solution).__name__}")
    for name, given in (solution or {}).items():
        if not isinstance(name, str) or not name or any(letter.isspace() for letter in name):
            raise InputError(f"{name!r} is no name of a variable: use text without blanks")
        values = _numbers(given, (-1,), f"variable '{name}'")
        if len(values) in (mesh.owned, len(mesh.points)):  # perhaps with the copies of other ranks' nodes
            nodal.append((name, values[:mesh.owned]))
        elif len(values) == cells:
            cellwise.append((name, values))
        else:
            raise InputError(f"variable '{name}': {len(values)} values for {mesh.owned} owned nodes and {cells} cells")

    def table(columns, rows):
        return np.ascontiguousarray(np.column_stack([values for _, values in columns])) if columns else np.zeros((rows, 0))

    return ([name for name, _ in nodal], table(nodal, mesh.owned), [name for name, _ in cellwise], table(cellwise, cells))


def _solution(tables: _core._Tables) -> dict:
    names, values, cell_names, cell_values = tables
    return {**{name: values[:, k] for k, name in enumerate(names)}, **{name: cell_values[:, k] for k, name in enumerate(cell_names)}}


def mesh(case: Case, comm=None) -> Mesh:
    """The initial mesh of a case, smoothed. Raises InputError, naming boundary and place, if the geometry cannot be meshed."""
    core, messages = _require(case, Case, "case")._core(comm).mesh()
    _warn(messages, core.rank)
    return Mesh(core, messages)


def read(path, comm=None) -> tuple:
    """A mesh from a file and its solution, a dictionary of arrays: (Mesh, solution). The suffix selects the format: .mesh, .cgns, .vtu, .su2, .msh."""
    core, field, messages = _core.read(os.fspath(path), _handle(comm))
    _warn(messages, core.rank)
    return Mesh(core, messages), _solution(field)


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
    return Mesh(_core.mesh_from_arrays(_points(points), numbers(triangles, 3), numbers(quads, 4), named))


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


def smooth(case: Case, given: Mesh, comm=None) -> Mesh:
    """A smoothed copy of a mesh of the case; boundary nodes slide along its geometry, layers stay. On several ranks: collective."""
    return Mesh(case._core(comm).smoothed(given._core))


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
    def estimate(self) -> float | None:
        """The estimated norm of the interpolation error, if adapt.norm is given."""
        return self.record.get("estimate")

    @property
    def indicator(self) -> float | None:
        """Mean of log10 of the sensor's indicator over the quadtree cells; None with adapt.norm, whose sizes follow from an error."""
        return None if self.estimate is not None else self.record["indicator"]["mean"]

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

    The call checks case and keys; the cycles run as the result is iterated. An exception in `solve` on one rank is raised there and, as
    SolverError, on all others, unless these wait for that rank in a call of their own. `python3 -m mpi4py program.py` ends all ranks then.
    """
    _require(case, Case, "case")
    if folder == "" or (resume and folder is None):
        raise InputError("resume=True needs the folder of the run" if resume else "folder is empty; use None to write no files")
    if keys_of_adapt:
        case = case.changed(adapt=keys_of_adapt)
    run = _core.Adaptation(case._core(comm), "" if folder is None else os.fspath(folder), resume)
    return _cycles(run, solve)


def _cycles(run, solve) -> Iterator[AdaptationCycle]:
    while run.begin_cycle():
        mesh_of_cycle = Mesh(run.mesh())
        start = _solution(run.initial_state()) or None
        rows = mesh_of_cycle._together(lambda: _rows(mesh_of_cycle, solve(mesh_of_cycle, start)))
        mesh_of_cycle._core.agree(repr((rows[0], rows[2])), "solve() returned other variables, or values at nodes and in cells")
        record, messages = run.finish_cycle(rows)
        _warn(messages, mesh_of_cycle._core.rank)
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
        return self._core.push_forward([_numbers(velocities.get(name, np.zeros_like(points)), points.shape, f"velocities of '{name}'")
                                        for name, points in self.outlines.items()])

    def pull_back(self, gradient) -> dict:
        """The transpose: from dJ/dX at the owned nodes, shape (owned, 2), to boundary -> dJ/d(points), shape (n, 2). On several ranks: collective."""
        rows = self.mesh._together(lambda: _numbers(gradient, (self.mesh.owned, 2), "gradient at the owned nodes"))
        return dict(zip(self.outlines, self._core.pull_back(rows)))


class Run:
    """A mesh of a case for designs: its outlines move, the mesh follows.

    mesh      the Mesh of the case
    outlines  boundary -> its points, shape (n, 2), read-only, for boundaries that are one closed polygon; only these can move
    """

    def __init__(self, case: Case, comm=None):
        self.case = _require(case, Case, "case")
        self.mesh = mesh(case, comm)
        self.outlines = {name: parts[0].points for name, parts in case._outlines.items()
                         if len(parts) == 1 and parts[0].kind == "polygon" and not parts[0].spline}

    def morph(self, outlines: Mapping, min_quality: float = 0.0) -> Morphed:
        """Moves the mesh to new outlines with as many points: boundary -> shape (n, 2). Other boundaries stay in place.

        Raises TooFar if cells would become inverted, or the quality of the worst one would fall below `min_quality` (0 to 1).
        On several ranks: collective.
        """
        if not 0 <= min_quality <= 1:
            raise InputError(f"min_quality is from 0 to 1, not {min_quality}")
        unknown = set(_require(outlines, Mapping, "outlines")) - set(self.outlines)
        if unknown or not outlines:
            raise InputError(f"{repr(unknown.pop()) if unknown else 'nothing'} is no closed polygon of the case; these are {', '.join(self.outlines) or 'none'}")
        new = []
        for name, given in outlines.items():
            points = given.points if isinstance(given, Outline) else polygon(given).points
            if len(points) != len(self.outlines[name]):
                raise InputError(f"outline '{name}': {len(points)} points, but the mesh needs as many points as before, {len(self.outlines[name])}")
            new.append((name, points))
        old = [(name, self.outlines[name]) for name in outlines]
        return Morphed(_core.Morph(self.mesh._core, old, new, min_quality), dict(new))

    def verify(self, outlines: Mapping, step: float = 1e-6, seed: int = 0) -> tuple:
        """Compares the derivatives at new outlines with central differences, and the transpose with the derivative.

        Returns (largest deviation of a node velocity from the difference, deviation of the scalar products), relative to the
        largest velocity and product. `step` is relative to the extent of the outlines.
        """
        if not 0 < step < 0.01:
            raise InputError(f"step is above 0 and below 0.01, not {step}")
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
