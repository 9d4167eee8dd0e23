#!/usr/bin/env python3
"""`quadloop convert`: the same mesh in another format, to the bit, its solution with it; what a format cannot hold is said.

    convert_test.py QUADLOOP MPIRUN
"""
import itertools
import json
import sys
import unittest
from unittest.mock import ANY

from program import ProgramTest

GEOMETRY = "2\nbox\n4\n-4 -4\n6 -4\n6 4\n-4 4\nmy-wall\n3\n0 0\n1 0.2\n1 -0.2\n"
CASE = '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.25\nmax = 2\n[output]\nformats = ["mesh"]\n'
TWO_BLOCKS = """#Number of grid points
6
0 0
1 0
2 0
2 1
1 1
0 1
#Number of blocks
2
#Number of triangular elements
2
1 2 5
1 5 6
#Number of quadrilateral elements
0
#Number of triangular elements
0
#Number of quadrilateral elements
1
2 3 4 5
#Number of boundaries
1
#Number of edges for boundary 1 (wall)
6
1 2
2 3
3 4
4 5
5 6
6 1
"""


def with_solution(mesh):
    """Values that no short decimal holds."""
    nodes = int(mesh.split("\n")[1])
    rows = "".join(f"{(i + 1) / 7 + 1e-9!r} {(i + 1) / 3e300!r} {-(i + 0.5) / 9!r}\n" for i in range(nodes))
    return mesh + "#Number of constants\n0\n#Number of variables\n3\n#names: density pressure my_field\n" + rows


class Convert(ProgramTest):
    def mesh(self, kind):
        self.write("a.geom", GEOMETRY)
        self.write("case.toml", CASE)
        self.done("mesh", "case.toml", "-o", "a", "--type", kind, "-q")
        return (self.folder / "a.mesh").read_text()

    def converted(self, source, target, *options):
        """The warnings."""
        return self.done("convert", source, target, "-q", *options)[1]

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def chains(self, kind):
        """Through all formats that hold a solution, then through the others. Every pair is in tests/io/mesh_file_test.cpp."""
        text = self.mesh(kind)
        self.write("solved.mesh", with_solution(text))
        for first, second in itertools.pairwise(("solved.mesh", "a.qmesh", "b.qmesh", "a.cgns", "a.vtu", "back.mesh")):
            self.assertEqual(self.converted(first, second), "")
        self.assertEqual(self.bytes_of("back.mesh"), self.bytes_of("solved.mesh"))
        self.assertIn("cannot store the solution", self.converted("solved.mesh", "a.su2"))
        for first, second in itertools.pairwise(("a.su2", "a.msh", "back.mesh")):
            self.assertEqual(self.converted(first, second), "")
        self.assertEqual(self.bytes_of("back.mesh"), text.encode())

    def test_formats_of_other_programs(self):
        """Names and conditions too; a cell of Fluent's begins with another of its nodes."""
        text = self.mesh("hybrid")
        self.converted("a.mesh", "a.cgns")
        for first, second in itertools.pairwise(("a.cgns", "a.ugrid", "constant.polyMesh", "b.cgns", "back.mesh")):
            # nothing says what the boundaries are, and neither program takes that as it is
            self.assertEqual("which boundaries are walls" in self.converted(first, second), second in ("a.ugrid", "constant.polyMesh"))
        self.assertEqual(self.bytes_of("back.mesh"), text.encode())
        self.converted("a.mesh", "a.fluent.msh")
        self.assertIn("boundary conditions", self.converted("a.fluent.msh", "b.mesh"))  # walls are, where nothing is said
        self.converted("a.mesh", "c.fluent.msh")
        self.assertEqual(self.bytes_of("a.fluent.msh"), self.bytes_of("c.fluent.msh"))
        cells = [sorted(line.split()) for line in (self.folder / "b.mesh").read_text().split("\n") if line[:1] != "#"]
        self.assertEqual(cells, [sorted(line.split()) for line in text.split("\n") if line[:1] != "#"])

    def test_three_dimensions(self):
        self.write("a.mesh", with_solution(self.mesh("hybrid")))
        self.done("extrude", "a.mesh", "-o", "a.cgns", "--layers", "2", "--thickness", "0.5", "-q")
        self.done("extrude", "a.mesh", "-o", "a.vtu", "--layers", "2", "--thickness", "0.5", "-q")
        for first, second in itertools.pairwise(("a.cgns", "b.vtu", "b.cgns", "c.vtu")):
            self.converted(first, second)
        self.assertEqual(self.bytes_of("c.vtu"), self.bytes_of("a.vtu"))  # the solution with it
        for name in ("su2", "msh", "b8.ugrid", "lb8.ugrid"):
            self.done("extrude", "a.mesh", "-o", f"a.{name}", "--layers", "2", "--thickness", "0.5", "-q")
            self.assertIn("cannot store the solution", self.converted("c.vtu", f"c.{name}"))
            self.assertEqual(self.bytes_of(f"c.{name}"), self.bytes_of(f"a.{name}"))
        self.converted("c.msh", "polyMesh")
        self.done("check", "polyMesh", "-q")
        table, _ = self.done("convert", "polyMesh", "d.su2")
        self.assertRegex(table, r"(?s)prisms +\d+\n.*hexahedra +\d+\n.*wrote d.su2")
        self.refused(1, ["polyMesh: contains a 3D mesh", "format mesh"], "convert", "polyMesh", "d.mesh")
        self.refused(1, ["a.mesh: contains a 2D mesh", "quadloop extrude"], "convert", "a.mesh", "d.b8.ugrid")

    def test_a_case_of_one_cell_is_a_plane_mesh(self):
        text = self.mesh("hybrid")
        for axis in ("y", "z"):
            self.done("extrude", "a.mesh", "-o", "polyMesh", "--layers", "1", "--thickness", "0.5", "--axis", axis, "-q")
            self.converted("polyMesh", "back.mesh")
            self.assertEqual(self.bytes_of("back.mesh"), text.encode())
        self.done("check", "polyMesh", "-q")
        self.done("extrude", "polyMesh", "-o", "b.su2", "--layers", "3", "--thickness", "1", "-q")
        self.converted("polyMesh", "b.lb8.ugrid")  # which has three dimensions alone
        self.assertIn("prisms", self.done("check", "b.lb8.ugrid")[0])
        boundary = self.folder / "polyMesh/boundary"
        boundary.write_text(boundary.read_text().replace("empty", "patch", 1))
        self.refused(1, ["polyMesh: cell 0 does not have two faces"], "convert", "polyMesh", "b.mesh")

    def test_hybrid_meshes(self):
        self.chains("hybrid")

    def test_delaunay_meshes(self):
        self.chains("delaunay")

    def check_record(self, name):
        return json.loads(self.done("check", name, "--json")[0])

    def test_blocks(self):
        self.write("a.mesh", TWO_BLOCKS)
        for name in ("vtu", "msh"):
            self.assertEqual(self.converted("a.mesh", f"b.{name}"), "")
            self.converted(f"b.{name}", "back.mesh")
            self.assertEqual(self.bytes_of("back.mesh"), TWO_BLOCKS.encode())
        for name in ("cgns", "su2", "ugrid"):
            self.assertNotIn("blocks", self.converted("a.mesh", f"b.{name}"))
            self.assertEqual(self.check_record(f"b.{name}")["block_figures"].keys(), {"block_1", "block_2"})

    def test_one_block(self):
        self.write("a.mesh", TWO_BLOCKS.replace("#Number of blocks\n2\n", "#Number of blocks\n2\n# block solid\n"))
        self.done("convert", "a.mesh", "solid.mesh", "--block", "solid")
        self.assertIn("# block solid\n", (self.folder / "solid.mesh").read_text())
        figures = self.check_record("a.mesh")["block_figures"]
        found = self.check_record("solid.mesh")
        self.assertEqual((found["blocks"], found["triangles"] + found["quads"], found["area"]), (1, figures["solid"]["cells"], figures["solid"]["area"]))
        self.refused(1, ["a.mesh: has no block 'gas'; its blocks are 'solid' and 'block_2'"], "convert", "a.mesh", "b.su2", "--block", "gas")

    def test_constants_are_lost_with_a_warning(self):
        self.write("a.mesh", TWO_BLOCKS + "#Number of constants\n1\n7\n#Number of variables\n0\n")
        self.assertIn("constants of the solution", self.converted("a.mesh", "b.vtu"))

    def test_conditions_are_lost_with_a_warning(self):
        self.write("a.geom", GEOMETRY)
        self.write("case.toml", CASE.replace('"mesh"]', '"cgns"]') + '[boundary."*"]\nbc = "wall"\n')
        self.done("mesh", "case.toml", "-o", "a", "-q")
        self.assertIn("boundary conditions", self.converted("a.cgns", "b.mesh"))
        self.assertEqual(self.converted("a.cgns", "b.cgns"), "")

    def test_a_mesh_that_is_not_valid_stays_as_it_is(self):
        inverted = TWO_BLOCKS.replace("2 3 4 5\n", "5 4 3 2\n").replace("1 5 6\n", "6 5 1\n")
        self.write("a.mesh", inverted)
        self.assertIn("is not valid, and is written unchanged", self.converted("a.mesh", "b.mesh"))
        self.assertEqual(self.bytes_of("b.mesh").decode(), inverted)

    def test_a_format_by_name(self):
        self.write("a.mesh", TWO_BLOCKS)
        self.converted("a.mesh", "b.su2")
        for name in ("b", "b.x", "c.mesh"):
            self.converted("a.mesh", name, "--format", "su2")
            self.assertEqual(self.bytes_of(name), self.bytes_of("b.su2"))

    def test_medit(self):
        """By its content from .mesh, by its name into it; boundaries are numbers there."""
        self.write("m.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 3\n0 0 0\n1 0 0\n0 1 0\nTriangles 1\n1 2 3 4\n"
                   "Edges 3\n1 2 7\n2 3 7\n3 1 9\nEnd\n")
        self.assertEqual(self.done("convert", "m.mesh", "a.su2"), (ANY, ""))
        said = self.done("convert", "m.mesh", "b.mesh", "--format", "medit")[1]
        self.assertEqual(said, "")
        self.assertEqual(self.done("check", "b.mesh", "--json")[0].count("boundary_7"), 1)

    def test_damaged_names_reach_no_terminal(self):
        """An escape sequence in a name or a token is shown, not done."""
        self.write("a.su2", "NDIME= 2\nNELEM= 1\n5 0 1 \x1b[31m\nNPOIN= 3\n0 0\n1 0\n0 1\n")
        result = self.run_program("check", "a.su2")
        self.assertEqual(result.returncode, 1)
        self.assertIn("\\x1b[31m", result.stderr)
        self.assertNotIn("\x1b", result.stderr)
        self.write("b.su2", "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 1\nMARKER_TAG= a\x1b[2J\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 0\n")
        table, said = self.done("check", "b.su2")
        self.assertNotIn("\x1b", table + said)
        self.assertIn("a_[2J", table)

    def test_the_same_bytes_on_ranks(self):
        self.write("first.mesh", with_solution(self.mesh("hybrid")))
        for name in ("mesh", "vtu", "su2", "msh", "fluent.msh", "ugrid"):
            self.converted("first.mesh", f"a.{name}")
            self.done("convert", "first.mesh", f"b.{name}", "-q", ranks=3)
            self.assertEqual(self.bytes_of(f"a.{name}"), self.bytes_of(f"b.{name}"))

    def test_table_and_record(self):
        self.write("a.mesh", TWO_BLOCKS)
        table, _ = self.done("convert", "a.mesh", "b.vtu")
        self.assertRegex(table, r"(?s)nodes +6\n.*triangles +2\n.*quads +1\n.*wrote b.vtu")
        record = json.loads(self.done("convert", "a.mesh", "b.vtu", "--json")[0])
        self.assertEqual((record["nodes"], record["blocks"], record["files"]), (6, 2, ["b.vtu"]))

    def test_refusals(self):
        self.write("a.mesh", TWO_BLOCKS)
        self.write("short.mesh", TWO_BLOCKS[:-4])
        self.refused(1, ["short.mesh:"], "convert", "short.mesh", "b.vtu")
        self.refused(1, ["none.mesh"], "convert", "none.mesh", "b.vtu")
        self.refused(1, ["b.xyz", ".su2", "--format"], "convert", "a.mesh", "b.xyz")
        self.refused(1, ["a.xyz"], "convert", "a.xyz", "b.mesh")
        self.refused(2, ["'vtk'", "do you mean 'vtu'?"], "convert", "a.mesh", "b", "--format", "vtk")
        self.refused(2, ["output is required"], "convert", "a.mesh")
        self.refused(4, ["none/b.vtu"], "convert", "a.mesh", "none/b.vtu")
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["a.mesh", "short.mesh"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
