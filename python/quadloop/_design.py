"""Meshes that follow their outlines, with derivatives."""
from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping

import numpy as np

from . import _core
from ._adaptation import adapt
from ._cases import Case, outlines_of, polygon
from ._common import collective, communicator_of, numbers_of, require, warn
from ._core import InputError, TooFar
from ._flow import Flow, solve
from ._meshes import Mesh, mesh


def _quality(least: float) -> float:
    if not 0 <= least <= 1:
        raise InputError(f"min_quality is from 0 to 1, not {least}")
    return least


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

        The derivative of the node positions is exact. Raises InputError if the mesh was smoothed. On several ranks: collective.
        """
        with self.mesh._collective("Morphed.push_forward()") as call:
            unknown = set(require(velocities, Mapping, "velocities")) - set(self.outlines)
            if unknown:
                raise InputError(f"'{unknown.pop()}' is no boundary that moves; these are {', '.join(self.outlines)}")
            rows = [numbers_of(velocities.get(name, np.zeros_like(points)), points.shape, f"velocities of '{name}'") for name, points in self.outlines.items()]
            call.same(velocities=[of_line.tobytes() for of_line in rows])
        return self._core.push_forward(rows)

    def pull_back(self, gradient) -> dict:
        """The transpose: from dJ/dX at the owned nodes, shape (owned, 2), to boundary -> dJ/d(points), shape (n, 2). On several ranks: collective."""
        with self.mesh._collective("Morphed.pull_back()"):
            rows = numbers_of(gradient, (self.mesh.owned, 2), "gradient at the owned nodes")
        return dict(zip(self.outlines, self._core.pull_back(rows)))


def _area(points) -> float:
    """Twice the area of a polygon, positive if it is counter-clockwise."""
    x, y = (points - points[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


@dataclasses.dataclass(frozen=True)
class Evaluation:
    """The flow around a shape, with gradients. Made by Run.evaluate().

    flow           the Flow
    mesh           the Mesh on which it was solved
    outlines       boundary -> its points, shape (n, 2)
    gradients      functional -> boundary -> dJ/d(points), shape (n, 2)
    by_alpha       functional -> dJ/d(angle of attack), per degree
    remeshed       whether the mesh is a new one; values on it differ from those on the old one by the discretisation error
    worst_quality  of the cells outside layers: 1 for the best shape
    """
    flow: Flow
    mesh: Mesh
    outlines: dict
    gradients: dict
    by_alpha: dict
    remeshed: bool
    worst_quality: float

    cl = property(lambda self: self.flow.cl)
    cd = property(lambda self: self.flow.cd)
    cm = property(lambda self: self.flow.cm)


def _morphed(before: Mesh, old: dict, new: dict, min_quality: float = 0.0) -> Morphed:
    old_lines, new_lines = ([(name, points, False) for name, points in loops.items()] for loops in (old, new))
    return Morphed(_core.Morph(before._core, old_lines, new_lines, min_quality), new)


class Run:
    """A mesh of a case for designs: its outlines move, the mesh follows.

    case      the Case
    mesh      its Mesh; with `adapted` that of the last cycle of adapt() with the built-in solver
    outlines  boundary -> its points, shape (n, 2), read-only, for boundaries that are one closed polygon; only these can move
    """

    def __init__(self, case: Case, comm=None, adapted: bool = False):
        with collective(communicator_of(comm), "Run()") as call:
            require(case, Case, "case")
            call.same(adapted=bool(adapted))
        self._comm, self._adapted = comm, adapted
        self._begin(case, {})

    def _begin(self, case: Case, keys_of_solver: Mapping):
        """Makes the mesh of a case, adapted to the flow with these keys."""
        if self._adapted:
            solved = case.changed(solver=keys_of_solver)
            for cycle in adapt(solved, lambda of_cycle, start: solve(solved, of_cycle, start).solution, self._comm):
                made, flow = cycle.mesh, cycle.solution
        else:
            made, flow = mesh(case, self._comm), None
        self.case, self.mesh, self._start, self._own_quality = case, made, flow, None
        self.outlines = {name: parts[0].points for name, parts in case._outlines.items()
                         if len(parts) == 1 and parts[0].kind == "polygon" and not parts[0].spline}

    def morph(self, outlines: Mapping, min_quality: float = 0.0) -> Morphed:
        """Moves the mesh to new outlines with as many points: boundary -> shape (n, 2). Other boundaries stay in place.

        Raises TooFar if cells would become inverted, or the quality of the worst one would fall below `min_quality` (0 to 1).
        On several ranks: collective.
        """
        with self._collective("Run.morph()") as call:
            new, least = self._points(call, outlines), _quality(min_quality)
            call.same(min_quality=least)
        return self._morph(new, least)

    def _collective(self, call: str) -> collective:
        return self.mesh._collective(call)

    def _points(self, call: collective, outlines: Mapping) -> dict:
        """New outlines as arrays, the same on all ranks."""
        unknown = set(require(outlines, Mapping, "outlines")) - set(self.outlines)
        if unknown or not outlines:
            raise InputError(f"{repr(unknown.pop()) if unknown else 'nothing'} is no outline that can move; closed polygons can, not splines or curves: {', '.join(self.outlines) or 'none in this case'}")
        given = outlines_of(outlines)
        if several := [name for name, parts in given.items() if len(parts) > 1]:
            raise InputError(f"outline '{several[0]}': needs one polygon, not {len(given[several[0]])}")
        new = {name: parts[0].points for name, parts in given.items()}
        for name, points in new.items():
            if len(points) != len(self.outlines[name]):
                raise InputError(f"outline '{name}': {len(points)} points, but the mesh needs as many points as before, {len(self.outlines[name])}")
            if _area(points) * _area(self.outlines[name]) < 0:
                raise InputError(f"outline '{name}': its points run in the other direction than the old ones; reverse them")
        call.same(outlines={name: points.tobytes() for name, points in new.items()})
        return new

    def _morph(self, new: dict, min_quality: float = 0.0) -> Morphed:
        return _morphed(self.mesh, {name: self.outlines[name] for name in new}, new, min_quality)

    def evaluate(self, outlines: Mapping | None = None, gradient: str | Iterable[str] = (), min_quality: float = 0.0, **keys_of_solver) -> Evaluation:
        """The flow around new outlines (boundary -> shape (n, 2)), by the built-in solver on the mesh moved to them.

        gradient     functionals whose derivatives are wanted: "drag", "lift", "moment", "pressure"
        min_quality  of the worst cell, 0 to 1; not more than 0.9 times that of the run's own mesh is required
        keys         keys of the table [solver], e.g. alpha=2.0

        If the cells cannot follow, or become worse than `min_quality`, a new mesh of these outlines is made, as that of the run was, and replaces it:
        a QuadloopWarning says so. All flows on a mesh start from the same one: that of the last cycle of its adaptation, without adaptation the first
        flow on this mesh, which starts from the free stream. So the values depend on the shape alone. Gradients are exact for the mesh that moves with
        its outline; if cells had to be smoothed, they are those of the smoothed mesh.
        On several ranks collective, with the same values on all. Raises InputError for outlines that cannot be meshed; SolverError.
        """
        with self._collective("Run.evaluate()") as call:
            goals, least = [gradient] if isinstance(gradient, str) else list(gradient), _quality(min_quality)
            new = {**self.outlines, **(self._points(call, outlines or {}) if outlines or not self.outlines else {})}
            call.same(gradient=goals, min_quality=least, keys_of_the_solver=keys_of_solver)
        moved, reason = self._moved(new, least)
        if moved is None:
            warn([f"a new mesh was generated: {reason}"], self.mesh._core.comm.rank)
            self._begin(self.case.changed(outlines={name: polygon(points) for name, points in new.items()}), keys_of_solver)
            moved = self._morph(new)
        adjoint = {"goal": goals, "goal_adjoint": "write"} if goals else {}
        flow = solve(self.case, moved.mesh, self._start, **keys_of_solver, **adjoint)
        self._start = self._start or flow.solution
        follows = moved if not moved.smoothed else _morphed(moved.mesh, new, new)
        by_nodes = {goal: np.column_stack([flow.solution[f"{goal}_by_x"], flow.solution[f"{goal}_by_y"]]) for goal in goals}
        return Evaluation(flow, moved.mesh, new, {goal: follows.pull_back(rows) for goal, rows in by_nodes.items()},
                          {goal: flow.functionals[goal].by_alpha for goal in goals}, bool(reason), moved.worst_quality)

    def _moved(self, new: dict, min_quality: float) -> tuple:
        """The mesh moved to new outlines, or None and the reason why it cannot follow."""
        try:
            moved = self._morph(new)
        except TooFar as error:
            return None, f"the cells can follow only {error.share:.0%} of the change of the outlines"
        if min_quality > 0 and self._own_quality is None:
            self._own_quality = self._morph(self.outlines).worst_quality
        least = min(min_quality, 0.9 * self._own_quality) if min_quality > 0 else 0
        if moved.worst_quality < least:
            return None, f"the quality of the worst cell would be {moved.worst_quality:.2g}, below {least:.2g}"
        return moved, ""

    def verify(self, outlines: Mapping, step: float = 1e-6, seed: int = 0) -> tuple:
        """Compares the derivatives at new outlines with central differences, and the transpose with the derivative.

        Returns (largest deviation of a node velocity from the difference, deviation of the scalar products), relative to the
        largest velocity and product. `step` is relative to the extent of the outlines.
        """
        with self._collective("Run.verify()") as call:
            if not 0 < step < 0.01:
                raise InputError(f"step is above 0 and below 0.01, not {step}")
            if not isinstance(seed, (int, np.integer)):
                raise InputError(f"seed is a whole number, not {seed!r}")
            call.same(step=float(step), seed=seed)
        random = np.random.default_rng(seed)
        here = self.morph(outlines)
        ways = {name: random.uniform(-1, 1, points.shape) for name, points in here.outlines.items()}
        length = step * max(np.ptp(points, axis=0).max() for points in here.outlines.values())
        ahead, behind = (self.morph({name: points + sign * length * ways[name] for name, points in here.outlines.items()}).mesh for sign in (1, -1))
        velocity = here.push_forward(ways)
        difference = (ahead.points - behind.points)[:here.mesh.owned] / (2 * length)
        gradient = random.uniform(-1, 1, velocity.shape)
        back = here.pull_back(gradient)
        comm = self.mesh._core.comm
        product = comm.sum(float((gradient * velocity).sum()))
        transposed = sum(float((back[name] * ways[name]).sum()) for name in ways)
        largest = comm.maximum(float(np.abs(velocity).max(initial=0)))
        deviation = comm.maximum(float(np.abs(velocity - difference).max(initial=0)))
        return deviation / largest, abs(product - transposed) / abs(product)
