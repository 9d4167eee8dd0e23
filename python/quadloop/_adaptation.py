"""The adaptive loop with a solver in memory."""
from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Iterator

import numpy as np

from . import _core
from ._cases import Case
from ._common import collective, communicator_of, path_of, reporter, require, users_function, warn
from ._core import InputError
from ._meshes import Mesh, rows_of, solution_of


@dataclasses.dataclass(frozen=True)
class AdaptationCycle:
    """A cycle of adapt().

    number    of the cycle, from 0
    mesh      its Mesh
    solution  variable -> values at the owned nodes, or in the cells
    record    a dictionary, with what `quadloop adapt` writes to record.json except digests and timings. Always: "nodes", "triangles",
              "quads", "leaves" (quadtree cells), "worst_angle" (degrees), "indicator" ("mean" and "deviation" of log10),
              "refined" and "coarsened" (quadtree cells, for the next mesh), "outside" (new nodes outside the mesh before), "drift". As
              the case requests or the solver reports: "estimate", "order", "cl", "cd", "residual", "forces", "goals" and others; see
              docs/reference/adaptive-run.md
    warnings  of the cycle, as texts
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


class TransferMap:
    """Where a new mesh comes from: for each of its owned nodes the nodes of the old mesh from which the linear transfer
    interpolates. Nodes and cells are given by their numbers over all ranks, of the old mesh. Making it, and its
    functions, are collective on several ranks.

    nodes    (n, 3) int64: up to three old nodes, then -1
    weights  (n, 3) float64: their weights, which sum up to 1; 0 where there is no node
    same     (n,) int64: the old node at the same position, whose values the transfer keeps; -1 for a new node
    cells    (c,) int64: the old cell with the same nodes, for each triangle, then each quad; -1 for a new cell
    """

    def __init__(self, old: Mesh, new: Mesh):
        with require(old, Mesh, "old")._collective("TransferMap()") as call:
            if not require(new, Mesh, "new")._core.comm.is_same(old._core.comm):
                raise InputError("the two meshes have different communicators")
            call.same(number_of_the_new_mesh=new._number)
        core = _core.TransferMap(old._core, new._core)
        self._core, self._old = core, old
        self.nodes, self.weights, self.same, self.cells = core.nodes, core.weights, core.same, core.same_cells

    def _mapped(self, values, name: str):
        with self._old._collective(f"TransferMap.{name}()") as call:
            array = np.asarray(values, dtype=float)
            if array.ndim not in (1, 2) or len(array) not in (self._old.owned, len(self._old.points)):
                raise InputError(f"values have a row for each of the {self._old.owned} owned nodes of the old mesh, not the shape {array.shape}")
            call.same(number_of_columns=array.shape[1:])
        table = np.ascontiguousarray(array[:self._old.owned].reshape(self._old.owned, -1))
        return getattr(self._core, name)(table), array.shape[1:]

    def rows(self, values) -> np.ndarray:
        """The rows of `values`, those of the old mesh's owned nodes on each rank, at `nodes`: shape (n, 3) or (n, 3, k); 0 at -1."""
        rows, shape = self._mapped(values, "rows")
        return rows.reshape(-1, 3, *shape)

    def interpolate(self, values) -> np.ndarray:
        """The linear interpolant of `values` at the new mesh's owned nodes: the weighted sums of rows(values)."""
        rows, shape = self._mapped(values, "interpolate")
        return rows.reshape(-1, *shape)


def adapt(case: Case, solve=None, comm=None, folder=None, resume: bool = False, progress=None, transfer=None, **keys_of_adapt) -> Iterator[AdaptationCycle]:
    """Meshes, solves and adapts, cycle by cycle. Meshes and solutions have the same bits on any number of ranks.

    solve     solve(mesh, start) -> {variable: values at the owned nodes or in the cells}; `start` is the solution transferred
              from the mesh before, in the same form, or None in cycle 0. Without it the solver of the case runs: the built-in
              one, or a program (SU2, OpenFOAM, any command), which needs a folder
    folder    each cycle writes the files of `quadloop adapt` there; resume=True continues after the last complete cycle
    progress  progress(Progress) is called at each stage, as in mesh()
    transfer  transfer(old_mesh, old_solution, new_mesh, map) -> the same variables on the new mesh, instead of the transfer of
              the case; `map` is their TransferMap. Like `solve` it is called on all ranks
    keys      keys of the table [adapt], e.g. variable="u", cycles=6, max_nodes=50_000

    The call checks case and keys; the cycles run as the result is iterated. An exception in `solve` on one rank is raised there and, as
    SolverError, on all others, unless these wait for that rank in a call of their own. `python3 -m mpi4py program.py` ends all ranks then.
    Ctrl-C takes effect at the next stage. The files of a cycle under way are removed then, as after an exception in `solve`.
    """
    ranks = communicator_of(comm)
    with collective(ranks, "adapt()") as call:
        if solve is not None and not callable(solve):
            raise TypeError(f"solve is a function of a mesh and its initial state, not {type(solve).__name__}")
        if folder == "" or (resume and folder is None):
            raise InputError("resume=True needs the folder of the run" if resume else "folder is empty; use None to write no files")
        if keys_of_adapt:
            case = require(case, Case, "case").changed(adapt=keys_of_adapt)
        options = "" if folder is None else path_of(folder), bool(resume), solve is None
        report, transferred = reporter(progress), _transfer_of(transfer)
        require(case, Case, "case")._meet(call, comm)
        call.same(folder=options[0], resume=options[1], solver_of_the_case=options[2], transfer_of_the_case=transfer is None)
    return _cycles(_core.Adaptation(case._core(comm), *options, report, transferred), solve, ranks, ranks.next_number())


def _cycles(run, solve, ranks: _core.Communicator, number: int) -> Iterator[AdaptationCycle]:
    """The cycles of a run; its number is the same on all ranks."""
    try:
        while _has_cycle(run, ranks, number):
            mesh_of_cycle = Mesh(run.mesh())
            record, messages = run.solve_cycle() if solve is None else run.finish_cycle(_solved(run, mesh_of_cycle, solve))
            warn(messages, ranks.rank)
            mesh_of_cycle.warnings = messages
            of_cycle = {key: value for key, value in json.loads(record).items() if not key.endswith("_digest")}
            yield AdaptationCycle(run.cycle, mesh_of_cycle, solution_of(run.solution()), of_cycle, messages)
    finally:
        run.close()


def _has_cycle(run, ranks: _core.Communicator, number: int) -> bool:
    with collective(ranks, "a cycle of adapt()", number_of_the_run=number):
        pass
    return run.begin_cycle()


def _transfer_of(function):
    """The function for the module over the library, with tables."""
    if function is None:
        return None
    if not callable(function):
        raise TypeError(f"transfer is a function of meshes and a solution, not {type(function).__name__}")

    def by(old, tables, new):
        old_mesh, new_mesh, names = Mesh(old), Mesh(new), (list(tables[0]), list(tables[2]))
        between = TransferMap(old_mesh, new_mesh)

        with users_function(new.comm, "transfer()") as call:
            made = function(old_mesh, solution_of(tables), new_mesh, between)
            if not isinstance(made, dict) or set(made) != {*names[0], *names[1]}:
                raise InputError(f"transfer() returns the variables {', '.join(names[0] + names[1])}, not {made if not isinstance(made, dict) else ', '.join(made)!r}")
            result = rows_of(new_mesh, {name: made[name] for name in names[0] + names[1]})
            if (result[0], result[2]) != names:
                raise InputError("transfer() returned values in cells for a variable at nodes, or the reverse")
            call.same(variables=names)
        return result
    return by


def _solved(run, mesh: Mesh, solve):
    """The solution of the user's function, the same variables on all ranks."""
    start = solution_of(run.initial_state()) or None
    with users_function(mesh._core.comm, "solve()") as call:
        made = solve(mesh, start)
        if made is None:
            raise InputError("solve() returned None; it returns a dictionary of arrays by variable")
        return mesh._rows(call, made)
