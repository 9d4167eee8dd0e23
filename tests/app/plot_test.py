#!/usr/bin/env python3
"""`quadloop plot`: what kinds of picture come out, how large, in which colours, and what is refused.

    plot_test.py QUADLOOP MPIRUN
"""
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path

QUADLOOP, MPIRUN = (str(Path(program).resolve()) for program in sys.argv[1:3])

# Two squares and two triangles over [0,3] x [0,1], two blocks, a solution of which one variable is the same everywhere.
MESH = """8
0 0 1 0 2 0 3 0 3 1 2 1 1 1 0 1
2
0
2
1 2 7 8
2 3 6 7
2
3 4 5
3 5 6
0
2
#Number of edges for boundary 1 (wall)
3
1 2 2 3 3 4
#Number of edges for boundary 2 (far)
5
4 5 5 6 6 7 7 8 8 1
0
2
#names: density pressure
1 5 2 5 3 5 4 5 4 5 3 5 2 5 1 5
"""
PALE_BLUE, PALE_ORANGE = (213, 231, 249), (255, 218, 181)


def png_pixels(data):
    """Width, height, and the colours of a PNG of 8-bit RGB."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert (depth, kind) == (8, 2)
    at, packed = 8, b""
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += length + 12
    raw, rows, stride = zlib.decompress(packed), [], 3 * width
    above = bytearray(stride)
    for y in range(height):
        mode, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride if mode else 0):
            left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            paeth = min((left, up, corner), key=lambda value: abs(left + up - corner - value))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[mode]) & 255
        rows.append(row)
        above = row
    return width, height, {tuple(row[i:i + 3]) for row in rows for i in range(0, stride, 3)}


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "a.mesh").write_text(MESH)

    def run_plot(self, *options, launcher=()):
        return subprocess.run([*launcher, QUADLOOP, "plot", *options], cwd=self.folder, capture_output=True, text=True)

    def picture(self, output, *options):
        done = self.run_plot("a.mesh", "-o", output, *options)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        return (self.folder / output).read_bytes()

    def small(self, *options):
        return png_pixels(self.picture("a.png", "--size", "400", *options))

    def refused(self, status, said, *options):
        done = self.run_plot(*options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(said, done.stderr)
        self.assertEqual([file.name for file in self.folder.iterdir()], ["a.mesh"])

    def test_png_has_1600_pixels_along_its_longer_side(self):
        data = self.picture("a.png")
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(max(struct.unpack(">II", data[16:24])), 1600)
        data = self.picture("a.png", "--window", "0,0.4,0,1")
        self.assertEqual(struct.unpack(">II", data[16:24])[1], 1600)

    def test_svg_is_xml_and_names_its_size(self):
        root = xml.etree.ElementTree.fromstring(self.picture("a.svg"))
        self.assertTrue(root.tag.endswith("svg"))
        self.assertIn("1600", root.attrib["width"])

    def test_pdf(self):
        self.assertEqual(self.picture("a.pdf")[:5], b"%PDF-")

    def test_types_have_their_colours_and_the_window_leaves_cells_out(self):
        self.assertLessEqual({PALE_BLUE, PALE_ORANGE}, self.small()[2])
        self.assertNotIn(PALE_ORANGE, self.small("--window=0.1,0.9,0.1,0.9")[2])

    def test_a_window_deep_inside_a_cell(self):
        self.assertIn(PALE_BLUE, self.small("--window=0.5,0.500001,0.5,0.500001")[2])

    def test_other_colours(self):
        for options in (["--colour-by", "block"], ["--color-by", "block"], ["--colour-by", "quality"], ["--field", "density"], ["--field", "pressure"]):
            self.assertNotIn(PALE_ORANGE, self.small(*options)[2], options)

    def test_fields_are_smooth_in_the_range_and_the_map_asked_for(self):
        smooth, flat = (self.small("--field", "density", "--shading", shading)[2] for shading in ("smooth", "flat"))
        self.assertGreater(len(smooth), len(flat) + 100)
        self.assertIn((0x44, 0x01, 0x54), self.small("--field", "density", "--range", "10,20")[2])
        self.assertIn((20, 20, 20), self.small("--field", "density", "--map", "grey", "--range=3,4")[2])
        self.assertNotEqual(self.picture("a.png", "--field", "density"), self.picture("a.png", "--field", "density", "--lines", "on"))
        self.assertNotEqual(self.picture("a.png"), self.picture("a.png", "--lines", "off"))
        self.assertNotEqual(self.picture("a.png", "--field", "density"), self.picture("a.png", "--field", "density", "--contours", "3"))

    def test_lines_of_the_mesh_have_one_ink_whatever_the_colours_below(self):
        """Where it changed, as on a dark colour, the eye saw a contour: no pixel of a dark field with lines is lighter than without."""
        without, lined = (max(map(sum, self.small("--field", "density", "--range", "8,20", "--window=0.2,1.8,0.2,0.8", "--lines", on)[2] - {(255, 255, 255)}))
                          for on in ("off", "on"))
        self.assertEqual(without, lined)

    def test_sizes_in_cm(self):
        data = self.picture("a.png", "--size", "16x10")
        self.assertEqual(struct.unpack(">II", data[16:24]), (1890, 1181))
        self.assertEqual(float(xml.etree.ElementTree.fromstring(self.picture("a.svg", "--size", "16x10")).attrib["width"].removesuffix("pt")), 453.543307)

    def test_tables_beside_a_flow(self):
        (self.folder / "a.walls.csv").write_text("boundary,s,x,y,Cp,Mach\nwall,0,1,0,1,0.5\nwall,1,0,0,-1,0.7\n")
        (self.folder / "a.history.csv").write_text("step,residual,cl,cd\n0,1,0,0\n1,0.1,0.3,0.02\n")
        cp = self.picture("a.png", "--walls")
        self.assertNotEqual(cp, self.picture("b.png", "--walls", "--field", "Mach"))
        for name in ("a.walls.csv", "a.history.csv"):
            done = self.run_plot(name, "-o", "c.png")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual((self.folder / "c.png").read_bytes() == cp, name == "a.walls.csv")
        (self.folder / "run" / "cycle_00").mkdir(parents=True)
        (self.folder / "a.history.csv").rename(self.folder / "run" / "cycle_00" / "mesh.history.csv")
        done = self.run_plot("run", "-o", "d.png", "--history")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.folder / "d.png").read_bytes(), (self.folder / "c.png").read_bytes())
        done = self.run_plot("a.mesh", "-o", "d.png", "--walls", "--field", "Cf")
        self.assertEqual(done.returncode, 1)
        self.assertIn("there are: boundary, s, x, y, Cp, Mach", done.stderr)

    def test_runs_without_a_history_are_drawn_over_their_cycles(self):
        run = self.folder / "other"
        for cycle in (0, 1, 2, 10):
            (run / f"cycle_{cycle:02d}").mkdir(parents=True)
            (run / f"cycle_{cycle:02d}" / "record.json").write_text(f'{{\n  "cycle": {cycle},\n  "nodes": 5\n}}\n')
        for option, said in (("--history", "no cycle tells a residual or forces; forces and wall values are written if [flow]"),
                             ("--walls", "cycle_10/mesh.walls.csv: does not exist; forces")):
            done = self.run_plot("other", "-o", "a.png", option)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
        for cycle in (0, 1, 2, 10):
            record = run / f"cycle_{cycle:02d}" / "record.json"
            record.write_text(record.read_text().replace('"nodes": 5', f'"cl": {0.1 * cycle},\n  "cd": 1e-2,\n  "forces": {{"w": {{"cl": 9}}}}'))
        self.assertEqual(self.run_plot("other", "-o", "e.svg", "--history").returncode, 0)
        (run / "cycle_10" / "mesh.walls.csv").write_text("boundary,s,x,y,Cp,Mach\nwall,0,1,0,1,0.5\nwall,1,0,0,-1,0.7\n")
        done = self.run_plot("other", "-o", "f.png", "--walls")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = self.run_plot("other/cycle_10/mesh.walls.csv", "-o", "g.png")
        self.assertEqual((self.folder / "f.png").read_bytes(), (self.folder / "g.png").read_bytes())

    def test_streamlines_follow_velocities_in_cells(self):
        of_cells = "#Number of cell variables\n3\n#names: U_x U_y p\n"
        (self.folder / "c.mesh").write_text(MESH.split("#names")[0].rsplit("0\n2\n", 1)[0] + "0\n0\n" + of_cells + "1 0.1 5\n" * 4)
        with_lines = self.picture_of("c.mesh", "h.png", "--field", "U_x", "--streamlines", "12")
        self.assertNotEqual(with_lines, self.picture_of("c.mesh", "i.png", "--field", "U_x"))

    def picture_of(self, mesh, name, *options):
        done = self.run_plot(mesh, "-o", name, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return (self.folder / name).read_bytes()

    def test_quantities_of_a_flow_need_not_stand_in_the_file(self):
        text = MESH.split("0\n2\n#names")[0] + "7\n9\n0\n0.5\n0\n0\n0\n0\n4\n#names: density x_velocity y_velocity pressure\n"
        (self.folder / "b.mesh").write_text(text + "".join(f"1 {0.1 * node} 0 0.7\n" for node in range(8)))
        for field in ("mach", "pressure_coefficient"):
            done = self.run_plot("b.mesh", "-o", "b.png", "--field", field, "--streamlines", "10")
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_same_bytes_twice_and_on_ranks(self):
        for name in ("a.png", "a.svg", "a.pdf"):
            first = self.picture(name)
            done = self.run_plot("a.mesh", "-o", name, launcher=[MPIRUN, "-n", "2"])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.folder / name).read_bytes(), first, name)

    def test_refusals(self):
        self.refused(1, ".png, .svg or .pdf", "a.mesh", "-o", "a.jpg")
        self.refused(1, "give a .mesh, .qmesh, .cgns, .vtu, .pvtu, .su2", "a.vtk", "-o", "a.png")
        self.refused(1, "do you mean 'a.mesh'", "a", "-o", "a.png")
        self.refused(1, "none.mesh", "none.mesh", "-o", "a.png")
        self.refused(1, "window is empty", "a.mesh", "-o", "a.png", "--window=1,1,0,1")
        self.refused(1, "no cell lies in the window", "a.mesh", "-o", "a.png", "--window=5,6,0,1")
        self.refused(1, "density, pressure", "a.mesh", "-o", "a.png", "--field", "mach")
        self.refused(1, "do you mean 'pressure'?", "a.mesh", "-o", "a.png", "--field", "presure")
        self.refused(1, "quadloop solve", "a.mesh", "-o", "a.png", "--walls")
        self.refused(1, "a.history.csv", "a.mesh", "-o", "a.png", "--history")
        self.refused(1, "no cycle", ".", "-o", "a.png", "--history")
        self.refused(1, "streamlines need a velocity", "a.mesh", "-o", "a.png", "--streamlines", "5")
        for range_asked in ("3,1", "1", "a,b", "1,nan"):
            self.refused(2, "two numbers A,B", "a.mesh", "-o", "a.png", "--field", "density", "--range", range_asked)
        for size in ("300", "16x", "16x1", "x10", "1e9", "500.5"):
            self.refused(2, "cm", "a.mesh", "-o", "a.png", "--size", size)
        self.refused(2, "name it with --field", "a.mesh", "-o", "a.png", "--contours", "4")
        self.refused(2, "--map", "a.mesh", "-o", "a.png", "--field", "density", "--map", "jet")
        self.refused(2, "four numbers", "a.mesh", "-o", "a.png", "--window=1,2,3")
        self.refused(2, "contains no ranks", "a.mesh", "-o", "a.png", "--colour-by", "rank")
        self.refused(2, "--colour-by", "a.mesh", "-o", "a.png", "--colour-by", "taste")
        self.refused(2, "--field", "a.mesh", "-o", "a.png", "--colour-by", "type", "--field", "density")
        self.refused(4, "cannot be written", "a.mesh", "-o", "missing/a.png")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
