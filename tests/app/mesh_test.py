#!/usr/bin/env python3
"""`quadloop mesh`: what it warns of though the mesh is good.

    mesh_test.py QUADLOOP MPIRUN
"""
import sys
import unittest

from program import ProgramTest

BOX, ISLE = "box\n4\n0 0\n8 0\n8 8\n0 8\n", "isle\n4\n3 3\n3 3.1\n3.1 3.1\n3.1 3\n"
ROCK = "rock\n4\n5 5\n5 6\n6 6\n6 5\nrock\n4\n2 2\n2 2.1\n2.1 2.1\n2.1 2\n"
CASE = '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.5\nmax = 1\n'


class MeshWarnings(ProgramTest):
    def mesh(self, geometry, case=CASE, ranks=1):
        self.write("a.geom", geometry)
        self.write("case.toml", case)
        return self.done("mesh", "case.toml", "-o", "a", ranks=ranks)

    def test_nothing_to_say(self):
        table, warnings = self.mesh("1\n" + BOX)
        self.assertEqual(warnings, "")
        self.assertNotIn("vanished", table)

    def test_a_boundary_that_vanished_stands_at_the_end_of_the_table(self):
        for ranks in (1, 2):
            table, warnings = self.mesh("4\n" + BOX + ISLE + ROCK, ranks=ranks)
            self.assertEqual(table.splitlines()[-1].strip(), "boundaries that vanished, smaller than spacing.min: isle")
            self.assertEqual(warnings.count("was dropped"), 2)

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
        self.assertIn("boundary 'kite' has no corner for its corner_spacing = 0.06", warnings)
        _, warnings = self.mesh(kite, case + "corner_spacing = 0.01\n")
        self.assertIn("boundary 'kite' asks for a corner_spacing of 0.01, but spacing.min = 0.02", warnings)

    def test_a_new_mesh_has_no_solution_for_a_csv(self):
        table, warnings = self.mesh("1\n" + BOX, CASE + '[output]\nformats = ["mesh", "csv"]\n')
        self.assertIn("a .csv holds a solution alone", warnings)
        self.assertNotIn("a.csv", table)
        self.assertFalse((self.folder / "a.csv").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
