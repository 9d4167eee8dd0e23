#!/usr/bin/env python3
"""`quadloop extrude`: 3D meshes in every format that holds them, checked as they are read back; refusals.

    extrude_test.py QUADLOOP MPIRUN
"""
import json
import unittest

from convert_test import TWO_BLOCKS
from program import ProgramTest

GEOMETRY = "2\nfront\n4\n-4 -4\n6 -4\n6 4\n-4 4\nmy-wall\n3\n0 0\n1 0.2\n1 -0.2\n"
CASE = '[geometry]\nfile = "a.geom"\n[spacing]\nmin = 0.25\nmax = 2\n[boundary.my-wall]\nbc = "wall"\n[output]\nformats = ["mesh", "cgns"]\n'
OUTPUTS = ["a.cgns3.cgns", "a.vtu", "a.su2", "a.fluent.msh", "a.b8.ugrid", "a.lb8.ugrid", "polyMesh"]
EVEN = ("--layers", "3", "--thickness", "0.75")


def with_velocity(mesh):
    nodes = int(mesh.split("\n")[1])
    rows = "".join(f"{i / 7!r} {i / 3!r} {-i / 9!r}\n" for i in range(nodes))
    return mesh + "#Number of constants\n0\n#Number of variables\n3\n#names: density x_velocity y_velocity\n" + rows


class Extrude(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", GEOMETRY)
        self.write("case.toml", CASE)
        self.done("mesh", "case.toml", "-o", "a", "-q")

    def record(self, *arguments):
        return json.loads(self.done(*arguments, "--json")[0])

    def files(self, name):
        """The bytes of an output, with those of what stands beside it or in it."""
        path = self.folder / name
        if path.is_dir():
            return {file.name: file.read_bytes() for file in sorted(path.iterdir())}
        return {file.name: file.read_bytes() for file in sorted(self.folder.glob(name.split(".")[0] + "*")) if file.suffix in (path.suffix, ".mapbc")}

    def test_each_format_is_read_back(self):
        plane = self.record("check", "a.mesh")
        for axis in "yz":
            for name in OUTPUTS:
                with self.subTest(name=name, axis=axis):
                    made = self.record("extrude", "a.mesh", "-o", name, *EVEN, "--axis", axis)
                    found = self.record("check", name)
                    self.assertTrue(found["valid"])
                    for count in ("nodes", "prisms", "hexahedra"):
                        self.assertEqual(found[count], made[count])
                    self.assertEqual(found["nodes"], 4 * plane["nodes"])
                    self.assertEqual((found["prisms"], found["hexahedra"]), (3 * plane["triangles"], 3 * plane["quads"]))
                    self.assertAlmostEqual(found["volume"], 0.75 * plane["area"], delta=1e-11 * plane["area"])
                    patches = found["patch_figures"]
                    self.assertEqual(list(patches), ["front", "my-wall", "back", "front_2"])
                    self.assertAlmostEqual(patches["front_2"]["area"], plane["area"], delta=1e-10)
                    self.assertEqual(patches["my-wall"]["faces"], 3 * plane["boundaries"]["my-wall"])

    def test_ranks_give_the_same_bytes(self):
        for name in OUTPUTS[1:]:
            with self.subTest(name=name):
                self.done("extrude", "a.mesh", "-o", name, *EVEN, "-q")
                alone = self.files(name)
                for ranks in (2, 3, 5):
                    self.done("extrude", "a.mesh", "-o", name, *EVEN, "-q", ranks=ranks)
                    self.assertEqual(self.files(name), alone)

    def test_an_end_whose_name_is_taken_gets_another_and_says_so(self):
        _, said = self.done("extrude", "a.mesh", "-o", "a.su2", *EVEN)
        self.assertIn("a boundary is named 'front'; that end of the 3D mesh is 'front_2'", said)

    def test_heights_from_a_file(self):
        self.write("h.txt", "# levels\n-1 0\n0.5 4\n")
        self.record("extrude", "a.mesh", "-o", "a.vtu", "--heights", "h.txt")
        plane = self.record("check", "a.mesh")
        self.assertAlmostEqual(self.record("check", "a.vtu")["volume"], 5 * plane["area"], delta=1e-9)
        self.write("h.txt", "0\n1\n1\n")
        self.refused(1, ["h.txt:3:", "does not lie above"], "extrude", "a.mesh", "-o", "b.vtu", "--heights", "h.txt")
        self.write("h.txt", "0\n")
        self.refused(1, ["1 heights"], "extrude", "a.mesh", "-o", "b.vtu", "--heights", "h.txt")
        self.assertFalse((self.folder / "b.vtu").exists())

    def test_heights_out_of_range_are_refused(self):
        self.write("far.txt", "0 1e308\n")
        self.refused(1, ["far.txt: the level at 1e+308 is out of range", "1e+100"], "extrude", "a.mesh", "-o", "b.su2", "--heights", "far.txt")
        self.refused(1, ["--thickness: the layer from 0 to ", "is out of range", "1e-100"],
                     "extrude", "a.mesh", "-o", "b.su2", "--layers", "1", "--thickness", "1e-320")

    def test_more_cells_than_allowed_are_refused(self):
        self.refused(1, ["b.su2: would have ", " cells in 40 layers and need at least ", " on the disk, but --max-cells allows 500; use fewer layers, or allow more "],
                     "extrude", "a.mesh", "-o", "b.su2", "--layers", "40", "--thickness", "1", "--max-cells", "500")
        self.assertFalse((self.folder / "b.su2").exists())
        self.done("extrude", "a.mesh", "-o", "b.su2", *EVEN, "--max-cells", "100000")

    def test_the_solution_goes_along(self):
        (self.folder / "s.mesh").write_text(with_velocity((self.folder / "a.mesh").read_text()))
        self.done("extrude", "s.mesh", "-o", "s.vtu", *EVEN, "--axis", "y", "-q")
        head = (self.folder / "s.vtu").read_bytes().split(b"<AppendedData")[0].decode()
        names = [part.split('"')[0] for part in head.split("<PointData>")[1].split("</PointData>")[0].split('Name="')[1:]]
        self.assertEqual(names, ["density", "x_velocity", "z_velocity", "y_velocity"])
        _, said = self.done("extrude", "s.mesh", "-o", "s.su2", *EVEN)
        self.assertIn("cannot store the solution", said)

    def test_blocks_are_zones_of_cgns(self):
        self.write("two.mesh", TWO_BLOCKS)
        for ranks in (1, 2, 3, 5):
            self.done("extrude", "two.mesh", "-o", "two.cgns", *EVEN, ranks=ranks)
            found = self.record("check", "two.cgns")
            self.assertEqual((found["blocks"], found["prisms"], found["valid"]), (2, 6, True))

    def test_blocks_stay(self):
        self.write("two.mesh", TWO_BLOCKS)
        for name in ("two.su2", "two.b8.ugrid", "two.lb8.ugrid", "two.vtu", "two.pvtu", "two.fluent.msh", "two.msh", "two.msh41", "polyMesh"):
            with self.subTest(name=name):
                _, said = self.done("extrude", "two.mesh", "-o", name, *EVEN)
                self.assertNotIn("blocks", said)
                self.assertEqual("does not specify which boundaries are walls" in said, name in ("two.fluent.msh", "polyMesh"))
                alone = self.files(name)
                for ranks in (2, 3, 5):
                    self.done("extrude", "two.mesh", "-o", name, *EVEN, "-q", ranks=ranks)
                    self.assertEqual(self.files(name), alone)
                found = self.record("check", name)
                self.assertEqual(found["blocks"], 2)
                self.assertEqual({key: (value["cells"], value["volume"]) for key, value in found["block_figures"].items()},
                                 {"block_1": (6, 0.75), "block_2": (3, 0.75)})
                self.done("convert", name, "again.msh", "-q")
                self.assertEqual(self.record("check", "again.msh")["blocks"], 2)

    def test_usage(self):
        for thickness in ("inf", "1e400", "nan"):
            self.refused(2, ["--thickness", "not a number above 0"], "extrude", "a.mesh", "-o", "b.vtu", "--layers", "2", "--thickness", thickness)
        self.refused(2, ["too small"], "extrude", "a.mesh", "-o", "b.vtu", "--layers", "100", "--thickness", "1e-323")
        for arguments in ((), ("--layers", "2"), ("--thickness", "1"), (*EVEN, "--heights", "h.txt")):
            self.refused(2, ["--layers N"], "extrude", "a.mesh", "-o", "b.vtu", *arguments)
        self.refused(2, ["x"], "extrude", "a.mesh", "-o", "b.vtu", *EVEN, "--axis", "x")
        self.refused(1, [".b8.ugrid", "polyMesh"], "extrude", "a.mesh", "-o", "b.mesh", *EVEN)
        self.refused(1, ["contains a 3D mesh"], "convert", "b.b8.ugrid", "b.mesh")

    def test_plane_meshes_that_are_not_valid_are_refused(self):
        self.write("bad.mesh", TWO_BLOCKS.replace("1 2 5\n", "2 1 5\n"))
        self.refused(1, ["bad.mesh: invalid mesh"], "extrude", "bad.mesh", "-o", "b.vtu", *EVEN)

    def test_3d_meshes_are_not_drawn_out_again(self):
        self.done("extrude", "a.mesh", "-o", "b.su2", *EVEN, "-q")
        self.refused(1, ["is a 3D mesh already"], "extrude", "b.su2", "-o", "c.su2", *EVEN)

    def test_check_names_cell_and_place(self):
        self.done("extrude", "a.mesh", "-o", "b.su2", *EVEN, "-q")
        lines = (self.folder / "b.su2").read_text().split("\n")
        first = next(i for i, line in enumerate(lines) if line.startswith("13 "))
        nodes = lines[first].split()[1:]
        inside_out = [*lines[:first], " ".join(["13", *nodes[3:], *nodes[:3]]), *lines[first + 1:]]
        self.write("b.su2", "\n".join(inside_out))
        self.assertIn("b.su2: 1 cell was inside out and reversed", self.done("check", "b.su2")[1])
        origin = next(i for i, line in enumerate(lines) if line.startswith("NPOIN=")) + 1
        for a, b in zip(nodes[::3], nodes[1::3]):  # the prism's first edge is turned round its other end
            old, end = ([float(x) for x in lines[origin + int(n)].split()] for n in (a, b))
            lines[origin + int(a)] = " ".join(repr(2 * y - x) for x, y in zip(old, end))
        self.write("b.su2", "\n".join(lines))
        self.refused(1, ["b.su2: invalid mesh: positive: prism 1 has no positive volume at ("], "check", "b.su2", "-q")
        self.done("extrude", "a.mesh", "-o", "b.su2", *EVEN, "-q")
        text = (self.folder / "b.su2").read_text()
        head, _, marker = text.partition("MARKER_TAG= back\nMARKER_ELEMS= ")
        count, _, rest = marker.partition("\n")
        face, _, rest = rest.partition("\n")
        self.write("b.su2", f"{head}MARKER_TAG= back\nMARKER_ELEMS= {int(count) - 1}\n{rest}")
        self.refused(1, ["conforming", "has no other cell and is on no patch"], "check", "b.su2", "-q")

    def test_a_folder_is_whole_or_not_there(self):
        self.refused(4, ["does not exist"], "extrude", "a.mesh", "-o", "case/constant/polyMesh", *EVEN)
        self.done("extrude", "a.mesh", "-o", "polyMesh", *EVEN, "-q")
        self.assertEqual(set(self.files("polyMesh")), {"points", "faces", "owner", "neighbour", "boundary"})
        (self.folder / "polyMesh/cellZones").touch()
        self.refused(4, ["holds 'cellZones'"], "extrude", "a.mesh", "-o", "polyMesh", *EVEN)

    def test_faces_of_a_folder_are_in_upper_triangular_order(self):
        def numbers(name):
            return [int(word) for word in (self.folder / "polyMesh" / name).read_text().split("\n(\n")[1].split(")")[0].split()]
        self.done("extrude", "a.mesh", "-o", "polyMesh", *EVEN, "-q", ranks=2)
        owner, neighbour = numbers("owner"), numbers("neighbour")
        inside = list(zip(owner, neighbour))
        self.assertEqual(inside, sorted(set(inside)))
        self.assertTrue(all(low < high for low, high in inside))

    def test_one_layer_is_empty_in_front_and_behind(self):
        self.done("extrude", "a.cgns", "-o", "polyMesh", "--layers", "1", "--thickness", "1", "-q")
        boundary = (self.folder / "polyMesh/boundary").read_text()
        self.assertEqual(boundary.count("empty;"), 2)
        self.assertEqual(boundary.count("wall;"), 1)
        self.done("extrude", "a.mesh", "-o", "polyMesh", *EVEN, "-q")
        self.assertEqual((self.folder / "polyMesh/boundary").read_text().count("symmetryPlane;"), 2)

    def test_names_of_patches_stand_beside_ugrid(self):
        self.done("extrude", "a.cgns", "-o", "a.b8.ugrid", *EVEN, "--axis", "y", "-q")
        self.assertEqual((self.folder / "a.mapbc").read_text(), "4\n1 0 front\n2 4000 my-wall\n3 6662 back\n4 6662 front_2\n")


if __name__ == "__main__":
    unittest.main(argv=["extrude_test.py"])
