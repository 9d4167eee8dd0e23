#!/usr/bin/env python3
"""`--json`: every command prints one record of what its table says, its warnings and its files; a failure prints one too.

    json_test.py QUADLOOP MPIRUN
"""
import json
import re
import sys
import unittest

from program import ProgramTest

BOX = "box\n4\n0 0\n8 0\n8 8\n0 8\n"
ROCK = "rock\n3\n5 5\n5 6.5\n6.5 5\n"
ISLE = "isle\n4\n3 3\n3 3.1\n3.1 3.1\n3.1 3\n"
CASE = '[geometry]\nfile = "a.geom"\nvanish = "allow"\n[spacing]\nmin = 0.5\nmax = 1\n[boundary.box]\nbc = "farfield"\n[boundary.rock]\nbc = "wall"\n[smooth]\nsweeps = 0\n'
LOOP = '[adapt]\ncycles = 1\n[solver]\nmach = 0.5\niterations = 2\n'


def constant(name):
    raise ValueError(f"{name} is no JSON")


def parsed(text):
    """The one record, on one line, without a name that stands twice and without numbers that JSON does not know."""
    def unique(pairs):
        names = [name for name, _ in pairs]
        if len(set(names)) != len(names):
            raise ValueError(f"names stand twice: {names}")
        return dict(pairs)
    assert text.endswith("}\n") and text.count("\n") == 1, text
    return json.loads(text, object_pairs_hook=unique, parse_constant=constant)


def number_in(table, name):
    return float(re.search(rf"^  {re.escape(name)} +([-+.\de]+)", table, re.M).group(1))


class Json(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", "3\n" + BOX + ROCK + ISLE)
        self.write("a.toml", CASE + LOOP)

    def record(self, command, *arguments, ranks=1):
        out, said = self.done(command, *arguments, "--json", ranks=ranks)
        record = parsed(out)
        self.assertEqual((record["command"], record["status"], record["error"]), (command, 0, None))
        for warning in record["warnings"]:
            self.assertIn(warning, said)
        for file in record["files"]:
            self.assertTrue((self.folder / file).is_file(), file)
        return record

    def agree(self, table, record, names):
        for name, key in names.items():
            self.assertAlmostEqual(record[key], number_in(table, name), delta=5e-3 * max(1, abs(record[key])), msg=name)

    def test_mesh(self):
        table, _ = self.done("mesh", "a.toml", "-o", "b")
        for ranks in (1, 2):
            record = self.record("mesh", "a.toml", "-o", "a", "--geometry-out", "o.geom", ranks=ranks)
            self.assertEqual(record["files"], ["a.mesh", "a.cgns", "o.geom", "a.tree.h5"])
            self.assertEqual(len(record["warnings"]), 1)
            self.assertIn("was dropped", record["warnings"][0])
            self.assertEqual(record["boundaries_vanished"], ["isle"])
            self.agree(table, record, {"nodes": "nodes", "triangles": "triangles", "quads": "quads", "leaves": "leaves", "cut leaves": "cut_leaves",
                                       "worst quality": "worst_quality", "mean quality": "mean_quality", "smallest angle": "min_angle"})
            self.assertEqual(set(record["seconds"]["mesh"]), {"slowest", "mean"})
            for key in ("levels", "imbalance", "peak_memory_mib"):
                self.assertIn(key, record)

    def test_adapt_and_remesh(self):
        record = self.record("adapt", "a.toml", "-o", "loop", ranks=2)
        self.assertEqual([cycle["cycle"] for cycle in record["cycles"]], [0, 1])
        self.assertEqual(record["files"], sorted(str(file.relative_to(self.folder)) for file in (self.folder / "loop").glob("cycle_*/*")))
        kept = json.loads((self.folder / "loop" / "cycle_01" / "record.json").read_text())
        kept.pop("case")
        self.assertEqual(record["cycles"][1], kept)
        self.assertEqual(self.record("adapt", "a.toml", "-o", "loop", "--resume")["cycles"], [])
        record = self.record("remesh", "a.toml", "--tree", "loop/cycle_00/mesh.tree.h5", "--solution", "loop/cycle_00/mesh.mesh", "-o", "r")
        self.assertEqual(record["files"], ["r.mesh", "r.cgns", "r.tree.h5"])
        record = self.record("remesh", "a.toml", "--tree", "loop/cycle_00/mesh.tree.h5", "--solution", "loop/cycle_00/mesh.mesh", "-o", "s",
                             "--set", 'output.formats=["ugrid", "pvtu"]')
        self.assertEqual(record["files"], ["s.ugrid", "s.ugrid.mapbc", "s.pvtu", "s_0.vtu", "s.tree.h5"])
        for key in ("nodes", "outside", "drift_of_density", "seconds"):
            self.assertIn(key, record)

    def test_what_works_on_a_mesh(self):
        self.done("mesh", "a.toml", "-o", "a")
        solved = self.record("solve", "a.toml", "a.mesh", "-o", "s.mesh")
        self.assertEqual((solved["steps"], solved["converged"], len(solved["warnings"])), (2, False, 1))
        self.assertTrue({"residual", "cl", "cd", "seconds", "nodes"} <= set(solved))
        smoothed = self.record("smooth", "a.mesh", "-o", "b.mesh")
        self.assertLessEqual(smoothed["before"]["worst_quality"], smoothed["after"]["worst_quality"])
        self.assertEqual(len(smoothed["after"]["angle"]["counts"]), len(smoothed["after"]["angle"]["limits"]) + 1)
        self.assertEqual(self.record("smooth", "a.mesh", "-o", "b.mesh", "--sweeps", "0")["files"], ["b.mesh"])
        self.assertEqual(self.record("plot", "a.mesh", "-o", "a.png")["files"], ["a.png"])
        self.assertEqual(self.record("convert", "a.mesh", "a.su2")["files"], ["a.su2"])

    def test_files_written_in_twos_are_both_listed(self):
        self.assertEqual(self.record("mesh", "a.toml", "-o", "a", "--set", 'output.formats=["mesh", "ugrid"]')["files"],
                         ["a.mesh", "a.ugrid", "a.ugrid.mapbc", "a.tree.h5"])
        self.assertEqual(self.record("convert", "a.mesh", "b.ugrid")["files"], ["b.ugrid", "b.ugrid.mapbc"])
        self.assertEqual(self.record("convert", "a.mesh", "c", "--format", "ugrid")["files"], ["c", "c.mapbc"])
        self.assertEqual(self.record("smooth", "a.mesh", "-o", "s.pvtu")["files"], ["s.pvtu", "s_0.vtu"])
        self.assertEqual(self.record("extrude", "a.mesh", "-o", "e.b8.ugrid", "--layers", "1", "--thickness", "1")["files"], ["e.b8.ugrid", "e.mapbc"])
        self.assertIn("  wrote d.ugrid, d.ugrid.mapbc\n", self.done("convert", "a.mesh", "d.ugrid")[0])

    def test_check(self):
        self.done("mesh", "a.toml", "-o", "a", "-q")
        checked = self.record("check", "a.mesh")
        self.assertEqual((checked["valid"], checked["file"], checked["faults"], checked["files"]), (True, "a.mesh", [], []))

    def test_quiet_leaves_the_record_alone(self):
        out, said = self.done("mesh", "a.toml", "-o", "a", "--json", "--quiet")
        self.assertEqual(len(parsed(out)["warnings"]), 1)
        self.assertEqual(said, "")

    def test_every_warning_is_in_the_record(self):
        self.write("a.geom", "15\n" + BOX + ROCK + "".join(f"isle_{i}\n3\n{i / 4 + 1} 2\n{i / 4 + 1} 2.1\n{i / 4 + 1.1} 2\n" for i in range(13)))
        out, said = self.done("mesh", "a.toml", "-o", "a", "--json")
        self.assertEqual(len(parsed(out)["warnings"]), 13)
        self.assertEqual(said.count("\n"), 11)

    def failed(self, status, command, *arguments, ranks=1):
        result = self.run_program(*([command] if command else []), *arguments, "--json", ranks=ranks)
        record = parsed(result.stdout)
        self.assertEqual((result.returncode, record["command"], record["status"]), (status, command, status))
        self.assertIn(f"quadloop: error: {record['error']}\n", result.stderr)
        self.assertEqual(record["files"], [])
        return record

    def test_failures(self):
        for ranks in (1, 3):
            self.failed(1, "mesh", "none.toml", ranks=ranks)
            self.failed(4, "mesh", "a.toml", "-o", "none/a", ranks=ranks)
        self.failed(2, "mesh", "a.toml", "--typ", "hybrid")
        self.failed(2, "plot", "a.mesh")
        self.failed(2, None)
        self.write("bad.mesh", "4\n0 0\n1 0\n1 1\n0 1\n1\n1\n1 3 2\n0\n1\n3\n1 2\n2 3\n3 1\n")
        record = self.failed(1, "check", "bad.mesh")
        self.assertFalse(record["valid"])
        self.assertTrue(record["faults"])

    def test_a_record_that_cannot_be_written(self):
        with open("/dev/full", "w") as full:
            self.assertEqual(self.run_program("mesh", "a.toml", "-o", "a", "--json", stdout=full).returncode, 4)

    def test_help_and_version_stay(self):
        for command in ("mesh", "smooth", "adapt", "solve", "remesh", "check", "plot", "convert"):
            text, _ = self.done(command, "--json", "--help")
            self.assertIn("--json", text)
            self.assertNotIn('"command"', text)
        self.assertTrue(self.done("--json", "--version")[0].startswith("quadloop "))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
