"""What is said of a mesh before it is made: cells and memory within a factor of 1.5, refusals that name the cause, and one line where memory ends.

    python3 estimate_test.py QUADLOOP MPIRUN
"""
import json
import math
import re
import resource
import shutil
import subprocess
import unittest
from pathlib import Path

from program import QUADLOOP, ProgramTest

CASES = Path(__file__).parents[2] / "cases"
FACTOR = 1.5
MESHED = ["catamaran_x_coarse", "catamaran_x_fine", "catamaran_y_coarse", "catamaran_y_fine", "dtc_bow", "gulf_of_mexico", "naca0012", "naca0012_aoa9",
          "naca0012_m05", "naca0012_m08", "naca0012_shifted", "naca4412", "naca_design", "ring", "three_element", "vortex", "wedge"]


def geom(*loops):
    return f"{len(loops)}\n" + "".join(f"{name}\n{len(points)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) for name, points in loops)


def square(half):
    return [(-half, -half), (half, -half), (half, half), (-half, half)]


def koch(rounds):
    points = [complex(math.cos(a), math.sin(a)) for a in (math.pi / 2, -math.pi / 6, -5 * math.pi / 6)]
    for _ in range(rounds):
        points = [q for a, b in zip(points, points[1:] + points[:1])
                  for q in (a, a + (b - a) / 3, a + (b - a) / 3 * (1 + complex(0.5, math.sqrt(0.75))), a + 2 * (b - a) / 3)]
    return [(p.real, p.imag) for p in points]


CIRCLE = [(0.3 + 0.5 * math.cos(-math.pi * i / 1000), 0.2 + 0.5 * math.sin(-math.pi * i / 1000)) for i in range(2000)]
BARS = geom(("box", square(3)), ("a", [(-1, 0.001), (-1, 0.5), (1, 0.5), (1, 0.001)]), ("b", [(-1, -0.5), (-1, -0.001), (1, -0.001), (1, -0.5)]))
HARD = {
    "fractal coast": (geom(("sea", square(4)), ("coast", koch(6))), 'min = 0.0005\nmax = 0.5\n[boundary.sea]\nspacing = 0.5'),
    "points kept within leaves": (geom(("sea", square(4)), ("coast", koch(5))), 'min = 0.01\nmax = 0.5\n[boundary."*"]\nspacing = 0.2'),
    "curvature alone": (geom(("box", square(10)), ("wall", CIRCLE)), 'min = 1e-6\nmax = 1.0\ncurvature = 0.5\n[boundary."*"]\nspacing = 1.0'),
    # On a root of its own the bars lie on grid lines, and the sampled estimate is 1.65 times the number of cells.
    "gap alone": (BARS, 'min = 1e-7\nmax = 0.5\ngap = 4\n[boundary."*"]\nspacing = 0.5\n[mesh]\nroot = [-3, -3, 6, 1, 1]'),
    "tiny source": (geom(("box", square(1))), 'min = 1e-7\nmax = 0.1\n[boundary.box]\nspacing = 0.5\n[[source]]\nbox = [0.1, 0.1003, 0.1, 0.1003]\n'
                                             'spacing = 1e-6'),
    "line among large leaves": (geom(("box", square(1))), 'min = 1e-5\nmax = 0.1\n[boundary.box]\nspacing = 0.5\n[[source]]\n'
                                                          'line = [-0.9, 0.1, 0.8, 0.11]\nspacing = 1e-4'),
    "long and thin": (geom(("box", [(0, 0), (300, 0), (300, 1), (0, 1)])), 'min = 0.01\nmax = 0.05\n[boundary.box]\nspacing = 0.5'),
    "slow gradation": (geom(("box", square(10)), ("wall", CIRCLE)), 'min = 1e-4\nmax = 1.0\ngradation = 1.15\n[boundary.wall]\nspacing = 0.01'),
}
FEW = 'min = {min}\nmax = {max}\ncurvature = {curvature}\n[boundary.box]\nspacing = 1\n[boundary.wall]\nspacing = {wall}\n[[source]]\ndisc = [5, 5, 1]\n' \
      'spacing = {source}'


class Estimate(ProgramTest):
    def case(self, outline, spacing):
        self.write("case.geom", outline)
        self.write("case.toml", '[geometry]\nfile = "case.geom"\n[spacing]\n' + spacing + "\n")
        return "case.toml"

    def counts(self, case, kind, *more):
        table = self.done("mesh", str(case), "-o", "out", "--type", kind, "--set", 'output.formats=["mesh"]', *more)[0]
        number = lambda row: float(re.search(rf"^  {row} +([\d.e+]+)", table, re.M)[1])
        return number("cells, estimated"), number("triangles") + number("quads"), number("estimated"), number("peak memory")

    def near(self, estimated, true, what):
        self.assertLess(max(estimated / true, true / estimated), FACTOR, f"{what}: estimated {estimated}, true {true}")

    def test_cells_of_the_cases(self):
        for name in MESHED:
            for kind in ("hybrid", "delaunay"):
                estimated, cells, *_ = self.counts(CASES / name / "case.toml", kind, "smooth.sweeps=0")
                self.near(estimated, cells, f"{name}, {kind}")

    def test_cells_where_they_are_hard_to_know(self):
        for name, (outline, spacing) in HARD.items():
            for kind in ("hybrid", "delaunay"):
                estimated, cells, *_ = self.counts(self.case(outline, spacing), kind, "smooth.sweeps=0")
                self.near(estimated, cells, f"{name}, {kind}")

    def test_memory(self):
        for kind in ("hybrid", "delaunay"):
            *_, estimated, peak = self.counts(CASES / "gulf_of_mexico/case.toml", kind)
            self.near(estimated, peak, kind)

    def test_the_estimate_is_the_same_on_three_ranks(self):
        says = [self.run_program("mesh", str(CASES / "gulf_of_mexico/case.toml"), "-o", "out", "--max-cells", "1000", ranks=ranks).stderr for ranks in (1, 3)]
        cells = [re.search(r"about (\S+) cells", text)[1] for text in says]
        self.assertEqual(cells[0], cells[1])

    def test_the_cause_is_named_and_its_cure_fits(self):
        usual = {"min": 1e-7, "max": 1, "curvature": 20, "wall": 0.1, "source": 1}
        for key, setting, value in (("max", "spacing.max", 2e-6), ("wall", "boundary.wall.spacing", 1e-6), ("source", "[[source]] at case.toml:", 1e-6),
                                    ("curvature", "spacing.curvature", 0.001)):
            outline = geom(("box", square(10)), ("wall", CIRCLE))
            case = self.case(outline, FEW.format(**{**usual, key: value}))
            result = self.run_program("mesh", case, "-o", "out", "--max-cells", "30000")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(f"{value:g} causes most of them", result.stderr)
            self.assertIn(setting, result.stderr)
            fits = float(re.search(r"causes most of them: (\S+) fits;", result.stderr)[1])
            self.done("mesh", self.case(outline, FEW.format(**{**usual, key: fits})), "-o", "out", "--max-cells", "30000", "--quiet")

    def test_a_dry_run_tells_the_sizes_of_files_and_writes_none(self):
        formats = ["mesh", "qmesh", "cgns", "vtu", "vtkhdf", "su2", "msh", "msh41", "fluent.msh", "ugrid", "medit", "polyMesh"]
        for kind in ("hybrid", "delaunay"):
            arguments = ["mesh", str(CASES / "naca4412_layers/case.toml"), "--type", kind, "-o", kind, "--set", f"output.formats={json.dumps(formats)}"]
            told = [self.run_program(*arguments, "--dry-run", "--json", ranks=ranks) for ranks in (1, 3)]
            self.assertEqual([run.returncode for run in told], [0, 0], told)
            self.refused(1, ["--max-cells"], *arguments, "--dry-run", "--max-cells", "100")
            self.assertEqual(list(self.folder.iterdir()), [])
            one, three = (json.loads(run.stdout) for run in told)
            self.assertEqual(one["file_bytes"], three["file_bytes"])
            self.assertLess(three["estimated_memory_mib"], one["estimated_memory_mib"])
            self.done(*arguments, "--quiet")
            for name, bytes_told in one["file_bytes"].items():
                path = self.folder / name
                written = sum(part.stat().st_size for part in path.iterdir()) if path.is_dir() else path.stat().st_size
                self.assertLess(max(written, bytes_told), 1.7 * min(written, bytes_told), name)
            self.assertEqual(len(one["file_bytes"]), len(formats) + 1)
            for path in self.folder.iterdir():
                shutil.rmtree(path) if path.is_dir() else path.unlink()

    def test_a_dry_run_of_the_loop_tells_what_max_nodes_allows(self):
        """The last cycle of a run that reaches max_nodes has as many cells, in files of such sizes."""
        self.write("box.geom", geom(("box", square(1))))
        for kind in ("hybrid", "delaunay"):
            self.write("loop.toml", f"""[geometry]
file = "box.geom"
[spacing]
min = 0.1
max = 0.1
[mesh]
type = "{kind}"
[output]
formats = ["mesh", "qmesh", "cgns", "vtu", "vtkhdf"]
[boundary.box]
bc = "farfield"
[adapt]
cycles = 3
threshold = "nodes"
max_nodes = 4000
min = 0.005
[solver]
mach = 0.3
iterations = 2
initial = "vortex"
""")
            arguments = ["adapt", "loop.toml", "-o", kind]
            told = [json.loads(self.done(*arguments, "--dry-run", "--json", ranks=ranks)[0]) for ranks in (1, 3)]
            self.assertFalse((self.folder / kind).exists())
            self.assertEqual(told[0]["file_bytes"], told[1]["file_bytes"])
            self.assertLess(told[1]["estimated_memory_mib"], told[0]["estimated_memory_mib"])
            self.assertLess(told[0]["total_memory_mib"], told[1]["total_memory_mib"])
            self.assertLess(told[0]["first_cells_estimated"], told[0]["cells_estimated"] / 4)
            self.done(*arguments, "--quiet")
            cycle = self.folder / kind / "cycle_03"
            record = json.loads((cycle / "record.json").read_text())
            cells = record["triangles"] + record["quads"]
            self.assertLess(max(cells, told[0]["cells_estimated"]) / min(cells, told[0]["cells_estimated"]), FACTOR)
            self.assertEqual(len(told[0]["file_bytes"]), 6)
            for name, bytes_told in told[0]["file_bytes"].items():
                written = (cycle / Path(name).name).stat().st_size
                self.assertLess(max(written, bytes_told), 1.7 * min(written, bytes_told), name)
            self.assertAlmostEqual(told[0]["bytes_of_cycle"], sum(told[0]["file_bytes"].values()), delta=10)
            self.assertAlmostEqual(told[0]["bytes_of_run"], 4 * told[0]["bytes_of_cycle"], delta=10)
            self.refused(1, ["--max-cells"], *arguments, "--dry-run", "--max-cells", "10")

    def test_a_dry_run_of_the_loop_without_a_cap_says_so(self):
        self.write("box.geom", geom(("box", square(1))))
        self.write("loop.toml", '[geometry]\nfile = "box.geom"\n[boundary.box]\nbc = "farfield"\n[adapt]\ncycles = 2\n[solver]\nmach = 0.3\n')
        out, said = self.done("adapt", "loop.toml", "--dry-run")
        self.assertIn("adapt.max_nodes is not set", said)
        self.assertIn("nothing was written", out)

    def test_a_million_million_cells_are_refused(self):
        case = self.case(geom(("box", square(1))), "min = 1e-6\nmax = 2e-6")
        self.refused(1, ["e+12 cells", "are free", "spacing.max = 2e-06", "--max-cells"], "mesh", case, "-o", "out")
        self.assertFalse((self.folder / "out.mesh").exists())

    def test_the_cause_of_very_many_cells_is_told_before_the_work(self):
        """A slip that memory has room for, told at once, so that it can be stopped."""
        case = self.case(geom(("box", square(10)), ("wall", CIRCLE)), 'min = 1e-7\nmax = 1.0\n[boundary.box]\nspacing = 1\n[boundary.wall]\nspacing = 4e-6')
        with subprocess.Popen([QUADLOOP, "mesh", case, "-o", "out"], cwd=self.folder, stderr=subprocess.PIPE, text=True) as run:
            line = run.stderr.readline()
            run.terminate()
        self.assertRegex(line, r"^quadloop: info: about \d\.?\d*e\+07 cells, \S+ GiB of memory; boundary.wall.spacing = 4e-06 causes most of them$")

    def test_adaptation_keeps_within_the_limit(self):
        cells = []
        for allowed in ("2400", "100000"):
            warnings = self.done("adapt", str(CASES / "wedge/case.toml"), "-o", allowed, "--cycles", "1", "--max-cells", allowed)[1]
            self.assertEqual("fewer cells are refined than flagged" in warnings, allowed == "2400", warnings)
            counts = [json.loads((self.folder / allowed / f"cycle_0{k}/record.json").read_text()) for k in (0, 1)]
            cells.append([record["triangles"] + record["quads"] for record in counts])
        self.assertEqual(cells[0][0], cells[1][0])
        self.assertLess(cells[0][0], cells[0][1])
        self.assertLess(cells[0][1], 2400 * FACTOR)
        self.assertLess(cells[0][1], cells[1][1])

    def test_out_of_memory_is_one_line(self):
        case = self.case(geom(("box", square(1))), "min = 0.0005\nmax = 0.001")
        for mib in (450, 600):
            limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (mib << 20, mib << 20))
            result = subprocess.run([QUADLOOP, "mesh", case, "-o", "out", "--max-cells", "1e9", "--quiet"], cwd=self.folder, capture_output=True, text=True,
                                    preexec_fn=limit)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn("out of memory", result.stderr)


if __name__ == "__main__":
    import sys
    unittest.main(argv=sys.argv[:1])
