#!/usr/bin/env python3
"""Outlines without a file: tables [[shape]] and the command `airfoil`.

    shapes_test.py QUADLOOP MPIRUN
"""
import json
import math
import unittest

from program import ProgramTest

AIRFOIL = '[[shape]]\nname = "airfoil"\nkind = "naca"\ncode = "2412"\n'
WING = "[geometry]\nfar_field = 10\n" + AIRFOIL
ROD = """[[shape]]
name = "channel"
kind = "rectangle"
box = [-2, 6, -2, 2]
[[shape]]
name = "rod"
kind = "circle"
centre = [0.1, 0.2]
radius = 0.5
[spacing]
max = 0.5
[boundary.rod]
spacing = 0.1
bc = "wall"
"""
LAYERS = "layers = { first = 2e-3, growth = 1.3, count = 6 }\n"


def rows_of(path):
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


class ShapesTest(ProgramTest):
    def mesh(self, case, *arguments, prefix="a", ranks=1):
        self.write("case.toml", case)
        return self.done("mesh", "case.toml", "-o", prefix, *arguments, ranks=ranks)

    def record(self, *arguments):
        return json.loads(self.done(*arguments, "--json")[0])

    def nodes_of_boundary(self, name, mesh="a.mesh"):
        lines = (self.folder / mesh).read_text().splitlines()
        nodes = [tuple(map(float, line.split())) for line in lines[2:2 + int(lines[1])]]
        head = next(i for i, line in enumerate(lines) if line.startswith("#Number of edges") and f"({name})" in line)
        edges = lines[head + 2:head + 2 + int(lines[head + 1])]
        return [nodes[int(edge.split()[0]) - 1] for edge in edges]


class Shapes(ShapesTest):
    def test_nodes_lie_on_the_circle_on_any_number_of_ranks(self):
        for case in (ROD, ROD + LAYERS, ROD + '[mesh]\ntype = "delaunay"\n'):
            self.assertEqual(self.mesh(case)[1], "")
            nodes = self.nodes_of_boundary("rod")
            self.assertGreaterEqual(len(nodes), 28)  # one for each column or row of squares, 8 sin(45) radius / spacing
            for x, y in nodes:
                self.assertAlmostEqual(math.hypot(x - 0.1, y - 0.2), 0.5, delta=1e-14)
            for ranks in (2, 3, 5):
                self.mesh(case, prefix="many", ranks=ranks)
                for suffix in (".mesh", ".tree.h5"):
                    self.assertEqual((self.folder / f"many{suffix}").read_bytes(), (self.folder / f"a{suffix}").read_bytes(), ranks)

    def test_boundaries_have_their_names_and_conditions(self):
        self.mesh(ROD)
        self.assertEqual(sorted(self.record("check", "a.mesh")["boundaries"]), ["channel", "rod"])
        self.done("extrude", "a.cgns", "-o", "a.b8.ugrid", "--layers", "1", "--thickness", "1", "-q")
        self.assertIn(" 4000 rod\n", (self.folder / "a.mapbc").read_text())

    def test_nodes_lie_on_the_airfoil(self):
        """Also with a flap, turned, scaled and with layers: to 1e-12 of the extent."""
        flap = "flap = 15\nhinge = 0.7\nrotate = -4\nscale = 2.5\ntranslate = [1, 2]\n"
        for more in ("", "sharp = false\n", flap, flap + '[boundary.airfoil]\nbc = "wall"\n' + LAYERS):
            self.assertEqual(self.mesh(WING + more, "--geometry-out", "as_meshed.geom")[1], "")
            found = self.record("check", "a.mesh", "--geometry", "as_meshed.geom")
            self.assertTrue(found["valid"])
            self.assertLess(found["boundary_node_distance"], 1e-12)
            self.assertEqual(found["sharp_corners_lost"], 0)

    def test_an_airfoil_has_the_ordinates_of_its_formula(self):
        self.mesh(WING.replace("2412", "0012"))
        nodes = self.nodes_of_boundary("airfoil")
        self.assertIn((1.0, 0.0), nodes)
        for x, y in nodes:
            x = max(x, 0.0)
            half = 0.6 * (0.2969 * math.sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))))
            self.assertAlmostEqual(abs(y), half, delta=1e-8 if x > 1e-3 else 1e-6)

    def test_a_file_and_shapes_form_one_geometry(self):
        self.write("flap.geom", "1\nflap\n3\n1.1 -0.1\n1.1 -0.05\n1.4 -0.15\n")
        self.mesh(WING.replace("[geometry]", '[geometry]\nfile = "flap.geom"'))
        self.assertEqual(sorted(self.record("check", "a.mesh")["boundaries"]), ["airfoil", "farfield", "flap"])

    def test_shapes_that_cross_are_refused_with_their_place(self):
        self.write("case.toml", ROD.replace("centre = [0.1, 0.2]", "centre = [0.1, 1.9]"))
        self.refused(1, ["case.toml:5: boundaries 'rod' and 'channel' touch, cross or run along each other at (0.5898",
                         'or set geometry.overlap = "union" to join islands that overlap'], "mesh", "case.toml")

    def test_keys_of_files_need_a_file(self):
        self.write("case.toml", WING)
        self.refused(1, ["--set geometry.rotate=-9: 'geometry.rotate' needs file; a [[shape]] is placed by its own keys"],
                     "mesh", "case.toml", "--set", "geometry.rotate=-9")
        self.refused(1, ["case.toml:1: 'geometry' needs an outline", "[[shape]]"], "mesh", "case.toml", "--set", "shape=[]")

    def test_a_changed_geometry_stands_for_the_shapes(self):
        self.mesh(WING)
        text = (self.folder / "a.mesh").read_text()
        self.write("solved.mesh", text + "#Number of constants\n0\n#Number of variables\n1\n" + "1\n" * int(text.splitlines()[1]))
        self.done("airfoil", "naca0012", "-o", "new.geom", "--flap", "20")
        remesh = ["remesh", "case.toml", "--tree", "a.tree.h5", "--solution", "solved.mesh", "--geometry", "new.geom", "-o", "b"]
        self.done(*remesh, "--set", 'adapt={variable="v1"}')
        lowest = min(y for _, y in self.nodes_of_boundary("airfoil", "b.mesh"))
        self.assertAlmostEqual(lowest, -0.25 * math.sin(math.radians(20)), delta=1e-15)


class Airfoil(ShapesTest):
    def test_the_file_gives_the_mesh_of_the_table(self):
        options = {"": [], "sharp = false\nflap = 12\nhinge = [0.7, 0.01]\n": ["--blunt", "--flap", "12", "--hinge", "0.7,0.01"],
                   "rotate = -3.5\n": ["--alpha", "3.5"]}
        for keys, words in options.items():
            self.mesh(WING + keys, prefix="table")
            found = self.record("airfoil", "naca2412", "-o", "a.geom", *words)
            self.assertEqual(found["files"], ["a.geom"])
            self.mesh('[geometry]\nfile = "a.geom"\nfar_field = 10\n')
            self.assertEqual((self.folder / "a.mesh").read_bytes(), (self.folder / "table.mesh").read_bytes(), keys)

    def test_ranks_write_the_same(self):
        words = ["airfoil", "23012", "--flap", "-8", "--alpha", "2", "--far", "20", "-o"]
        self.done(*words, "one.geom")
        for ranks in (2, 3, 5):
            self.done(*words, "many.geom", ranks=ranks)
            self.assertEqual((self.folder / "many.geom").read_bytes(), (self.folder / "one.geom").read_bytes())

    def test_the_far_field_stays_where_the_airfoil_moves(self):
        self.done("airfoil", "naca0012", "-o", "a.geom", "--far", "10", "--shift", "0,1")
        rows = rows_of(self.folder / "a.geom")
        self.assertEqual(rows[0], "2")
        corners = [tuple(map(float, row.split())) for row in rows[-4:]]
        for found, wanted in zip(corners, ((-9.5, -10), (10.5, -10), (10.5, 10), (-9.5, 10))):
            self.assertAlmostEqual(math.dist(found, wanted), 0, delta=1e-12)
        self.assertEqual(rows[3].split()[:2], ["1", "1"])
        self.mesh('[geometry]\nfile = "a.geom"\n')
        self.assertEqual(sorted(self.record("check", "a.mesh")["boundaries"]), ["airfoil", "farfield"])

    def test_a_dat_file_has_seligs_order(self):
        self.done("airfoil", "naca4412", "-o", "a.dat", "--points", "50")
        rows = (self.folder / "a.dat").read_text().splitlines()
        self.assertEqual(rows[0], "naca4412")
        points = [tuple(map(float, row.split())) for row in rows[1:]]
        self.assertEqual(points[0], points[-1])
        self.assertEqual(points[0], (1, 0))
        nose = points.index((0, 0))
        self.assertGreater(points[nose // 2][1], points[-nose // 2][1])
        self.done("airfoil", "naca4412", "-o", "b.dat", "--blunt")
        blunt = (self.folder / "b.dat").read_text().splitlines()
        self.assertNotEqual(blunt[1], blunt[-1])
        for name in ("a.dat", "b.dat"):
            self.assertEqual(self.mesh(f'[geometry]\nfile = "{name}"\nfar_field = 10\n[spacing]\nmin = 0.002\n[boundary.airfoil]\nspacing = 0.02\n')[1], "")

    def test_incidence_and_flap_move_the_trailing_edge_down(self):
        def last(*words):
            self.done("airfoil", "naca0012", "-o", "a.geom", *words)
            return tuple(map(float, rows_of(self.folder / "a.geom")[3].split()[:2]))
        angle = math.radians(10)
        self.assertAlmostEqual(math.dist(last("--alpha", "10"), (math.cos(angle), -math.sin(angle))), 0, delta=1e-15)
        self.assertAlmostEqual(math.dist(last("--flap", "10"), (0.75 + 0.25 * math.cos(angle), -0.25 * math.sin(angle))), 0, delta=1e-15)
        self.assertAlmostEqual(math.dist(last("--flap", "-10", "--hinge", "0.8"), (0.8 + 0.2 * math.cos(angle), 0.2 * math.sin(angle))), 0, delta=1e-15)

    def test_wrong_words_are_refused(self):
        for code in ("naca9", "2312x", "naca26012", "clarky"):
            self.refused(1, ["is not the code of a NACA section; give four digits (2412)"], "airfoil", code, "-o", "a.geom")
        self.refused(1, ["is not inside 'naca0012'"], "airfoil", "naca0012", "-o", "a.geom", "--flap", "5", "--hinge", "0.7,0.2")
        self.refused(1, ["--far: a far field of half width 0.4", "make it larger than 0.5"], "airfoil", "naca0012", "-o", "a.geom", "--far", "0.4")
        self.refused(4, ["the folder 'no' does not exist"], "airfoil", "naca0012", "-o", "no/a.geom")
        usage = {("-o", "a.txt"): "end the name in one of them", ("-o", "a.dat", "--far", "9"): "--far: a .dat file holds an airfoil alone",
                 ("-o", "a.geom", "--hinge", "0.7"): "--hinge needs --flap", ("-o", "a.geom", "--flap", "95"): "--flap takes an angle from -90 to 90",
                 ("-o", "a.geom", "--flap", "5", "--hinge", "1,2,3"): "--hinge takes a place", ("-o", "a.geom", "--shift", "1"): "--shift takes two numbers",
                 ("-o", "a.geom", "--points", "5"): "--points", ("-o", "a.geom", "--alpha", "inf"): "--alpha takes a finite angle", (): "--output is required"}
        for words, piece in usage.items():
            self.refused(2, [piece], "airfoil", "naca0012", *words)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(argv=["shapes_test.py"])
