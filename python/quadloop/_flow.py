"""The built-in flow solver."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from . import _core
from ._cases import Case
from ._common import require, warn
from ._meshes import Mesh, solution_of


@dataclasses.dataclass(frozen=True)
class Functional:
    """An output functional of a flow: a coefficient, with an error estimate by its adjoint."""
    value: float
    corrected: float  # value minus the estimate of its error
    error: float  # sum of the absolute contributions of all nodes to the error
    by_alpha: float  # derivative, per degree
    by_mach: float  # derivative by the Mach number
    converged: bool  # whether the adjoint solution has converged


@dataclasses.dataclass(frozen=True)
class Flow:
    """A solution of the built-in solver.

    solution     variable -> a value for each owned node, in units of the density and the speed of sound of the free stream
    cl, cd       lift and drag coefficient, over all walls
    cm           moment coefficient, nose up, about solver.goal_about, if "moment" is a functional of solver.goal; else None
    forces       wall -> (cl, cd)
    functionals  name -> Functional, for the functionals of solver.goal
    residual     of the mass flux, relative to that of the free stream; above solver.tolerance the flow has not converged
    steps        number of steps of the solver
    warnings     e.g. that the flow has not converged
    """
    solution: dict
    cl: float
    cd: float
    residual: float
    steps: int
    forces: dict
    functionals: dict
    warnings: list

    @property
    def cm(self) -> float | None:
        return self.functionals["moment"].value if "moment" in self.functionals else None


def solve(case: Case, mesh: Mesh, start: Mapping | None = None, **keys_of_solver) -> Flow:
    """Solves the flow of the case's table [solver] on a mesh with the boundaries of the case, by the built-in solver.

    start  a solution to start from, e.g. that of another flow; None: the free stream
    keys   keys of the table [solver], e.g. alpha=2.0, goal=["lift", "drag"]

    With goal_adjoint="write" the solution has the derivatives of each functional by the position of each node, e.g. drag_by_x and
    drag_by_y; Morphed.pull_back() takes them as columns of an array. The bits are the same on any number of ranks; collective.
    Raises SolverError, with the place, if the state becomes unphysical.
    """
    with require(mesh, Mesh, "mesh")._collective("solve()") as call:
        require(case, Case, "case")
        if keys_of_solver:
            case = case.changed(solver=keys_of_solver)
        case._meet(call, None)
        rows = mesh._rows(call, start)
    tables, results = _core.solve(case._core(None), mesh._core, rows)
    warn(results["warnings"], mesh._core.comm.rank)
    functionals = {name: Functional(**entry) for name, entry in results.pop("functionals").items()}
    return Flow(solution=solution_of(tables), functionals=functionals, **results)
