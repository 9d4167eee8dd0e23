"""The adaptive loop in memory: the meshes of the command, restart, errors."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import quadloop as ql

PROGRAM = sys.argv[1]
CASE = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.05}, adapt={"cycles": 3, "variable": "u", "norm": 2, "growth": 2.0, "max_nodes": 5000, "min": 0.005})
SOLVER = """
import numpy as np, quadloop as ql
mesh, _ = ql.read("mesh.mesh")
mesh.write("solution.mesh", {"u": np.tanh(20 * (mesh.points[:, 0] + mesh.points[:, 1] - 1))})
"""


def front(mesh, start):
    return {"u": np.tanh(20 * (mesh.points[:mesh.owned, 0] + mesh.points[:mesh.owned, 1] - 1))}


class Adaptation(unittest.TestCase):
    def test_the_mesh_follows_the_solution_which_is_transferred(self):
        starts = []

        def solve(mesh, start):
            starts.append(start)
            return front(mesh, start)
        cycles = list(ql.adapt(CASE, solve))
        self.assertEqual([cycle.number for cycle in cycles], [0, 1, 2, 3])
        self.assertGreater(cycles[-1].mesh.nodes, 2 * cycles[0].mesh.nodes)
        self.assertIsNone(starts[0])
        for cycle, start in zip(cycles[1:], starts[1:]):
            exact = front(cycle.mesh, None)["u"]
            self.assertLess(np.abs(start["u"] - exact).mean(), 0.05)
            np.testing.assert_array_equal(cycle.solution["u"], exact)
            self.assertEqual(set(cycle.drift), {"u"})

    def test_the_files_are_those_of_the_command_and_a_run_can_be_resumed(self):
        with tempfile.TemporaryDirectory() as folder:
            list(ql.adapt(CASE, front, folder=Path(folder, "whole")))
            for cycle in ql.adapt(CASE, front, folder=Path(folder, "parts")):
                if cycle.number == 1:
                    break
            with self.assertRaisesRegex(ql.InputError, "resume"):
                next(ql.adapt(CASE, front, folder=Path(folder, "parts")))
            rest = list(ql.adapt(CASE, front, folder=Path(folder, "parts"), resume=True))
            self.assertEqual([cycle.number for cycle in rest], [2, 3])
            Path(folder, "solver.py").write_text(SOLVER)
            text = CASE.changed(solver={"kind": "command", "command": [sys.executable, "-B", str(Path(folder, "solver.py"))], "mesh": "mesh.mesh", "solution": "solution.mesh"}).toml
            Path(folder, "case.toml").write_text(text)
            subprocess.run([PROGRAM, "-q", "adapt", "case.toml", "-o", "command"], cwd=folder, check=True)
            for k in range(4):
                meshes = [Path(folder, run, f"cycle_{k:02}", "mesh.mesh").read_bytes() for run in ("whole", "parts", "command")]
                self.assertEqual(meshes[0], meshes[1])
                self.assertEqual(meshes[0], meshes[2])

    def same_files_as_the_command(self, case, folder):
        Path(folder, "case.toml").write_text(case.toml)
        subprocess.run([PROGRAM, "-q", "adapt", "case.toml", "-o", "command"], cwd=folder, check=True)
        for cycle in ql.adapt(case, folder=Path(folder, "own")):
            for name in ("mesh.mesh", "mesh.tree.h5"):
                files = [Path(folder, run, f"cycle_{cycle.number:02}", name).read_bytes() for run in ("own", "command")]
                self.assertEqual(files[0], files[1], name)
        return cycle

    def test_the_solver_of_the_case_runs_without_a_function(self):
        of_flow = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.05}, boundary={"edge": {"bc": "farfield"}},
                          solver={"mach": 0.3, "iterations": 5}, adapt={"cycles": 1, "variable": "density", "passes": 1})
        with tempfile.TemporaryDirectory() as folder:
            last = self.same_files_as_the_command(of_flow, folder)
            self.assertIn("density", last.solution)
            *_, in_memory = ql.adapt(of_flow)
            np.testing.assert_array_equal(in_memory.solution["density"], last.solution["density"])
            with self.assertRaisesRegex(ql.InputError, "passes"):
                next(ql.adapt(of_flow, front))

    def test_a_program_as_the_solver_of_the_case_needs_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "solver.py").write_text(SOLVER)
            case = CASE.changed(solver={"kind": "command", "command": [sys.executable, "-B", str(Path(folder, "solver.py"))], "mesh": "mesh.mesh", "solution": "solution.mesh"})
            with self.assertRaisesRegex(ql.InputError, "give a folder"):
                next(ql.adapt(case))
            last = self.same_files_as_the_command(case, folder)
            self.assertEqual(last.number, 3)
            np.testing.assert_array_equal(last.solution["u"], front(last.mesh, None)["u"])

    def test_keys_of_adapt_can_be_given(self):
        cycles = list(ql.adapt(CASE, front, cycles=1, max_nodes=800))
        self.assertEqual(len(cycles), 2)
        self.assertLessEqual(cycles[-1].mesh.nodes, 800)

    def test_errors(self):
        def stops(mesh, start):
            raise ZeroDivisionError("of the solver")
        with self.assertRaisesRegex(ZeroDivisionError, "of the solver"):
            next(ql.adapt(CASE, stops))
        with self.assertRaisesRegex(ql.InputError, "'u'"):
            next(ql.adapt(CASE, lambda mesh, start: {"v": np.zeros(mesh.owned)}))
        with self.assertRaisesRegex(ql.InputError, "values"):
            next(ql.adapt(CASE, lambda mesh, start: {"u": np.zeros(3)}))
        with self.assertRaisesRegex(ql.InputError, "finite"):
            next(ql.adapt(CASE, lambda mesh, start: {"u": np.full(mesh.owned, np.nan)}))
        with self.assertRaisesRegex(ql.InputError, "adapt"):
            next(ql.adapt(ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1]]}), front))


unittest.main(argv=["adapt_test"])
