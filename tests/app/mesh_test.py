#!/usr/bin/env python3
"""`quadloop mesh`: what it warns of though the mesh is good.

    mesh_test.py QUADLOOP MPIRUN
"""
import json
import math
import sys
import unittest

from program import ProgramTest

BOX, ISLE = "box\n4\n0 0\n8 0\n8 8\n0 8\n", "isle\n4\n3 3\n3 3.1\n3.1 3.1\n3.1 3\n"
ROCK = "rock\n4\n5 5\n5 6\n6 6\n6 5\nrock\n4\n2 2\n2 2.1\n2.1 2.1\n2.1 2\n"
CASE = '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.5\nmax = 1\n'
VANISH = CASE.replace("[spacing]", 'vanish = "allow"\n[spacing]')


def polygon_area(loop):
    points = [tuple(map(float, row.split())) for row in loop.splitlines()[2:]]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1])) / 2


class MeshWarnings(ProgramTest):
    def mesh(self, geometry, case=CASE, ranks=1):
        self.write("a.geom", geometry)
        self.write("case.toml", case)
        return self.done("mesh", "case.toml", "-o", "a", ranks=ranks)

    def test_nothing_to_say(self):
        table, warnings = self.mesh("1\n" + BOX)
        self.assertEqual(warnings, "")
        self.assertNotIn("vanished", table)

    def test_a_boundary_that_vanishes_is_refused(self):
        self.write("a.geom", "4\n" + BOX + ISLE + ROCK)
        self.write("case.toml", CASE)
        self.refused(1, ["boundary 'isle' near (3.05, 3.05), 0.1 wide and 0.1 high, is smaller than spacing.min = 0.5", 'vanish = "allow"'],
                     "mesh", "case.toml")
        self.assertEqual(list(self.folder.glob("case.*")), [self.folder / "case.toml"])
        self.assertIn("nor would 1 other", self.run_program("mesh", "case.toml", "--set", "spacing.min=2", "spacing.max=2").stderr)

    def test_a_boundary_that_vanishes_from_a_changed_outline_is_refused(self):
        self.mesh("3\n" + BOX + ROCK.replace("2.1", "2.9"))
        text = (self.folder / "a.mesh").read_text()
        nodes = int(text.splitlines()[1])
        self.write("solved.mesh", text + "#Number of constants\n0\n#Number of variables\n1\n" + "1\n" * nodes)
        self.write("new.geom", "2\n" + BOX + ISLE.replace("isle", "rock"))
        remesh = ["remesh", "case.toml", "--tree", "a.tree.h5", "--solution", "solved.mesh", "--geometry", "new.geom", "-o", "b"]
        self.refused(1, ["boundary 'rock' near (3.05, 3.05)", 'vanish = "allow"'], *remesh)
        self.assertIn("dropped, smaller than spacing.min: rock", self.done(*remesh, "--set", 'geometry.vanish="allow"')[0])

    def test_an_inlet_lost_between_two_walls_is_refused(self):
        wall = "wall open\n5\n1.07 0\n8 0\n8 8\n0 8\n0 0\nwall open\n2\n0 0\n1.05 0\n"
        self.write("a.geom", "3\n" + wall + "inlet open\n2\n1.05 0\n1.07 0\n")
        self.write("case.toml", CASE)
        done = self.run_program("mesh", "case.toml")
        if done.returncode == 0:  # kept as a short edge
            self.assertIn("inlet", (self.folder / "case.mesh").read_text())
        else:
            self.assertIn("boundary 'inlet'", done.stderr)

    def test_a_boundary_that_may_vanish_stands_at_the_end_of_the_table(self):
        for ranks in (1, 2):
            table, warnings = self.mesh("4\n" + BOX + ISLE + ROCK, VANISH, ranks=ranks)
            self.assertEqual(table.splitlines()[-1].strip(), "boundaries dropped, smaller than spacing.min: isle")
            self.assertEqual(warnings.count("was dropped"), 2)

    def test_kept_corners_that_share_a_smallest_leaf(self):
        comb = "".join(f"{3 + 0.02 * k:.2f} {3.26 if k % 2 else 3.24}\n" for k in range(30, -1, -1))
        for ranks in (1, 3):
            _, warnings = self.mesh("2\n" + BOX + "comb\n33\n" + comb + "3 4\n3.6 4\n", CASE.replace("0.5", "0.25"), ranks=ranks)
            self.assertRegex(warnings, r"boundary 'comb': \d+ of 37 feature points (is|are) no node of the mesh, the first at \(3")
            self.assertIn("reduce spacing.min", warnings)

    def test_max_holds_where_min_is_left_open(self):
        self.write("a.geom", "1\nbox\n4\n0 0\n3 0\n3 1\n0 1\n")
        self.write("case.toml", '[geometry]\nfile = "a.geom"\n[spacing]\nmax = 0.05\n')
        self.assertEqual(self.done("mesh", "case.toml")[1], "")
        edges = json.loads(self.done("check", "case.mesh", "--json")[0])["boundary_edges"]
        self.assertGreaterEqual(edges, 8 / 0.05)
        self.assertEqual(self.done("mesh", "case.toml", "--set", "spacing.min=0.05")[1], "")  # the root follows
        _, warnings = self.done("mesh", "case.toml", "--set", "spacing.min=0.05", "mesh.root=[0, 0, 1, 3, 1]")
        self.assertIn("the cells are 0.0625 wide, larger than spacing.max = 0.05", warnings)
        self.assertIn("set spacing.min to 0.03125 or less", warnings)

    def test_leaves_too_coarse_for_the_area(self):
        disc = "".join(f"{math.cos(math.tau * k / 99)} {math.sin(math.tau * k / 99)}\n" for k in range(99))
        self.write("a.geom", "1\ndisc\n99\n" + disc)
        self.write("case.toml", CASE.replace("0.5", "1"))
        self.refused(1, ["boundary 'disc'", "differs by 10.0 percent", "smaller spacing"], "mesh", "case.toml")

    def test_nodes_that_slide_along_a_narrow_ring(self):
        circle = lambda name, r, way: f"{name}\n100\n" + "".join(
            f"{r * math.cos(math.tau * k / 100)} {r * math.sin(way * math.tau * k / 100)}\n" for k in range(100))
        self.write("a.geom", "2\n" + circle("out", 1, 1) + circle("in", 0.99, -1))
        self.write("case.toml", '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.1\n[boundary."*"]\nspacing = 0.1\n[mesh]\ntype = "delaunay"\n'
                   'root = [-1.03125, -1.03125, 2.0625, 1, 1]\n')
        self.refused(1, ["boundary '", "area of the mesh differs by", "set smooth.sweeps = 0"], "mesh", "case.toml")
        self.done("mesh", "case.toml", "--set", "smooth.sweeps=0")

    def test_names_that_a_format_cannot_hold(self):
        rocks = ROCK.replace("rock", "bow%wave", 1).replace("rock", 'the"reef"').replace("2.1", "2.9")
        _, warnings = self.mesh("3\n" + BOX + rocks, CASE + '[mesh]\nquads = "parallel"\n[output]\nformats = ["su2", "msh", "mesh"]\n')
        self.assertEqual(warnings.count("\n"), 2, warnings)
        self.assertIn("a.su2: 2 boundaries are renamed, as this format cannot hold every name; the first, 'bow%wave', is 'bow_wave' there", warnings)
        self.assertIn("a.msh: 1 boundary is renamed", warnings)
        _, warnings = self.done("smooth", "a.mesh", "-o", "b.su2", "--sweeps", "0")
        self.assertIn("b.su2: 2 boundaries are renamed", warnings)

    def test_skew_quads_for_su2(self):
        case = CASE.replace("min = 0.5", "min = 0.05") + '[output]\nformats = ["su2"]\n'
        geometry = "2\n" + BOX + "wedge\n3\n5 5\n5.3 6.1\n6.2 5.4\n"
        _, warnings = self.mesh(geometry, case)
        self.assertRegex(warnings, r"a\.su2: \d+ % of the quads are not parallelograms, .* mesh\.quads = \"parallel\" divides them")
        self.assertEqual(self.mesh(geometry, case + '[mesh]\nquads = "parallel"\n')[1], "")
        layered = case + '[boundary.wedge]\nlayers = { first = 0.02, growth = 1.2, count = 6 }\n'
        self.assertNotIn("parallelograms", self.mesh(geometry, layered)[1])

    def test_a_lone_outline_that_runs_as_a_hole(self):
        _, warnings = self.mesh("1\nwing\n3\n0 0\n0 4\n4 0\n")
        self.assertIn("the domain is its inside", warnings)
        self.assertIn("set geometry.far_field = ", warnings)

    def test_a_source_outside_the_root(self):
        source = "[[source]]\ndisc = [20, 4, 1]\nspacing = 0.5\n"
        _, warnings = self.mesh("1\n" + BOX, CASE + source)
        self.assertEqual(warnings.count("\n"), 1)
        self.assertIn("case.toml:6: this [[source]] lies outside the root, which reaches from (0, 0) to (8, 8)", warnings)

    def test_sharp_corners_are_refined_and_stay_so_in_a_restart(self):
        kite = "2\n" + BOX + "kite\n4\n2 4\n4 4.5\n6 4\n4 3.5\n"
        case = CASE.replace("min = 0.5", "min = 0.02").replace("max = 1", "max = 1\ncurvature = 40") + "[boundary.kite]\nspacing = 0.5\n"
        plain = self.mesh(kite, case)[0]
        table, warnings = self.mesh(kite, case + "corner_spacing = 0.06\ncorner = 100\n")
        self.assertEqual(warnings, "")
        levels = [next(row for row in text.splitlines() if "levels" in row).split()[-1] for text in (plain, table)]
        self.assertEqual(levels, ["4", "8"])  # 8 / 2^8 = 0.031 is the next below 0.06
        tree, mesh = ((self.folder / name).read_bytes() for name in ("a.tree.h5", "a.mesh"))
        for ranks in (1, 3):
            self.done("mesh", "case.toml", "-o", "again", "--tree", "a.tree.h5", ranks=ranks)
            self.assertEqual((self.folder / "again.mesh").read_bytes(), mesh)
            self.assertEqual((self.folder / "again.tree.h5").read_bytes(), tree)
        _, warnings = self.mesh(kite, case + "corner_spacing = 0.06\ncorner = 170\n")
        self.assertIn("boundary 'kite' has corner_spacing = 0.06, but no corner", warnings)
        _, warnings = self.mesh(kite, case + "corner_spacing = 0.01\n")
        self.assertIn("boundary 'kite' requests a corner_spacing of 0.01 at", warnings)

    def test_a_restart_has_the_same_root_to_the_bit(self):
        """The trees' edge times their number rounds to another corner than the user's edge does."""
        blob = "1\nblob\n5\n-1 -1\n1.3 -0.9\n1.1 0.4\n0.2 1.1\n-0.9 0.8\n"
        case = CASE.replace("min = 0.5", "min = 0.05").replace("max = 1", "max = 0.5") + "[mesh]\nroot = "
        for root in ("[-1.3339617893959435, -1.4407207143346492, 0.9241473904555819, 3, 4]", "[-1.3, -1.4, 0.9, 3, 3]"):
            self.mesh(blob, case + root)
            self.done("mesh", "case.toml", "-o", "again", "--tree", "a.tree.h5")
            for suffix in (".mesh", ".tree.h5"):
                self.assertEqual((self.folder / f"again{suffix}").read_bytes(), (self.folder / f"a{suffix}").read_bytes(), root)

    def same_on_ranks(self, case):
        """The mesh by one rank, which others make too; its figures by `check`."""
        self.write("case.toml", case)
        self.done("mesh", "case.toml", "-o", "one")
        for ranks in (2, 3, 5):
            self.done("mesh", "case.toml", "-o", "many", ranks=ranks)
            for suffix in (".mesh", ".tree.h5"):
                self.assertEqual((self.folder / f"many{suffix}").read_bytes(), (self.folder / f"one{suffix}").read_bytes(), ranks)
        return json.loads(self.done("check", "one.mesh", "--json")[0])

    def test_loops_that_touch_in_a_point_are_one_pinched_node(self):
        """Holes that touch each other, one the outer boundary in a corner and one in a point of its straight side."""
        box = "box\n5\n0 0\n8 0\n8 5\n8 8\n0 8\n"
        left, right, side = "left\n3\n0 0\n3 4.1\n4.1 2.9\n", "right\n3\n3 4.1\n4.2 7\n5.3 4.7\n", "side\n4\n8 5\n6.7 4.1\n6.1 5.3\n6.9 6.2\n"
        for order in ((box, left, right, side), (side, right, left, box)):
            self.write("a.geom", "4\n" + "".join(order))
            for kind in ("hybrid", "delaunay"):
                for least in (0.5, 0.11):
                    case = CASE.replace("min = 0.5", f"min = {least}").replace("max = 1", f"max = {2 * least}")
                    figures = self.same_on_ranks(case + f'[mesh]\ntype = "{kind}"\n')
                    self.assertEqual(figures["pinched_nodes"], 3, (kind, least))
                    area = 64 - sum(abs(polygon_area(loop)) for loop in (left, right, side))
                    self.assertAlmostEqual(figures["area"], area, delta=0.02 * area)

    def test_islands_that_overlap_become_one(self):
        """Houses that share a wall, and two that overlap."""
        house = lambda name, x0, y0, x1, y1: f"{name}\n4\n{x0} {y0}\n{x0} {y1}\n{x1} {y1}\n{x1} {y0}\n"
        self.write("a.geom", "5\n" + BOX + house("a", 1, 1, 2, 2) + house("b", 2, 1, 3, 1.75) + house("c", 4, 4, 5, 5) + house("d", 4.5, 4.5, 6, 6))
        case = CASE.replace("min = 0.5", "min = 0.25").replace("max = 1", "max = 0.5")
        self.write("case.toml", case)
        self.refused(1, ["boundary 'a'", "meets boundary 'b'", 'set geometry.overlap = "union"'], "mesh", "case.toml")
        figures = self.same_on_ranks(case.replace("[spacing]", 'overlap = "union"\n[spacing]'))
        self.assertAlmostEqual(figures["area"], 64 - 1.75 - (1 + 2.25 - 0.25), places=9)
        self.assertEqual(figures["pinched_nodes"], 0)
        self.assertEqual(sorted(name for name in figures["boundaries"]), ["a", "b", "box", "c", "d"])
        _, warnings = self.done("mesh", "case.toml")
        self.assertIn("geometry.overlap: 4 loops that overlap or touch became 2, the first of them boundary 'a'", warnings)

    def test_the_extent_of_each_file_is_reported_with_its_unit(self):
        square = "  0\nLWPOLYLINE\n  8\nwall\n 90\n4\n 70\n1\n" + "".join(f" 10\n{x}\n 20\n{y}\n" for x, y in ((0, 0), (80, 0), (80, 40), (0, 40)))
        self.write("a.dxf", "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" + square + "  0\nENDSEC\n  0\nEOF\n")
        self.write("case.toml", '[geometry]\nfile = "a.dxf"\n')
        self.assertIn("a.dxf: coordinates from (0, 0) to (80, 40), in mm, meshed as given", self.done("mesh", "case.toml")[0])
        for unit, metres in (("file", 0.001), ("inch", 0.0254)):
            table = self.done("mesh", "case.toml", "--set", f"geometry.unit={unit}", "-o", unit)[0]
            self.assertIn(f"in mm, meshed in metres (unit: {metres} m)", table)
            record = json.loads(self.done("mesh", "case.toml", "--set", f"geometry.unit={unit}", "-o", unit, "--json")[0])
            self.assertEqual(record["geometry"], [{"file": "a.dxf", "extent": [0, 0, 80, 40], "unit": "mm", "metres": metres}])
            self.assertAlmostEqual(json.loads(self.done("check", f"{unit}.mesh", "--json")[0])["area"], 3200 * metres**2)

    def test_a_step_file_is_meshed_on_its_curves(self):
        """A square with a round hole, drawn in the XZ plane."""
        points = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 2)]
        data = "".join(f"#{i}=CARTESIAN_POINT('',({x:.1f},7.,{z:.1f}));\n" for i, (x, z) in enumerate(points, 1))
        data += """#6=DIRECTION('',(0.,1.,0.));
#7=DIRECTION('',(0.,0.,1.));
#8=AXIS2_PLACEMENT_3D('',#5,#6,#7);
#9=CIRCLE('hole',#8,1.);
#10=POLYLINE('box',(#1,#2,#3,#4,#1));
#11=GEOMETRIC_CURVE_SET('',(#9,#10));
#12=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.));
#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#12)) REPRESENTATION_CONTEXT('',''));
#14=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11),#13);
"""
        self.write("a.stp", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "ENDSEC;\nEND-ISO-10303-21;\n")
        case = '[geometry]\nfile = "a.stp"\n[spacing]\nmax = 0.5\n[boundary.hole]\nspacing = 0.05\n'
        self.same_on_ranks(case)
        table = self.done("mesh", "case.toml", "-o", "m")[0]
        self.assertIn("a.stp: coordinates from (0, 0) to (4, 4) in the XZ plane, in mm, meshed as given", table)
        rows = (self.folder / "m.mesh").read_text().split("\n")
        nodes = [tuple(map(float, row.split())) for row in rows[2:2 + int(rows[1])]]
        begin = next(i for i, row in enumerate(rows) if row.startswith("#Number of edges") and "(hole)" in row)
        hole = {int(n) for row in rows[begin + 2:begin + 2 + int(rows[begin + 1])] for n in row.split()}
        self.assertGreater(len(hole), 60)
        self.assertLess(max(abs(math.dist(nodes[n - 1], (2, 2)) - 1) for n in hole), 4e-12)

    def test_a_drawing_of_curves_with_a_centre_line(self):
        def arc(handle, begin, end):
            return f"0\nARC\n5\n{handle}\n8\nrim\n10\n1\n20\n0\n40\n2\n50\n{begin}\n51\n{end}\n"

        line = "0\nLINE\n5\nC7\n8\nCENTER\n10\n-4\n20\n0\n11\n4\n21\n0\n"
        self.write("a.dxf", "0\nSECTION\n2\nENTITIES\n" + arc("A1", 30, 190) + line + arc("A2", 190, 30) + "0\nENDSEC\n0\nEOF\n")
        self.write("case.toml", '[geometry]\nfile = "a.dxf"\n')
        for ranks in (1, 2, 3, 5):
            table, warnings = self.done("mesh", "case.toml", "-o", f"on_{ranks}", ranks=ranks)
            self.assertIn("a.dxf: coordinates from (-4, -2) to (4, 2)", table)
            self.assertIn("left out 1 line that joins no other line: a.dxf:21: layer 'CENTER', LINE of handle C7; if it is", warnings)
            self.assertEqual((self.folder / f"on_{ranks}.mesh").read_bytes(), (self.folder / "on_1.mesh").read_bytes())
        # the mesh is inscribed in the circle: with cells of 15 degrees it lacks about a hundredth of its area
        area = json.loads(self.done("check", "on_1.mesh", "--json")[0])["area"]
        self.assertLess(area, 4 * math.pi)
        self.assertGreater(area, 0.98 * 4 * math.pi)

    def test_a_warning_that_comes_again_is_printed_once(self):
        """One drawing for two bodies is read twice."""
        square = "  0\nLWPOLYLINE\n  8\nwall\n 90\n4\n 70\n1\n" + "".join(f" 10\n{x}\n 20\n{y}\n" for x, y in ((0, 0), (2, 0), (2, 2), (0, 2)))
        text = "  0\nTEXT\n  8\nnotes\n 10\n1\n 20\n1\n 40\n1\n  1\nhello\n"
        self.write("a.dxf", "  0\nSECTION\n  2\nENTITIES\n" + square + text + "  0\nENDSEC\n  0\nEOF\n")
        self.write("case.toml", '[geometry]\nfile = ["a.dxf", "a.dxf"]\ntranslate = [[0, 0], [4, 0]]\nfar_field = 9\n')
        for ranks in (1, 2):
            _, warnings = self.done("mesh", "case.toml", ranks=ranks)
            self.assertEqual(warnings.count("a.dxf: left out"), 1, warnings)
        record = json.loads(self.done("mesh", "case.toml", "--json")[0])
        self.assertEqual(sum("left out" in warning for warning in record["warnings"]), 1)

    def test_a_new_mesh_has_no_solution_for_a_csv(self):
        table, warnings = self.mesh("1\n" + BOX, CASE + '[output]\nformats = ["mesh", "csv"]\n')
        self.assertIn("a .csv contains only a solution", warnings)
        self.assertNotIn("a.csv", table)
        self.assertFalse((self.folder / "a.csv").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
