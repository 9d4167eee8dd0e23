#!/usr/bin/env python3
"""What the command line takes after `--set`, and what it says to slips.

    command_line_test.py QUADLOOP MPIRUN
"""
import json
import subprocess
import sys
import unittest

from program import QUADLOOP, ProgramTest

GEOMETRY = "2\nbox\n4\n0 0\n8 0\n8 8\n0 8\nmy.wall=1\n4\n3 3\n3 4\n4 4\n4 3\n"
CASE = '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.125\nmax = 2\n[smooth]\nsweeps = 0\n'
SOURCE = "source=[{ box = [0, 2, 0, 2], spacing = 0.25 }, { disc = [6, 6, 1], spacing = 0.5 }]"


class Assignments(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", GEOMETRY)
        self.write("a.toml", CASE)

    def mesh_of(self, *arguments):
        self.done("mesh", *arguments, "-o", "a", "-q")
        return (self.folder / "a.mesh").read_bytes()

    def as_in_file(self, text, *assignments):
        """The assignments give the mesh that the text at the end of the case file gives, and that is another than without it."""
        self.write("b.toml", CASE + text)
        wanted = self.mesh_of("b.toml")
        self.assertNotEqual(wanted, self.mesh_of("a.toml"))
        self.assertEqual(self.mesh_of("--set", *assignments, "a.toml"), wanted)
        self.assertEqual(self.mesh_of("a.toml", f"--set={assignments[0]}", *assignments[1:]), wanted)

    def test_many_start_and_end_at_once(self):
        for _ in range(4):
            started = [subprocess.Popen([QUADLOOP, "--version"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) for _ in range(16)]
            for process in started:
                _, said = process.communicate()
                self.assertEqual((process.returncode, said), (0, b""))

    def test_a_key_without_a_dot(self):
        self.as_in_file('[[source]]\nbox = [0, 2, 0, 2]\nspacing = 0.25\n[[source]]\ndisc = [6, 6, 1]\nspacing = 0.5\n', "smooth.sweeps=0",
                        SOURCE)

    def test_titles_with_blanks_and_equals_signs(self):
        self.as_in_file("[mesh]\ntype = \"delaunay\"\n", "title=a = b, c", "mesh.type=delaunay")

    def test_quoted_keys(self):
        self.as_in_file('[boundary."my.wall=1"]\nspacing = 0.25\n', "mesh.snap=0.4", 'boundary."my.wall=1".spacing=0.25')
        self.as_in_file('[boundary."*"]\nspacing = 0.25\n', 'boundary."*".spacing=0.25', "smooth.sweeps=0")
        self.as_in_file('[boundary."*"]\nspacing = 0.25\n', "smooth.sweeps=0", "boundary.*.spacing=0.25")

    def test_tables(self):
        self.as_in_file('[boundary.box]\nspacing = 0.25\n', "smooth.sweeps=0", "boundary={ box = { spacing = 0.25 } }")

    def test_files_and_options_are_none(self):
        (self.folder / "x=1").mkdir()
        (self.folder / "x=1" / "a.toml").write_text(CASE.replace("a.geom", "../a.geom"))
        self.assertEqual(self.mesh_of("--set", "spacing.max=1", "x=1/a.toml"), self.mesh_of("a.toml", "--set", "spacing.max=1"))
        self.assertEqual(self.mesh_of("--set", "spacing.max=1", "--type=delaunay", "a.toml"),
                         self.mesh_of("a.toml", "--type", "delaunay", "--set", "spacing.max=1"))

    def test_refusals(self):
        self.refused(1, ["--set sorce=[]: unknown key 'sorce'", "do you mean 'source'?"], "mesh", "a.toml", "--set", "spacing.max=1", "sorce=[]")
        self.refused(1, ["--set .x=1:", "not a key"], "mesh", "a.toml", "--set", ".x=1")
        self.refused(1, ["source.1.spacing", "above 0"], "mesh", "a.toml", "--set", SOURCE.replace("0.5", "-1"))


class Help(ProgramTest):
    def test_a_key_from_one_rank(self):
        said, errors = self.done("help", "spacing.max", ranks=3)
        self.assertEqual((said.count("spacing.max: number, above 0"), errors), (1, ""))

    def test_tables(self):
        said, _ = self.done("help", "spacing")
        self.assertIn("\n  gradation ", said)
        self.assertNotIn("[mesh]", said)
        self.assertIn("[mesh]", self.done("help")[0])
        self.assertEqual(json.loads(self.done("help", "spacing", "--json")[0])["help"], said)

    def test_an_unknown_key(self):
        self.refused(2, ["'spacing.mxa'", "do you mean 'spacing.max'?"], "help", "spacing.mxa")


class Slips(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", GEOMETRY)
        self.write("a.toml", CASE)

    def guessed(self, status, guess, *arguments):
        self.refused(status, [f"do you mean '{guess}'?"], *arguments)

    def test_commands_and_options(self):
        self.guessed(2, "remesh", "remehs", "a.toml")
        self.guessed(2, "--window", "plot", "a.mesh", "-o", "a.png", "--widow", "0,1,0,1")
        self.guessed(2, "--window", "plot", "a.mesh", "--widow=0,1,0,1")
        self.guessed(2, "--output", "mesh", "a.toml", "--outptu", "b")
        self.guessed(2, "--json", "--jsno", "mesh", "a.toml")
        self.guessed(2, "--version", "--verison")
        self.refused(2, ["--nonsense: there is no such option; see 'quadloop mesh --help'"], "mesh", "a.toml", "--nonsense")
        for number in ("0", "-1", "many", "inf", "nan"):
            self.refused(2, [f"--max-cells: '{number}' is not a number above 0; see"], "mesh", "a.toml", f"--max-cells={number}")

    def test_words(self):
        self.guessed(2, "delaunay", "mesh", "a.toml", "--type", "delauney")
        self.guessed(2, "nlopt", "smooth", "a.mesh", "-o", "b.mesh", "--method", "nlop")
        self.guessed(2, "quality", "plot", "a.mesh", "-o", "b.png", "--colour-by", "Quality")

    def test_the_case_file(self):
        for guess, assignment in (("max", "spacing.mx=1"), ("spacing", "spacnig.max=1"), ("delaunay", "mesh.type=delauny"), ("cgns", "output.formats=cngs"),
                                  ("box", "boundary.bax.spacing=1"), ("farfield", "boundary.box.bc=farfeild")):
            self.guessed(1, guess, "mesh", "a.toml", "--set", assignment)
        self.guessed(1, "pressure", "adapt", "a.toml", "--set", "adapt.variable=presure")

    def test_decimal_commas(self):
        for text in ("0,5 1,25", "0,5 1", "-1 -0,5e-1", "0,5;1,25", "\t0,5\t1,25 # a comment"):
            self.write("a.geom", GEOMETRY.replace("3 4\n", text + "\n"))
            self.refused(1, ["a.geom:11: ", "a decimal comma; write "], "mesh", "a.toml")
            self.write("wing.dat", "NACA\n1 0\n" + text + "\n0 0\n")
            self.refused(1, ["wing.dat:3: ", "a decimal comma; write "], "mesh", "a.toml", "--set", "geometry.file=wing.dat")
        self.write("a.geom", GEOMETRY.replace("3 4\n", "0,5 1,25\n"))
        self.refused(1, ["0,5: a decimal comma; write 0.5"], "mesh", "a.toml")
        self.write("a.mesh", "1\n0,5 1,25\n")
        self.refused(1, ["a.mesh:2: ", "0,5: a decimal comma; write 0.5"], "check", "a.mesh")
        self.write("b.toml", CASE.replace("0.125", "0,125"))
        self.refused(1, ["b.toml:4: ", "0,125: a decimal comma; write 0.125"], "mesh", "b.toml")
        self.refused(1, ["0,5: a decimal comma; write 0.5"], "mesh", "a.toml", "--set", "spacing.min=0,5")

    def test_commas_between_coordinates_stay(self):
        self.write("a.geom", GEOMETRY.replace(" ", ","))
        self.done("mesh", "a.toml", "-q")
        self.write("a.geom", GEOMETRY.replace(" ", ", "))
        self.done("mesh", "a.toml", "-q")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
