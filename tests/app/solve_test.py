#!/usr/bin/env python3
"""`quadloop solve`: the same bytes on any number of ranks, starts from what it wrote, names what it refuses.

    solve_test.py QUADLOOP MPIRUN
"""
import csv
import itertools
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

QUADLOOP, MPIRUN = (str(Path(program).resolve()) for program in sys.argv[1:3])

CASE = """[geometry]
file = "body.geom"
far_field = 8
[spacing]
min = 0.05
max = 1
[boundary.body]
bc = "wall"
[mesh]
type = "hybrid"
[solver]
mach = 0.4
alpha = 3
iterations = 200
"""
BODY = "1\nbody\n4\n-0.5 0\n0 0.1\n0.5 0\n0 -0.1\n"


BEVEL = CASE.replace("body.geom", "bevel.geom").replace("far_field = 8", "far_field = 40").replace("min = 0.05\nmax = 1", "min = 0.002\nmax = 5\ncurvature = 10") \
    .replace('[boundary.body]', '[boundary.farfield]\nbc = "farfield"\nspacing = 5\n[boundary.body]\nspacing = 0.012') \
    .replace("mach = 0.4\nalpha = 3\niterations = 200", "mach = 0.3\nalpha = 0\niterations = 400")


SQUARE = """[geometry]
file = "square.geom"
far_field = 8
[spacing]
min = 0.02
max = 1
gradation = 2
[boundary.body]
bc = "wall"
spacing = 0.06
[boundary.farfield]
bc = "farfield"
[solver]
mach = 3
alpha = 0
iterations = 120
"""


def naca_2412_with_a_bevel(points=80):
    """The outline whose blunt trailing edge is not closed, but drawn to the point (1, 0): bevels shorter than spacing.min."""
    def at(x, side):
        thickness = 0.6 * (0.2969 * x ** 0.5 - 0.126 * x - 0.3516 * x * x + 0.2843 * x ** 3 - 0.1015 * x ** 4)
        p, m = 0.4, 0.02
        camber = m / p ** 2 * (2 * p * x - x * x) if x < p else m / (1 - p) ** 2 * (1 - 2 * p + 2 * p * x - x * x)
        slope = 2 * m / p ** 2 * (p - x) if x < p else 2 * m / (1 - p) ** 2 * (p - x)
        angle = math.atan(slope)
        return x - side * thickness * math.sin(angle), camber + side * thickness * math.cos(angle)
    xs = [0.5 * (1 - math.cos(math.pi * i / points)) for i in range(points + 1)]
    outline = [(1.0, 0.0)] + [at(x, 1) for x in reversed(xs[:-1])] + [at(x, -1) for x in xs[1:-1]]
    return f"1\nbody\n{len(outline)}\n" + "".join(f"{x:.6f} {y:.6f}\n" for x, y in outline)


class SolveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="quadloop_solve_")
        cls.folder = Path(cls.holder.name)
        (cls.folder / "case.toml").write_text(CASE)
        (cls.folder / "body.geom").write_text(BODY)
        cls.run_quadloop("mesh", "case.toml", "-o", "m", ranks=1)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def run_quadloop(cls, *arguments, ranks=1, status=0):
        launcher = [MPIRUN, "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run([*launcher, QUADLOOP, *arguments], cwd=cls.folder, capture_output=True, text=True)
        assert done.returncode == status, f"{arguments}: {done.returncode}\n{done.stderr}"
        return done

    def test_the_same_bytes_on_any_number_of_ranks(self):
        for ranks in (1, 2, 3, 5):
            self.run_quadloop("solve", "case.toml", "m.mesh", "-o", f"flow{ranks}.mesh", "--set", "solver.iterations=8", ranks=ranks)
            for suffix in ("mesh", "walls.csv", "history.csv"):
                self.assertEqual((self.folder / f"flow{ranks}.{suffix}").read_bytes(), (self.folder / f"flow1.{suffix}").read_bytes(), suffix)

    def test_converges_and_starts_from_its_own_flow(self):
        first = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "flow.mesh")
        self.assertNotIn("warning", first.stderr)
        rows = {line.split()[0]: line.split()[1] for line in first.stdout.splitlines() if len(line.split()) == 2}
        self.assertLess(float(rows["residual"]), 1e-8)
        self.assertGreater(float(rows["cl"]), 0.1)
        text = (self.folder / "flow.mesh").read_text()
        self.assertIn("#names: density x_velocity y_velocity pressure", text)
        again = self.run_quadloop("solve", "case.toml", "flow.mesh", "-o", "flow.cgns", "--set", "solver.tolerance=1e-7")
        rows = {line.split()[0]: line.split()[1] for line in again.stdout.splitlines() if len(line.split()) == 2}
        self.assertLess(int(rows["steps"]), 150)

    def test_walls_forces_and_history_stand_beside_the_flow(self):
        done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "w.mesh", "--json")
        record = json.loads(done.stdout)
        self.assertEqual(record["files"], ["w.mesh", "w.walls.csv", "w.history.csv"])
        self.assertEqual(record["forces"], {"body": {"cl": record["cl"], "cd": record["cd"], "cl_friction": 0, "cd_friction": 0}})
        head, *rows = [line.split(",") for line in (self.folder / "w.walls.csv").read_text().splitlines()]
        self.assertEqual(head, ["boundary", "s", "x", "y", "Cp", "Mach"])
        self.assertEqual({row[0] for row in rows}, {"body"})
        walked = [[float(word) for word in row[1:]] for row in rows]
        self.assertEqual(walked[0][:3], [0, 0.5, 0])
        self.assertEqual(walked[0][1:], walked[-1][1:])
        self.assertAlmostEqual(walked[-1][0], 4 * math.hypot(0.5, 0.1), places=9)
        self.assertLess(walked[1][2], 0)  # the domain to the left: along the lower side first
        angle = math.radians(3)
        lift = drag = 0
        for (_, x, y, cp, _), (_, next_x, next_y, next_cp, _) in zip(walked, walked[1:]):
            force_x, force_y = 0.5 * (cp + next_cp) * (next_y - y), -0.5 * (cp + next_cp) * (next_x - x)
            lift += force_y * math.cos(angle) - force_x * math.sin(angle)
            drag += force_x * math.cos(angle) + force_y * math.sin(angle)
        self.assertAlmostEqual(lift, record["cl"], places=9)
        self.assertAlmostEqual(drag, record["cd"], places=9)
        head, *rows = [line.split(",") for line in (self.folder / "w.history.csv").read_text().splitlines()]
        self.assertEqual(head, ["step", "residual", "cl", "cd"])
        self.assertEqual([int(row[0]) for row in rows], list(range(record["steps"] + 1)))
        self.assertEqual([float(word) for word in rows[-1][1:]], [record["residual"], record["cl"], record["cd"]])

    def test_fields_that_are_asked_for_stand_beside_the_solution(self):
        fields = ["--set", "solver.iterations=2", 'output.fields=["mach", "pressure_coefficient"]']
        self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "fields.mesh", *fields)
        self.assertIn("#names: density x_velocity y_velocity pressure mach pressure_coefficient\n", (self.folder / "fields.mesh").read_text())
        done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "no.mesh", "--set", 'output.fields=["match"]', status=1)
        self.assertIn("do you mean 'mach'?", done.stderr)
        (self.folder / "fields.toml").write_text(CASE + "[adapt]\ncycles = 0\n[output]\nformats = ['vtu']\n")
        self.run_quadloop("adapt", "fields.toml", "-o", "fields", *fields)
        cycle = self.folder / "fields" / "cycle_00"
        self.assertIn(b'Name="pressure_coefficient"', (cycle / "mesh.vtu").read_bytes())
        self.assertIn("#names: density x_velocity y_velocity pressure\n", (cycle / "mesh.mesh").read_text())
        self.assertEqual((cycle / "mesh.walls.csv").read_text().count("body"), len((cycle / "mesh.walls.csv").read_text().splitlines()) - 1)
        self.assertEqual(json.loads((cycle / "record.json").read_text())["forces"].keys(), {"body"})

    def test_every_format_with_a_place_for_the_flow_is_written(self):
        for suffix in ("mesh", "cgns", "vtu"):
            done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", f"each.{suffix}", "--set", "solver.iterations=2")
            self.assertIn(f"wrote each.{suffix}", done.stdout)
        vtu = (self.folder / "each.vtu").read_bytes()
        for name in ("density", "x_velocity", "y_velocity", "pressure"):
            self.assertIn(f'Name="{name}"'.encode(), vtu)
        again = self.run_quadloop("solve", "case.toml", "each.vtu", "-o", "again.mesh", "--set", "solver.iterations=2")
        self.assertNotIn("starts from the free stream", again.stderr)

    def test_a_bevelled_trailing_edge_does_not_lose_the_flow(self):
        (self.folder / "bevel.toml").write_text(BEVEL)
        (self.folder / "bevel.geom").write_text(naca_2412_with_a_bevel())
        self.run_quadloop("mesh", "bevel.toml", "-o", "bevel")
        done = self.run_quadloop("solve", "bevel.toml", "bevel.mesh", "-o", "bevel_flow.mesh")
        self.assertNotIn("warning", done.stderr)

    def test_a_flow_does_not_stand_still_to_the_last_step(self):
        """Changes that no node can bear: of 400 steps 329 had the same residual, bit for bit."""
        (self.folder / "square.toml").write_text(SQUARE)
        (self.folder / "square.geom").write_text("1\nbody\n4\n-0.5 -0.5\n-0.5 0.5\n0.5 0.5\n0.5 -0.5\n")
        self.run_quadloop("mesh", "square.toml", "-o", "square")
        self.run_quadloop("solve", "square.toml", "square.mesh", "-o", "square_flow.mesh")
        with open(self.folder / "square_flow.history.csv", encoding="ascii") as file:
            residuals = [row["residual"] for row in csv.DictReader(file)]
        same = max(len(list(rows)) for _, rows in itertools.groupby(residuals))
        self.assertLess(same, 10)

    def test_adapt_refuses_a_variable_before_the_first_cycle(self):
        (self.folder / "adapt.toml").write_text(CASE + "[adapt]\ncycles = 0\n")
        done = self.run_quadloop("adapt", "adapt.toml", "-o", "never", "--set", 'adapt.variable="rho"', status=1)
        for words in ("adapt.toml", "adapt.variable", "'rho'", "density, x_velocity, y_velocity, pressure"):
            self.assertIn(words, done.stderr)
        self.assertFalse((self.folder / "never").exists())

    def test_adapt_says_what_it_solves_and_what_it_lacked(self):
        (self.folder / "plain.toml").write_text(CASE.split("[solver]")[0] + "[adapt]\ncycles = 0\n")
        done = self.run_quadloop("adapt", "plain.toml", "-o", "plain")
        self.assertIn("no table [solver]: the built-in solver runs at Mach 0.8 and 0 degrees", done.stderr)
        (self.folder / "short.toml").write_text(CASE + "[adapt]\ncycles = 0\n")
        done = self.run_quadloop("adapt", "short.toml", "-o", "short", "--set", "solver.iterations=3")
        self.assertIn("cycle 0: the residual fell to", done.stderr)
        self.assertIn("increase solver.iterations", done.stderr)

    def test_warns_where_it_does_not_get_there(self):
        done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "short.mesh", "--set", "solver.iterations=3")
        self.assertIn("warning: the residual fell to", done.stderr)
        self.assertNotIn("time", done.stderr)

    def test_refusals_name_the_cure_and_leave_nothing(self):
        for extra, words in ((["solver.machs=1"], "unknown key 'solver.machs'"), (["boundary.body.bc=none"], "[boundary.body] set bc"),
                             (["solver.kind='command'", "solver.command=['x']"], "built-in solver alone")):
            settings = [word for assignment in extra for word in ("--set", assignment)]
            done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "no.mesh", *settings, status=1)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        done = self.run_quadloop("solve", "case.toml", "m.mesh", "-o", "no.su2", status=1)
        self.assertIn("cannot store the flow", done.stderr)
        self.assertEqual([path.name for path in self.folder.glob("no.*")], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
