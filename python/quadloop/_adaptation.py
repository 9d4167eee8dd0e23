"""The adaptive loop with a solver in memory."""
from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Iterator

from . import _core
from ._cases import Case
from ._common import reporter, require, warn
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


def adapt(case: Case, solve=None, comm=None, folder=None, resume: bool = False, progress=None, **keys_of_adapt) -> Iterator[AdaptationCycle]:
    """Meshes, solves and adapts, cycle by cycle. Meshes and solutions have the same bits on any number of ranks.

    solve     solve(mesh, start) -> {variable: values at the owned nodes or in the cells}; `start` is the solution transferred
              from the mesh before, in the same form, or None in cycle 0. Without it the solver of the case runs: the built-in
              one, or a program (SU2, OpenFOAM, any command), which needs a folder
    folder    each cycle writes the files of `quadloop adapt` there; resume=True continues after the last complete cycle
    progress  progress(Progress) is called at each stage, as in mesh()
    keys      keys of the table [adapt], e.g. variable="u", cycles=6, max_nodes=50_000

    The call checks case and keys; the cycles run as the result is iterated. An exception in `solve` on one rank is raised there and, as
    SolverError, on all others, unless these wait for that rank in a call of their own. `python3 -m mpi4py program.py` ends all ranks then.
    Ctrl-C takes effect at the next stage. The files of a cycle under way are removed then, as after an exception in `solve`.
    """
    require(case, Case, "case")
    if solve is not None and not callable(solve):
        raise TypeError(f"solve is a function of a mesh and its initial state, not {type(solve).__name__}")
    if folder == "" or (resume and folder is None):
        raise InputError("resume=True needs the folder of the run" if resume else "folder is empty; use None to write no files")
    if keys_of_adapt:
        case = case.changed(adapt=keys_of_adapt)
    run = _core.Adaptation(case._core(comm), "" if folder is None else os.fspath(folder), resume, solve is None, reporter(progress))
    return _cycles(run, solve)


def _cycles(run, solve) -> Iterator[AdaptationCycle]:
    try:
        while run.begin_cycle():
            mesh_of_cycle = Mesh(run.mesh())
            record, messages = run.solve_cycle() if solve is None else run.finish_cycle(_solved(run, mesh_of_cycle, solve))
            warn(messages, mesh_of_cycle._core.rank)
            mesh_of_cycle.warnings = messages
            of_cycle = {key: value for key, value in json.loads(record).items() if not key.endswith("_digest")}
            yield AdaptationCycle(run.cycle, mesh_of_cycle, solution_of(run.solution()), of_cycle, messages)
    finally:
        run.close()


def _solved(run, mesh: Mesh, solve):
    """The solution of the user's function, the same variables on all ranks."""
    start = solution_of(run.initial_state()) or None
    rows = mesh._together(lambda: rows_of(mesh, solve(mesh, start)))
    mesh._core.agree(repr((rows[0], rows[2])), "solve() returned other variables, or values at nodes and in cells")
    return rows
