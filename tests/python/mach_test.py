"""quadloop.mach.USMesh by the calls that ADflow, DAFoam and MPhys make of IDWarp's, on this number of ranks."""
import os
import tempfile
import unittest
import warnings

import numpy as np
from mpi4py import MPI

import quadloop as ql
from quadloop.mach import USMesh

comm = MPI.COMM_WORLD
ANGLES = np.linspace(0, 2 * np.pi, 40, endpoint=False)
OVAL = np.column_stack([np.cos(ANGLES), 0.5 * np.sin(ANGLES)])
TABLES = {"geometry": {"far_field": 8.0}, "spacing": {"max": 1.0, "min": 0.02}}
WALL = {"spacing": 0.08, "bc": "wall"}


def oval():
    return ql.mesh(ql.Case(outlines={"body": OVAL}, **TABLES, boundary={"body": {**WALL, "layers": {"first": 0.005, "growth": 1.2, "count": 8}}}), comm)


def two_sides():
    """An oval whose sides have names of their own."""
    return ql.mesh(ql.Case(outlines={"upper": ql.curve(OVAL[:21]), "lower": ql.curve(np.vstack([OVAL[20:], OVAL[:1]]))}, **TABLES,
                           boundary={"upper": WALL, "lower": WALL}), comm)


class Solver:
    """Stands in for ADflow and DAFoam: it stores its own part of the 3D mesh, in which nodes at the edge of a part are on several ranks."""

    def __init__(self, plane, heights, in_plane, surfaces):
        nodes = comm.bcast(sum(comm.allgather(plane.owned)))
        wanted = np.arange(2 * nodes)
        part = np.array_split(wanted, comm.size)[-1 - comm.rank]  # unlike the mesh's own
        self.indices = np.concatenate([part, wanted[:9]])[::-1]
        everywhere = np.vstack(comm.allgather(plane.points[:plane.owned]))
        grid = np.empty((2 * nodes, 3))
        grid[:, in_plane] = np.repeat(everywhere, 2, axis=0)
        grid[:, 3 - sum(in_plane)] = np.tile(heights, nodes)
        faces = np.vstack([plane.global_ids[plane.edges[name]] for name in surfaces])  # each face by itself, as ADflow has them
        corners = np.stack([2 * faces[:, 0], 2 * faces[:, 1], 2 * faces[:, 1] + 1, 2 * faces[:, 0] + 1], axis=1)
        self.points = grid[corners.ravel()] + 1e-11  # files round
        self.faces = np.arange(corners.size), np.full(len(corners), 4)
        self.weights = np.sin(1 + 0.7 * np.arange(3 * len(self.indices)) + comm.rank)

    def setMesh(self, mesh):
        self.mesh = mesh
        mesh.setExternalMeshIndices(self.indices)
        mesh.setSurfaceDefinition(self.points, *self.faces)

    def value(self):
        """A functional of the grid."""
        grid = self.mesh.getSolverGrid()
        return sum(comm.allgather(float((self.weights * np.sin(grid)).sum())))

    def gradient(self):
        return self.weights * np.cos(self.mesh.getSolverGrid())


def changed(points, by, in_plane):
    x, y = points[:, in_plane].T
    result = points.copy()
    result[:, in_plane] += by * np.column_stack([np.sin(3 * y), x**2])
    return result


class Warping(unittest.TestCase):
    def check(self, plane, surfaces, axis="z"):
        in_plane = [0, 1] if axis == "z" else [0, 2]
        options = {"mesh": plane, "heights": [0.5, 2.0], "axis": axis, "specifiedSurfaces": surfaces}
        mesh = USMesh(options=options, comm=comm)
        solver = Solver(plane, [0.5, 2.0] if axis == "z" else [2.0, 0.5], in_plane, surfaces)
        solver.setMesh(mesh)
        start = mesh.getSurfaceCoordinates()
        np.testing.assert_array_equal(start, solver.points)
        first = mesh.getSolverGrid().reshape(-1, 3)
        shape = changed(start, 0.03, in_plane)
        mesh.setSurfaceCoordinates(shape)
        mesh.warpMesh()

        grid = mesh.getSolverGrid().reshape(-1, 3)
        self.assertEqual(grid.dtype, np.float64)
        third = 3 - sum(in_plane)
        np.testing.assert_array_equal(grid[:, third], first[:, third])
        self.assertGreater(comm.allreduce(np.abs(grid - first).max(), MPI.MAX), 0.02)
        everywhere = {i: tuple(p) for part in comm.allgather(list(zip(solver.indices, grid[:, in_plane]))) for i, p in part}
        self.assertTrue(all(everywhere[i] == everywhere[i ^ 1] for i in everywhere), "both planes alike")

        way = np.cos(shape)  # also along the third axis, where nothing moves
        ahead = mesh.warpDerivFwd(way)
        self.assertEqual(ahead.shape, (3 * len(solver.indices),))
        self.assertEqual(np.abs(ahead.reshape(-1, 3)[:, third]).max(), 0)
        mesh.warpDeriv(solver.gradient())
        back = mesh.getdXs()
        self.assertEqual(back.shape, start.shape)
        self.assertEqual(np.abs(back[:, third]).max(initial=0), 0)
        products = comm.allreduce(float(solver.gradient() @ ahead)), comm.allreduce(float((back * way).sum()))
        self.assertLess(abs(products[0] - products[1]), 1e-12 * abs(products[0]))

        ends, step = [], 1e-5
        for sign in (1, -1):
            mesh.setSurfaceCoordinates(shape + sign * step * way)
            mesh.warpMesh()
            ends.append((mesh.getSolverGrid(), solver.value()))
        difference = (ends[0][0] - ends[1][0]) / (2 * step)
        largest = comm.allreduce(np.abs(ahead).max(), MPI.MAX)
        self.assertLess(comm.allreduce(np.abs(difference - ahead).max(), MPI.MAX), 1e-8 * largest)
        self.assertLess(abs((ends[0][1] - ends[1][1]) / (2 * step) - products[1]), 1e-8 * abs(products[1]))

        mesh.setSurfaceCoordinates(shape)
        deviation = mesh.verifyWarpDeriv(dofEnd=4)
        self.assertTrue(0 < deviation < 1e-6, deviation)
        np.testing.assert_array_equal(mesh.getSolverGrid().reshape(-1, 3), grid, "as before the verification")

    def test_a_closed_boundary_with_layers(self):
        self.check(oval(), ["body"])

    def test_a_loop_of_two_boundaries_along_y(self):
        self.check(two_sides(), ["upper", "lower"], "y")

    def test_walls_move_by_default_and_the_grid_is_that_of_the_file(self):
        plane = oval()
        for axis in ("z", "y"):
            mesh = USMesh({"mesh": plane, "axis": axis}, comm)
            start = mesh.getSurfaceCoordinates()
            walls = len({*plane.global_ids[np.unique(plane.edges["body"])]} & {*plane.global_ids[:plane.owned]})
            self.assertGreaterEqual(len(start), 2 * walls)
            mesh.setSurfaceCoordinates(changed(start, 0.02, [0, 1] if axis == "z" else [0, 2]))
            mesh.warpMesh()
            folder = comm.bcast(tempfile.mkdtemp() if comm.rank == 0 else None)
            mesh.writeGrid(os.path.join(folder, "a.su2"))
            grid = np.concatenate(comm.allgather(mesh.getCommonGrid())).reshape(-1, 3)
            with open(os.path.join(folder, "a.su2"), encoding="ascii") as file:
                lines = file.read().splitlines()
            begin = next(i for i, line in enumerate(lines) if line.startswith("NPOIN"))
            rows = np.array([[float(word) for word in line.split()[:3]] for line in lines[begin + 1:begin + 1 + len(grid)]])
            np.testing.assert_array_equal(rows, grid)

            of_grid = np.sin(np.arange(mesh.getWarpGrid().size))
            way = np.ones_like(start)
            ahead = mesh.warpDerivFwd(way, solverVec=False)
            mesh.warpDeriv(of_grid, solverVec=False)
            products = comm.allreduce(float(of_grid @ ahead)), comm.allreduce(float((mesh.getdXs() * way).sum()))
            self.assertLess(abs(products[0] - products[1]), 1e-12 * max(1, abs(products[0])))

    def test_what_is_refused(self):
        plane = oval()
        with self.assertRaisesRegex(ql.InputError, "'gridFil' is no option"):
            USMesh({"gridFil": "a.cgns"}, comm)
        with self.assertRaisesRegex(ql.InputError, "give the plane mesh"):
            USMesh({}, comm)
        with self.assertRaisesRegex(ql.InputError, "no boundary 'wing'; it has .*body"):
            USMesh({"mesh": plane, "specifiedSurfaces": ["wing"]}, comm).getSurfaceCoordinates()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = USMesh({"mesh": plane, "aExp": 3.0, "LdefFact": 1.0}, comm)
        self.assertIn("without effect here: LdefFact, aExp", str(caught[0].message))
        with self.assertRaisesRegex(ql.InputError, "setExternalMeshIndices"):
            mesh.getSolverGrid()
        with self.assertRaisesRegex(ql.InputError, "is no node of the mesh"):
            mesh.setExternalMeshIndices([0, 10**9])
        with self.assertRaisesRegex(ql.InputError, "is no node on the boundary"):
            mesh.setSurfaceDefinition([[0.1, 0.1, 0.0]])
        start = mesh.getSurfaceCoordinates()
        with self.assertRaisesRegex(ql.InputError, "coordinates of the surface"):
            mesh.setSurfaceCoordinates(start[:, :2])
        mesh.setSurfaceCoordinates(start @ np.array([[-0.9, -0.4, 0], [0.4, -0.9, 0], [0, 0, 1]]))  # turned too far
        with self.assertRaises(ql.TooFar):
            mesh.warpMesh()


unittest.main(argv=["mach_test"])
