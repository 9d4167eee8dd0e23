"""Mesh deformation with the interface of IDWarp, for the solvers and optimisers of the MDO Lab (ADflow, DAFoam, MPhys).

    from quadloop.mach import USMesh
    mesh = USMesh(options={"mesh": plane_mesh, "heights": [0.0, 1.0], "specifiedSurfaces": ["airfoil"]}, comm=MPI.COMM_WORLD)
    solver.setMesh(mesh)
"""
from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np

from . import _core
from ._common import QuadloopWarning, collective, communicator_of, numbers_of, require
from ._core import InputError
from ._meshes import Mesh, read

# What IDWarp's method needs, and a weighted mean of rigid motions does not.
_WITHOUT_EFFECT = {"aExp", "alpha", "bExp", "bucketSize", "cornerAngle", "errTol", "evalMode", "fileType", "LdefFact", "restartFile", "symmetryPlanes",
                   "symmetrySurfaces", "symmTol", "useRotations", "zeroCornerRotations"}
_DEFAULTS: dict = {"mesh": None, "gridFile": None, "heights": (0.0, 1.0), "axis": "z", "specifiedSurfaces": None}
_NEAR = 1e-6  # of the extent of the boundary: a point of a surface is a node of the mesh if it is nearer


class USMesh:
    """A 3D mesh that is one cell thick, and follows its surface.

    It is a plane mesh extruded by one cell, as `Mesh.extrude` and `quadloop extrude` write it: node n of the plane mesh is
    the nodes 2 n and 2 n + 1, at the lower and the upper height (along y the other way round). The nodes at both heights move alike, and none moves along the third
    axis, in which derivatives are 0. Coordinates are float64, of the rank. Only collective calls change the object.
    """

    def __init__(self, options: Mapping | None = None, comm=None, debug: bool = False):
        """
        options   mesh               the plane mesh, a quadloop.Mesh on `comm`, or
                  gridFile           its file
                  heights            the two coordinates along the axis (0 and 1)
                  axis               "z", or "y": the y of the plane mesh becomes z
                  specifiedSurfaces  the boundaries that move (all walls), until setSurfaceDefinition() is called
                  IDWarp's other options have no effect; a warning names them
        comm      communicator of mpi4py; None: MPI.COMM_WORLD, as in IDWarp
        debug     has no effect
        """
        self.comm = _world() if comm is None else comm
        self._ranks = communicator_of(None if isinstance(self.comm, _Alone) else self.comm)
        with self._collective("USMesh()") as call:
            self._options, heights = _checked(options or {}, self._ranks.size)
            call.same(options={name: value for name, value in self._options.items() if name != "mesh"}, mesh_from_a_file=self._options["mesh"] is None)
        self._plane: Mesh = self._options["mesh"] or read(self._options["gridFile"], None if isinstance(self.comm, _Alone) else self.comm)[0]
        along_y = self._options["axis"] == "y"
        self._heights = heights[::-1] if along_y else heights  # of the nodes 2 n and 2 n + 1
        self._in_plane = [0, 2] if along_y else [0, 1]
        self._boundary = _Boundary(self.comm, self._plane)
        self._owned = self.comm.allgather(self._plane.owned)  # nodes of the plane mesh, by rank
        self._solver: _Nodes | None = None
        self._surface: _Surface | None = None
        self._moved: Mesh = self._plane
        self._morph = None
        self._dxs = np.zeros((0, 3))

    def _collective(self, call: str) -> collective:
        return collective(self._ranks, call)

    def getOption(self, name: str):
        return self._options[name]

    # The solver's numbering

    def setExternalMeshIndices(self, ind):
        """The nodes of the 3D mesh, from 0, that the solver of this rank stores, in its order. A node may be on several ranks."""
        with self._collective("USMesh.setExternalMeshIndices()"):
            indices = _node_numbers(ind, 2 * sum(self._owned))
        self._solver = _Nodes(self.comm, self._owned, indices)

    def getSolverGrid(self) -> np.ndarray:
        """The coordinates of these nodes, flat: 3 numbers for each. Collective."""
        with self._collective("USMesh.getSolverGrid()"):
            nodes = self._require_solver()
        return self._raised(nodes.of_owners(self._moved.points[:self._moved.owned]), nodes.levels).ravel()

    def getWarpGrid(self) -> np.ndarray:
        """The coordinates of the rank's own nodes in the order of the 3D mesh, flat."""
        owned = self._moved.points[:self._moved.owned]
        return self._raised(np.repeat(owned, 2, axis=0), np.tile([0, 1], len(owned))).ravel()

    def getCommonGrid(self) -> np.ndarray:
        """The same: the ranks' own nodes, rank after rank, are the 3D mesh."""
        return self.getWarpGrid()

    # The surface

    def setSurfaceDefinition(self, pts, conn=None, faceSizes=None, cgnsBlockID=None):
        """The nodes of this rank's part of the surface that moves, shape (N, 3): nodes of the mesh's boundary, on both planes, perhaps repeated.

        The faces are those of the mesh; conn, faceSizes and cgnsBlockID are not used. Raises InputError for a point that is no node. Collective.
        """
        with self._collective("USMesh.setSurfaceDefinition()"):
            points = numbers_of(np.asarray(pts, dtype=float).reshape(-1, 3), (-1, 3), "points of the surface")
            surface = _Surface(points, self._boundary.nearest(points[:, self._in_plane]))
        self._surface = surface

    def getSurfaceCoordinates(self) -> np.ndarray:
        """The coordinates of the nodes of this rank's surface, shape (N, 3), as they were set last."""
        return self._require_surface().coordinates.copy()

    def setSurfaceCoordinates(self, coordinates):
        """New coordinates of these nodes, shape (N, 3). The nodes at the two heights and on several ranks move by the mean of what is given for them."""
        surface = self._require_surface()
        surface.coordinates = numbers_of(coordinates, surface.start.shape, "coordinates of the surface")

    def warpMesh(self):
        """Moves the mesh from its first shape to the surface as it was set. Raises TooFar if cells would become inverted. Collective."""
        with self._collective("USMesh.warpMesh()"):
            surface = self._require_surface()
        moves = (surface.coordinates - surface.start)[:, self._in_plane]
        points = self._boundary.points + self._boundary.mean(self.comm, surface.nodes, moves)
        self._morph = _core.Morph(self._plane._core, self._boundary.lines(), self._boundary.lines(points), 0.0)
        self._moved = Mesh(self._morph.mesh())

    # Derivatives

    def warpDeriv(self, dXv, solverVec: bool = True):
        """From dJ/dXv at the nodes of the solver (or, without solverVec, of getWarpGrid()), flat, to dJ/dXs: see getdXs(). Collective.

        Raises InputError if cells had to be smoothed, as nodes have no derivative then.
        """
        with self._collective("USMesh.warpDeriv()") as call:
            surface, nodes = self._require_surface(), self._require_solver() if solverVec else None
            rows = 2 * self._plane.owned if nodes is None else len(nodes.levels)
            in_plane = numbers_of(np.asarray(dXv, dtype=float).reshape(-1, 3), (rows, 3), "dXv")[:, self._in_plane]
            call.same(solverVec=bool(solverVec))
        owned = in_plane.reshape(-1, 2, 2).sum(axis=1) if nodes is None else nodes.sums(in_plane)
        of_points = self._boundary.joined(self._warped().pull_back(owned))
        copies = self._boundary.copies(self.comm, surface.nodes)
        self._dxs = np.zeros_like(surface.start)
        self._dxs[:, self._in_plane] = (of_points / np.maximum(copies, 1)[:, None])[surface.nodes]

    def getdXs(self) -> np.ndarray:
        """The result of warpDeriv() at the nodes of this rank's surface, shape (N, 3). The sum over the copies of a node is its derivative."""
        return self._dxs.copy()

    def warpDerivFwd(self, dXs, solverVec: bool = True) -> np.ndarray:
        """Velocities of the nodes of the solver (or of getWarpGrid()), flat, for velocities of the surface, shape (N, 3). Collective."""
        with self._collective("USMesh.warpDerivFwd()") as call:
            surface = self._require_surface()
            given = numbers_of(np.reshape(dXs, (-1, 3)) if np.ndim(dXs) == 1 else dXs, surface.start.shape, "dXs")
            solver = self._require_solver() if solverVec else None
            call.same(solverVec=bool(solverVec))
        of_points = self._boundary.mean(self.comm, surface.nodes, given[:, self._in_plane])
        owned = self._warped().push_forward([rows for _, rows, _ in self._boundary.lines(of_points)])
        rows = np.repeat(owned, 2, axis=0) if solver is None else solver.of_owners(owned)
        result = np.zeros((len(rows), 3))
        result[:, self._in_plane] = rows
        return result.ravel()

    def verifyWarpDeriv(self, dXv=None, solverVec: bool = True, dofStart: int = 0, dofEnd: int = 10, h: float = 1e-6, randomSeed: int = 314) -> float:
        """Compares the derivative with respect to the coordinates dofStart to dofEnd of the first rank that has nodes of the surface with central differences.

        Returns the largest deviation of a scalar product with dXv, relative to the largest product. Collective.
        """
        with self._collective("USMesh.verifyWarpDeriv()") as call:
            start, surface = self.getSurfaceCoordinates(), self._require_surface()
            size = 3 * (len(self._require_solver().levels) if solverVec else 2 * self._plane.owned)
            weights = np.random.default_rng(randomSeed + self.comm.rank).random(size) if dXv is None else np.asarray(dXv, dtype=float).ravel()
            call.same(dofStart=dofStart, dofEnd=dofEnd, h=h)
        self.warpMesh()
        self.warpDeriv(weights, solverVec)
        gradient = self.getdXs().ravel()
        grid = self.getSolverGrid if solverVec else self.getWarpGrid
        sizes = self.comm.allgather(start.size)
        if not any(sizes):
            raise InputError("the surface has no nodes on any rank")
        first = next(rank for rank, count in enumerate(sizes) if count > 0)
        pairs = []
        for dof in range(dofStart, min(dofEnd, sizes[first])):
            ends = []
            for sign in (1, -1):
                changed = start.copy()
                if self.comm.rank == first:
                    changed.ravel()[dof] += sign * h
                surface.coordinates = changed
                self.warpMesh()
                ends.append(grid())
            difference = sum(self.comm.allgather(float(weights @ (ends[0] - ends[1])))) / (2 * h)
            pairs.append((self.comm.bcast(float(gradient[dof]) if self.comm.rank == first else 0.0, root=first), difference))
        surface.coordinates = start
        self.warpMesh()
        largest = max((abs(value) for value, _ in pairs), default=0.0)
        return max((abs(value - difference) for value, difference in pairs), default=0.0) / (largest or 1.0)

    def writeGrid(self, fileName):
        """Writes the 3D mesh as it is, in the format of the suffix. Collective."""
        self._moved.extrude(fileName, np.sort(self._heights), axis=self._options["axis"])

    def _require_solver(self) -> "_Nodes":
        if self._solver is None:
            raise InputError("the nodes of the solver are not known; call setExternalMeshIndices() first")
        return self._solver

    def _require_surface(self) -> "_Surface":
        if self._surface is None:
            nodes = self._boundary.own_nodes(self._options["specifiedSurfaces"], self._plane)
            start = self._raised(np.repeat(self._boundary.points[nodes], 2, axis=0), np.tile([0, 1], len(nodes)))
            self._surface = _Surface(start, np.repeat(nodes, 2))
        return self._surface

    def _warped(self):
        if self._morph is None:
            self.warpMesh()
        return self._morph

    def _raised(self, in_plane, levels) -> np.ndarray:
        rows = np.empty((len(in_plane), 3))
        rows[:, self._in_plane] = in_plane
        rows[:, 3 - sum(self._in_plane)] = self._heights[levels]
        return rows


def _node_numbers(given, nodes: int) -> np.ndarray:
    numbers = np.asarray(given).ravel()
    if numbers.size > 0 and numbers.dtype.kind not in "iu":
        raise InputError(f"numbers of nodes are whole numbers, not {numbers.dtype}")
    wrong = numbers[(numbers < 0) | (numbers >= nodes)]
    if len(wrong):
        raise InputError(f"{wrong[0]} is no node of the mesh, whose nodes are 0 to {nodes - 1}")
    return numbers.astype(np.int64)


class _Surface:
    """A rank's part of the surface: its nodes, as rows of the boundary's nodes, and their coordinates."""

    def __init__(self, start: np.ndarray, nodes: np.ndarray):
        self.start, self.nodes, self.coordinates = start, nodes, start


class _Boundary:
    """The nodes of the boundaries of all ranks, and the lines through them."""

    def __init__(self, comm, mesh: Mesh):
        ids, points, edges = mesh.global_ids, mesh.points, mesh.edges
        self._names = list(edges)
        rows = comm.allgather([(ids[part], points[part[:, 0]]) for part in edges.values()])
        starts: dict = {}
        for number in range(len(self._names)):
            for ends, places in (of_rank[number] for of_rank in rows):
                for (a, b), place in zip(ends.tolist(), places):
                    starts.setdefault(a, []).append((b, number, place))
        if any(len(ways) > 1 for ways in starts.values()) or {way[0][0] for way in starts.values()} != set(starts):
            raise InputError("the boundaries of the mesh are no closed loops that are apart from each other, so its nodes have no derivatives")
        self.ids = np.array(sorted(starts))
        self.points = np.array([starts[node][0][2] for node in sorted(starts)])
        self._lines = _lines_of({node: way[0][:2] for node, way in starts.items()})

    def lines(self, points=None) -> list:
        """(boundary, points, whether it is open), with these rows for the nodes."""
        rows = self.points if points is None else points
        return [(self._names[number], rows[np.searchsorted(self.ids, nodes)], is_open) for number, nodes, is_open in self._lines]

    def joined(self, of_lines) -> np.ndarray:
        """The sum over the lines that share a node."""
        total = np.zeros_like(self.points)
        for (_, nodes, _), rows in zip(self._lines, of_lines):
            total[np.searchsorted(self.ids, nodes)] += rows
        return total

    def nearest(self, places) -> np.ndarray:
        """The row of the node at each place. Raises InputError if there is none."""
        near = _NEAR * np.ptp(self.points, axis=0).max()
        order = np.argsort(self.points[:, 0], kind="stable")
        along = self.points[order, 0]
        found = np.zeros(len(places), dtype=np.int64)
        for row, place in enumerate(places):
            some = order[np.searchsorted(along, place[0] - near):np.searchsorted(along, place[0] + near, "right")]
            away = np.hypot(*(self.points[some] - place).T)
            if len(away) == 0 or away.min() > near:
                raise InputError(f"the point {tuple(place.tolist())} of the surface is no node on the boundary of the mesh; give the solver the mesh of writeGrid()")
            found[row] = some[away.argmin()]
        return found

    def copies(self, comm, nodes) -> np.ndarray:
        """How often each node is in the surface, over all ranks."""
        return np.sum(comm.allgather(np.bincount(nodes, minlength=len(self.ids))), axis=0)

    def mean(self, comm, nodes, rows) -> np.ndarray:
        """The mean of the rows of the copies of each node; 0 without any."""
        sums = np.zeros_like(self.points)
        for of_nodes, of_rank in comm.allgather((nodes, rows)):
            np.add.at(sums, of_nodes, of_rank)
        return sums / np.maximum(self.copies(comm, nodes), 1)[:, None]

    def own_nodes(self, names, mesh: Mesh) -> np.ndarray:
        """The rows of this rank's nodes on boundaries of these names, or on walls."""
        unknown = set(names or ()) - set(self._names)
        if unknown:
            raise InputError(f"specifiedSurfaces: the mesh has no boundary '{unknown.pop()}'; it has {', '.join(self._names)}")
        chosen = names or [name for name, condition in mesh.conditions.items() if "wall" in condition]
        if not chosen:
            raise InputError("no boundary of the mesh is a wall; name those that move with the option specifiedSurfaces")
        nodes = np.concatenate([self.ids[:0], *(nodes for number, nodes, _ in self._lines if self._names[number] in chosen)])
        own = np.isin(nodes, mesh.global_ids[:mesh.owned])
        return np.searchsorted(self.ids, np.unique(nodes[own]))


def _lines_of(ways: dict) -> list:
    """Loops as lines: (number of the boundary, nodes, whether the line is open); `ways` has for each node the next one, and the boundary of the edge."""
    lines, left = [], set(ways)
    for first in sorted(ways):
        if first not in left:
            continue
        loop = [first]
        while (following := ways[loop[-1]][0]) != first:
            loop.append(following)
        left.difference_update(loop)
        names = [ways[node][1] for node in loop]
        breaks = [k for k in range(len(loop)) if names[k] != names[k - 1]]
        if not breaks:
            lines.append((names[0], np.array(loop), False))
        for begin, end in zip(breaks, breaks[1:] + [len(loop) + (breaks or [0])[0]]):
            lines.append((names[begin], np.array([loop[k % len(loop)] for k in range(begin, end + 1)]), True))
    return lines


class _Nodes:
    """Nodes of the 3D mesh that a rank wants, whose plane nodes are on other ranks."""

    def __init__(self, comm, counts: list, indices: np.ndarray):
        """`counts`: owned nodes of the plane mesh, by rank."""
        self._comm, self._owned = comm, counts[comm.rank]
        ends = np.cumsum(counts)
        self.levels = indices % 2
        owners = np.searchsorted(ends, indices // 2, side="right")
        self._rows = [np.flatnonzero(owners == rank) for rank in range(comm.size)]
        self._asked = comm.alltoall([indices[rows] // 2 - (ends[rank] - counts[rank]) for rank, rows in enumerate(self._rows)])

    def of_owners(self, owned) -> np.ndarray:
        """For rows of the owned plane nodes: those of the wanted nodes. Collective."""
        result = np.zeros((len(self.levels), owned.shape[1]))
        for rows, values in zip(self._rows, self._comm.alltoall([owned[asked] for asked in self._asked])):
            result[rows] = values
        return result

    def sums(self, wanted) -> np.ndarray:
        """The transpose: for rows of the wanted nodes, their sums at the owned plane nodes. Collective."""
        result = np.zeros((self._owned, wanted.shape[1]))
        for asked, values in zip(self._asked, self._comm.alltoall([wanted[rows] for rows in self._rows])):
            np.add.at(result, asked, values)
        return result


class _Alone:
    """This process without mpi4py."""
    rank, size = 0, 1

    def allgather(self, value):
        return [value]

    def alltoall(self, values):
        return values

    def bcast(self, value, root=0):
        return value


def _world():
    try:
        from mpi4py import MPI
    except ImportError:
        return _Alone()
    return MPI.COMM_WORLD


def _checked(given: Mapping, ranks: int) -> tuple:
    """The options, and the two heights."""
    unknown = set(given) - set(_DEFAULTS) - _WITHOUT_EFFECT
    if unknown:
        raise InputError(f"'{unknown.pop()}' is no option; these are {', '.join(_DEFAULTS)}")
    idle = sorted(_WITHOUT_EFFECT & set(given))
    if idle:
        warnings.warn(f"options of IDWarp without effect here: {', '.join(idle)}", QuadloopWarning, stacklevel=3)
    options = {**_DEFAULTS, **{name: value for name, value in given.items() if name not in idle}}
    if (options["mesh"] is None) == (options["gridFile"] is None):
        raise InputError("give the plane mesh either as the option 'mesh' (a quadloop.Mesh) or as 'gridFile' (its file)")
    if options["mesh"] is not None:
        of_mesh = require(options["mesh"], Mesh, "the option 'mesh'")._core.comm.size
        if of_mesh != ranks:
            raise InputError(f"the mesh is on {of_mesh} ranks, but comm has {ranks}")
    if isinstance(options["specifiedSurfaces"], str):
        options["specifiedSurfaces"] = [options["specifiedSurfaces"]]
    if options["axis"] not in ("y", "z"):
        raise InputError(f"axis is 'y' or 'z', not {options['axis']!r}")
    heights = numbers_of(options["heights"], (-1,), "heights")
    if len(heights) != 2 or heights[0] >= heights[1]:
        raise InputError("heights are two numbers, the first below the second")
    return options, heights
