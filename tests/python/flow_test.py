"""The built-in solver, and designs with its gradients, on this number of ranks."""
import unittest
import warnings

import numpy as np
import scipy.optimize
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
X = 0.5 * (1 - np.cos(np.linspace(0, np.pi, 25)))
HALF = 0.6 * (0.2969 * np.sqrt(X) - 0.1260 * X - 0.3516 * X**2 + 0.2843 * X**3 - 0.1036 * X**4)
FOIL = np.vstack([np.column_stack([X, HALF])[::-1], np.column_stack([X, -HALF])[1:-1]])
TOLERANCE = 1e-11 if comm.size == 1 else 1e-5  # differences are taken on one rank
CASE = ql.Case(outlines={"foil": FOIL}, geometry={"far_field": 8.0}, spacing={"min": 0.006, "max": 2.0},
               boundary={"foil": {"spacing": 0.04, "bc": "wall"}, "farfield": {"bc": "farfield"}},
               solver={"kind": "euler", "mach": 0.5, "alpha": 2.0, "iterations": 500, "tolerance": TOLERANCE})


def cambered(by):
    return FOIL + by * np.column_stack([np.zeros(len(FOIL)), np.sin(np.pi * FOIL[:, 0])])


WAY = np.column_stack([np.sin(5 * FOIL[:, 1] + 0.3), np.sin(np.pi * FOIL[:, 0]) * np.cos(4 * FOIL[:, 0])])


class Flows(unittest.TestCase):
    def test_a_flow_has_its_numbers(self):
        mesh = ql.mesh(CASE, comm)
        flow = ql.solve(CASE, mesh)
        self.assertEqual([*flow.solution], ["density", "x_velocity", "y_velocity", "pressure"])
        self.assertEqual(len(flow.solution["density"]), mesh.owned)
        self.assertTrue(0.2 < flow.cl < 0.35 and abs(flow.cd) < 0.02 and flow.residual <= TOLERANCE, flow)
        self.assertTrue(flow.warnings == [] and flow.functionals == {} and flow.cm is None)
        np.testing.assert_allclose(flow.forces["foil"], (flow.cl, flow.cd), atol=1e-14)
        again = ql.solve(CASE, mesh, flow.solution)
        self.assertLess(again.steps, flow.steps / 3)
        if comm.size > 1:
            alone = ql.solve(CASE, ql.mesh(CASE))
            self.assertEqual((flow.cl, flow.cd, flow.steps), (alone.cl, alone.cd, alone.steps))
            return
        more = ql.solve(CASE, mesh, flow.solution, alpha=2.1, goal=["lift", "moment"], goal_about=[0.25, 0.0])
        self.assertAlmostEqual(more.functionals["lift"].value, more.cl, 12)
        self.assertAlmostEqual((more.cl - flow.cl) / 0.1, more.functionals["lift"].by_alpha, delta=1e-3 * more.cl)
        self.assertTrue(-0.1 < more.cm < 0.1 and more.cm == more.functionals["moment"].value)

    def test_a_flow_that_does_not_converge_is_a_warning(self):
        mesh = ql.mesh(CASE, comm)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            flow = ql.solve(CASE, mesh, iterations=3)
        self.assertTrue(flow.warnings[0].startswith("the residual fell to"), flow.warnings)
        self.assertEqual(len([w for w in caught if w.category is ql.QuadloopWarning]), 1 if comm.rank == 0 else 0)

    def test_what_cannot_be_solved_is_refused(self):
        mesh = ql.mesh(CASE, comm)
        with self.assertRaisesRegex(ql.InputError, "euler"):
            ql.solve(CASE, mesh, kind="command", command=["true"])
        with self.assertRaisesRegex(ql.InputError, "no variable|variable"):
            ql.solve(CASE, mesh, {"q": np.zeros(mesh.owned)})
        with self.assertRaisesRegex(ql.InputError, "values"):
            ql.solve(CASE, mesh, {"density": np.zeros(3)})
        if comm.size > 1:
            with self.assertRaisesRegex(ql.InputError, "'case' on rank 1 differs from that on rank 0"):
                ql.solve(CASE, mesh, alpha=2.0 + comm.rank)


class Designs(unittest.TestCase):
    def differences(self, run, outline, way, step=3e-6, **keys):
        """Central differences of lift and drag, on the mesh of the run."""
        ahead, behind = (run.evaluate({"foil": outline + sign * step * way}, **keys) for sign in (1, -1))
        self.assertFalse(ahead.remeshed or behind.remeshed)
        return {"lift": (ahead.cl - behind.cl) / (2 * step), "drag": (ahead.cd - behind.cd) / (2 * step)}

    def check_gradients(self, run, found, outline):
        self.assertEqual(len({*comm.allgather((found.cl, found.cd, found.gradients["drag"]["foil"].tobytes()))}), 1)
        if comm.size > 1:  # the bits are those of one rank
            return
        by_difference = self.differences(run, outline, WAY)
        for goal, difference in by_difference.items():
            slope = (found.gradients[goal]["foil"] * WAY).sum()
            self.assertAlmostEqual(slope, difference, delta=1e-6 * np.abs(found.gradients[goal]["foil"]).sum(), msg=goal)
        behind, ahead = (run.evaluate({"foil": outline}, alpha=alpha) for alpha in (1.999, 2.001))
        self.assertAlmostEqual(found.by_alpha["lift"], (ahead.cl - behind.cl) / 0.002, delta=5e-6)
        self.assertAlmostEqual(found.by_alpha["drag"], (ahead.cd - behind.cd) / 0.002, delta=5e-6)

    def test_gradients_are_those_of_differences(self):
        run = ql.Run(CASE, comm)
        outline = cambered(0.02)
        found = run.evaluate({"foil": outline}, gradient=["lift", "drag"])
        self.assertFalse(found.remeshed)
        self.assertEqual(found.mesh.check(), [])
        self.check_gradients(run, found, outline)
        alone = ql.Run(CASE).evaluate({"foil": outline}, gradient="drag")
        self.assertEqual((alone.cl, alone.cd), (found.cl, found.cd))
        np.testing.assert_array_equal(alone.gradients["drag"]["foil"], found.gradients["drag"]["foil"])
        if comm.size > 1:
            return
        first = run.evaluate()
        self.assertLess(first.cl, found.cl)

    def test_a_shape_that_is_too_far_gets_a_mesh_of_its_own(self):
        run = ql.Run(CASE, comm)
        outline = cambered(1.2)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = run.evaluate({"foil": outline}, mach=0.15, iterations=2)
        told = [str(w.message) for w in caught if w.category is ql.QuadloopWarning]
        self.assertTrue(found.remeshed)
        self.assertTrue(comm.rank > 0 or "a new mesh was generated: the cells can follow only" in told[0], told)
        np.testing.assert_array_equal(run.outlines["foil"], outline)
        self.assertEqual(run.mesh.check(), [])

    def test_cells_that_become_poor_are_replaced(self):
        run = ql.Run(CASE, comm)
        outline = cambered(0.1)
        poor = run.morph({"foil": outline}).worst_quality
        own = run.morph({"foil": FOIL}).worst_quality
        self.assertLess(poor, 0.9 * own)
        self.assertFalse(run.evaluate({"foil": outline}, min_quality=0.9 * poor).remeshed)
        with self.assertWarnsRegex(ql.QuadloopWarning, "quality of the worst cell") if comm.rank == 0 else warnings.catch_warnings():
            found = run.evaluate({"foil": outline}, gradient=["lift", "drag"], min_quality=1.0)
        self.assertTrue(found.remeshed and found.worst_quality > poor)
        np.testing.assert_array_equal(run.outlines["foil"], outline)
        self.check_gradients(run, found, outline)
        self.assertFalse(run.evaluate({"foil": outline}, min_quality=1.0).remeshed)

    @unittest.skipIf(comm.size > 1, "for one rank")
    def test_a_remesh_does_not_stop_an_optimiser(self):
        """Each shape with other cells: SLSQP, started again after a remesh, finds the camber that gives a lift."""
        run = ql.Run(CASE, comm)
        flows = []

        def miss(camber):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = run.evaluate({"foil": cambered(camber[0])}, gradient="lift", min_quality=1.0, mach=0.3)
            flows.append(found)
            slope = found.gradients["lift"]["foil"][:, 1] @ np.sin(np.pi * FOIL[:, 0])
            return (found.cl - 1.2) ** 2, 2 * (found.cl - 1.2) * slope
        values, mesh = [0.0], None
        while run.mesh is not mesh:
            mesh = run.mesh
            values = scipy.optimize.minimize(miss, values, jac=True, method="SLSQP", bounds=[(0, 0.2)], options={"ftol": 1e-14}).x
        self.assertTrue(any(found.remeshed for found in flows))
        self.assertAlmostEqual(run.evaluate({"foil": cambered(values[0])}, mach=0.3).cl, 1.2, delta=1e-5)
        self.assertLess(len(flows), 40)

    def test_wrong_requests_are_refused(self):
        run = ql.Run(CASE, comm)
        with self.assertRaisesRegex(ql.InputError, "goal"):
            run.evaluate(gradient="thrust")
        with self.assertRaisesRegex(ql.InputError, "min_quality"):
            run.evaluate(min_quality=2)
        if comm.size > 1:
            with self.assertRaisesRegex(ql.InputError, "'outlines' on rank 1 differs from that on rank 0"):
                run.evaluate({"foil": cambered(0.01 * comm.rank)})
        with self.assertRaisesRegex(ql.InputError, "adapt"):
            ql.Run(CASE, comm, adapted=True)


unittest.main(argv=["flow_test"])
