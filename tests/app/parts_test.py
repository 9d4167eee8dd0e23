#!/usr/bin/env python3
"""A mesh in parts for a solver's ranks, from the command line: the same files on any number of ranks, each a valid mesh, the whole again.

    parts_test.py QUADLOOP MPIRUN
"""
import json
import sys
import unittest

import convert_test
from program import ProgramTest

LAYERS = '[boundary.my-wall]\nbc = "wall"\nlayers = { first = 0.01, growth = 1.3, count = 4 }\n'


class Parts(ProgramTest):
    def case(self, more=""):
        self.write("a.geom", convert_test.GEOMETRY)
        self.write("case.toml", convert_test.CASE + more)

    def made(self, prefix, *options, ranks=1):
        return json.loads(self.done("mesh", "case.toml", "-o", prefix, "--json", "-q", *options, ranks=ranks)[0])

    def text(self, name):
        return (self.folder / name).read_text()

    def content(self, name):
        return (self.folder / name).read_bytes()

    def test_each_kind_and_number(self):
        for kind, more in (("hybrid", ""), ("delaunay", ""), ("hybrid", LAYERS)):
            self.case(more)
            for parts in (1, 2, 7, 64):
                with self.subTest(kind=kind, layers=bool(more), parts=parts):
                    record = self.made("a", "--type", kind, "--set", f"output.partitions={parts}")
                    self.assertEqual(record["parts"], parts)
                    self.assertEqual(len(record["files"]), 3 + 2 * parts)
                    self.assertEqual(record["edge_cut"] == 0, parts == 1)
                    self.assertLessEqual(record["part_cells"][0], record["part_cells"][1])
                    self.done("convert", "a.parts", "back.mesh", "-q")
                    self.assertEqual(self.text("back.mesh"), self.text("a.mesh"))
                    for part in {1, (parts + 1) // 2, parts}:
                        self.assertTrue(json.loads(self.done("check", f"a.part_{part:04}.mesh", "--json")[0])["valid"])

    def test_same_files_on_any_number_of_ranks(self):
        self.case(LAYERS)
        options = ["--set", "output.partitions=4", "--set", 'output.formats=["mesh","vtu"]']
        files = self.made("a", *options)["files"]
        alone = {file: self.content(file) for file in files if not file.endswith(".h5")}
        for ranks in (2, 3, 5):
            self.made("a", *options, ranks=ranks)
            for file, content in alone.items():
                self.assertEqual(self.content(file), content, f"{file} on {ranks} ranks")

    def test_solution_and_blocks(self):
        self.case()
        self.made("a")
        self.write("s.mesh", convert_test.with_solution(self.text("a.mesh")))
        self.write("b.mesh", convert_test.TWO_BLOCKS)
        lines = self.text("a.mesh").split("\n")
        cells = sum(int(lines[lines.index(f"#Number of {kind} elements") + 1]) for kind in ("triangular", "quadrilateral"))
        rows = "".join(f"{(i + 0.5) / 7!r} {i}\n" for i in range(cells))
        self.write("c.mesh", self.text("s.mesh") + "#Number of cell variables\n2\n#names: volume level\n" + rows)
        for mesh, parts, ranks in (("s.mesh", 5, 1), ("s.mesh", 5, 3), ("c.mesh", 5, 2), ("b.mesh", 2, 1), ("b.mesh", 3, 2)):
            self.done("convert", mesh, "out.mesh", "--parts", str(parts), "-q", ranks=ranks)
            self.done("convert", "out.parts", "back.mesh", "-q")
            self.assertEqual(self.text("back.mesh"), self.text(mesh))

    def test_blocks_in_vtk_parts(self):
        self.write("b.mesh", convert_test.TWO_BLOCKS)
        for parts in (1, 2, 3):
            self.done("convert", "b.mesh", "out.vtu", "--parts", str(parts), "-q")
            self.done("convert", "out.parts", "back.mesh", "-q")
            self.assertEqual(self.text("back.mesh"), convert_test.TWO_BLOCKS)
            record = json.loads(self.done("check", "out.pvtu", "--json", "-q")[0])
            self.assertEqual((record["warnings"], record["blocks"]), ([], 2))

    def test_a_wake_stays_one(self):
        self.case(LAYERS + '[[wake]]\nfrom = "my-wall"\nlength = 1.0\nspacing = 0.1\n')
        self.made("a", "--set", "output.partitions=3", "--set", 'output.formats=["mesh","vtu","cgns"]')
        self.assertIn("\n# strip ", self.text("a.mesh"))
        self.done("convert", "a.parts", "back.mesh", "-q")
        self.assertEqual(self.text("back.mesh"), self.text("a.mesh"))

    def test_remesh_writes_parts_of_what_it_carries_over(self):
        self.case('[adapt]\nvariable = "density"\n')
        self.done("mesh", "case.toml", "-o", "a", "-q")
        self.write("a.mesh", convert_test.with_solution(self.text("a.mesh")))
        for ranks in (1, 2):
            record = json.loads(self.done("remesh", "case.toml", "--tree", "a.tree.h5", "--solution", "a.mesh", "-o", "r", "--set", "output.partitions=3",
                                          "--json", "-q", ranks=ranks)[0])
            self.assertEqual((record["parts"], len(record["files"])), (3, 2 + 1 + 2 * 3))
            self.done("convert", "r.parts", "back.mesh", "-q")
            self.assertEqual(self.text("back.mesh"), self.text("r.mesh"))
            self.assertIn("my_field", self.text("r.part_0002.mesh"))

    def test_refusals(self):
        self.write("b.mesh", convert_test.TWO_BLOCKS)
        self.refused(1, ["4 partitions", "3 cells"], "convert", "b.mesh", "out.mesh", "--parts", "4", "-q")
        self.refused(1, ["out.cgns", "one block"], "convert", "b.mesh", "out.cgns", "--parts", "2", "-q")
        self.refused(1, ["out.su2"], "convert", "b.mesh", "out.su2", "--parts", "2", "-q")
        self.refused(1, ["none.parts"], "convert", "none.parts", "out.mesh", "-q")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["b.mesh"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
