"""Meshes that follow their outlines, with derivatives."""
from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from . import _core
from ._cases import Case, Outline, polygon
from ._common import numbers_of, require
from ._core import InputError
from ._meshes import Mesh, mesh


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
        unknown = set(velocities) - set(self.outlines)
        if unknown:
            raise InputError(f"'{unknown.pop()}' is no boundary that moves; these are {', '.join(self.outlines)}")
        return self._core.push_forward([numbers_of(velocities.get(name, np.zeros_like(points)), points.shape, f"velocities of '{name}'")
                                        for name, points in self.outlines.items()])

    def pull_back(self, gradient) -> dict:
        """The transpose: from dJ/dX at the owned nodes, shape (owned, 2), to boundary -> dJ/d(points), shape (n, 2). On several ranks: collective."""
        rows = self.mesh._together(lambda: numbers_of(gradient, (self.mesh.owned, 2), "gradient at the owned nodes"))
        return dict(zip(self.outlines, self._core.pull_back(rows)))


def _area(points) -> float:
    """Twice the area of a polygon, positive if it is counter-clockwise."""
    x, y = (points - points[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


class Run:
    """A mesh of a case for designs: its outlines move, the mesh follows.

    mesh      the Mesh of the case
    outlines  boundary -> its points, shape (n, 2), read-only, for boundaries that are one closed polygon; only these can move
    """

    def __init__(self, case: Case, comm=None):
        self.case = require(case, Case, "case")
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
        unknown = set(require(outlines, Mapping, "outlines")) - set(self.outlines)
        if unknown or not outlines:
            raise InputError(f"{repr(unknown.pop()) if unknown else 'nothing'} is no closed polygon of the case; these are {', '.join(self.outlines) or 'none'}")
        new = []
        for name, given in outlines.items():
            points = given.points if isinstance(given, Outline) else polygon(given).points
            if len(points) != len(self.outlines[name]):
                raise InputError(f"outline '{name}': {len(points)} points, but the mesh needs as many points as before, {len(self.outlines[name])}")
            if _area(points) * _area(self.outlines[name]) < 0:
                raise InputError(f"outline '{name}': its points run in the other direction than the old ones; reverse them")
            new.append((name, points, False))
        old = [(name, self.outlines[name], False) for name in outlines]
        return Morphed(_core.Morph(self.mesh._core, old, new, min_quality), {name: points for name, points, _ in new})

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
