#!/usr/bin/env python3
"""`.vtkhdf`: the layout of VTK's documentation, the arrays of the `.vtu` file of the same mesh, the same bytes on any number of ranks.

    vtkhdf_test.py QUADLOOP MPIRUN
"""
import json
import re
import sys
import unittest

import h5py
import numpy as np

from convert_test import GEOMETRY, TWO_BLOCKS
from program import ProgramTest
from readers_test import with_values

TYPES = {"Float64": "<f8", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}
CASE = """[geometry]
file = "a.geom"
[spacing]
min = 0.25
max = 1
[boundary.my-wall]
bc = "wall"
layers = { first = 0.01, growth = 1.3, count = 4 }
[output]
formats = ["mesh", "vtu", "vtkhdf"]
"""


def arrays_of_vtu(path):
    """{section: {name: array}} of a file with raw appended arrays, read without the program and without VTK."""
    head, data = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    found = {}
    for section in ("Points", "Cells", "PointData", "CellData"):
        text = re.search(f"<{section}>(.*?)</{section}>", head.decode(), re.S)
        tags = re.findall(r'type="(\w+)" Name="([^"]*)"(?: NumberOfComponents="(\d+)")? format="appended" offset="(\d+)"', text[1] if text else "")
        found[section] = {}
        for kind, name, width, offset in tags:
            size = int.from_bytes(data[int(offset):int(offset) + 8], "little")
            values = np.frombuffer(data, TYPES[kind], size // np.dtype(TYPES[kind]).itemsize, int(offset) + 8)
            found[section][name] = values.reshape(-1, int(width)) if width else values
    return found


class VtkHdf(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", GEOMETRY)
        self.write("case.toml", CASE)

    def compare(self, stem, names):
        """The arrays of `stem`.vtkhdf with those of `stem`.vtu."""
        vtu = arrays_of_vtu(self.folder / f"{stem}.vtu")
        with h5py.File(self.folder / f"{stem}.vtkhdf") as file:
            self.assertEqual(list(file), ["VTKHDF"])
            root = file["VTKHDF"]
            self.assertEqual(root.attrs["Version"].tolist(), [1, 0])
            self.assertEqual(root.attrs["Type"], b"UnstructuredGrid")
            connectivity, points = vtu["Cells"]["connectivity"], vtu["Points"]["Points"]
            for name, count in (("Points", len(points)), ("Cells", len(vtu["Cells"]["types"])), ("ConnectivityIds", len(connectivity))):
                self.assertEqual(root[f"NumberOf{name}"][()].tolist(), [count])
            self.same(root["Points"], points)
            self.same(root["Connectivity"], connectivity)
            self.same(root["Offsets"], np.concatenate([np.zeros(1, np.int64), vtu["Cells"]["offsets"]]))
            self.same(root["Types"], vtu["Cells"]["types"])
            for section in ("PointData", "CellData"):
                self.assertEqual(set(root[section]), set(vtu[section]))
                for name, values in vtu[section].items():
                    self.same(root[section][name], values)
            self.assertEqual([name.decode() for name in root["FieldData/boundary_names"]], names)
            for array in (root["Points"], root["Connectivity"], root["Offsets"], root["Types"]):
                self.assertIsNone(array.chunks)  # contiguous: the ranks write into it
            return {name: root["FieldData"][name][()] for name in root["FieldData"]}, set(vtu["PointData"]) | set(vtu["CellData"])

    def same(self, dataset, values):
        self.assertEqual((dataset.dtype.str.strip("<|"), dataset.shape), (values.dtype.str.strip("<|"), values.shape))
        self.assertEqual(dataset[()].tobytes(), values.tobytes(), dataset.name)

    def test_a_plane_mesh_with_layers_and_values(self):
        self.done("mesh", "case.toml", "-o", "m", "-q")
        fields, data = self.compare("m", ["box", "my-wall"])
        self.assertEqual(fields["boundary_layers"].tolist(), [0, 4])
        self.assertGreater(fields["boundary_layers_thickness"][1], 0.03)
        self.assertLessEqual({"boundary"}, data)
        text, *_ = with_values((self.folder / "m.mesh").read_text())
        self.write("s.mesh", text)
        for suffix in ("vtu", "vtkhdf"):
            self.done("convert", "s.mesh", f"s.{suffix}", "-q")
        self.assertLessEqual({"density", "pressure", "layer_height"}, self.compare("s", ["box", "my-wall"])[1])

    def test_ranks_write_the_same_bytes(self):
        for mesh_type in ("hybrid", "delaunay"):
            written = []
            for ranks in (1, 2, 3):
                self.done("mesh", "case.toml", "-o", f"m{ranks}", "-q", "--type", mesh_type, ranks=ranks)
                self.done("extrude", f"m{ranks}.mesh", "-o", f"e{ranks}.vtkhdf", "--layers", "2", "--thickness", "0.5", "-q", ranks=ranks)
                written.append([(self.folder / f"{stem}{ranks}.vtkhdf").read_bytes() for stem in "me"])
            self.assertTrue(written[0] == written[1] == written[2], mesh_type)

    def test_three_dimensions(self):
        self.done("mesh", "case.toml", "-o", "m", "-q")
        self.write("m.mesh", with_values((self.folder / "m.mesh").read_text())[0])
        for suffix in ("vtu", "vtkhdf"):
            self.done("extrude", "m.mesh", "-o", f"e.{suffix}", "--layers", "2", "--thickness", "0.5", "-q")
        _, data = self.compare("e", ["box", "my-wall", "back", "front"])
        self.assertLessEqual({"density", "pressure"}, data)
        self.done("convert", "e.vtu", "e.vtkhdf", "-q")  # stored as a whole
        self.compare("e", ["box", "my-wall", "back", "front"])

    def test_blocks_have_their_names(self):
        self.write("a.mesh", TWO_BLOCKS.replace("#Number of triangular elements\n2", "# block water\n#Number of triangular elements\n2", 1))
        for suffix in ("vtu", "vtkhdf"):
            self.done("convert", "a.mesh", f"a.{suffix}", "-q")
        fields, data = self.compare("a", ["wall"])
        self.assertEqual(len(fields["block_names"]), 2)
        self.assertIn("block", data)

    def test_names_that_hdf5_has_taken_are_changed_and_reported(self):
        self.done("mesh", "case.toml", "-o", "m", "-q")
        text = with_values((self.folder / "m.mesh").read_text())[0]
        self.write("s.mesh", text.replace("#names: density", "#names: d/dx").replace("#names: pressure", "#names: boundary"))
        _, warnings = self.done("convert", "s.mesh", "s.vtkhdf")
        self.assertIn("2 variables are renamed", warnings)
        self.assertIn("'d/dx', is 'd_dx' there", warnings)
        with h5py.File(self.folder / "s.vtkhdf") as file:
            self.assertIn("d_dx", file["VTKHDF/PointData"])
            self.assertEqual(file["VTKHDF/CellData/boundary"].dtype, np.int32)
            self.assertIn("boundary_2", file["VTKHDF/CellData"])

    def test_it_is_not_read(self):
        self.done("mesh", "case.toml", "-o", "m", "-q")
        for arguments in (["check", "m.vtkhdf"], ["convert", "m.vtkhdf", "b.mesh"], ["smooth", "m.vtkhdf", "-o", "b.mesh"]):
            self.refused(1, ["m.vtkhdf: is a VTKHDF file, which is written but not read; give the mesh as .mesh, .cgns or .vtu"], *arguments)
        self.refused(1, ["m.vtkhdf"], "check", "none/m.vtkhdf")

    def test_every_command_that_writes_meshes_writes_it(self):
        self.done("mesh", "case.toml", "-o", "m", "-q")
        with_layers = 'layers = { first = 0.01, growth = 1.3, count = 4 }'
        flow = CASE.replace(with_layers, '[boundary.box]\nbc = "farfield"')
        self.write("flow.toml", flow + "[solver]\nmach = 0.3\niterations = 2\n[adapt]\ncycles = 1\n")
        self.done("mesh", "flow.toml", "-o", "f", "-q")
        self.done("smooth", "m.mesh", "-o", "s.vtkhdf", "--sweeps", "1", "-q")
        self.done("solve", "flow.toml", "f.mesh", "-o", "f.vtkhdf", "-q")
        with h5py.File(self.folder / "f.vtkhdf") as file:
            self.assertIn("density", file["VTKHDF/PointData"])
        self.done("adapt", "flow.toml", "-o", "run", "-q")
        with h5py.File(self.folder / "run/cycle_01/mesh.vtkhdf") as file:
            self.assertIn("density", file["VTKHDF/PointData"])
        self.done("remesh", "flow.toml", "--tree", "run/cycle_00/mesh.tree.h5", "--solution", "run/cycle_00/mesh.mesh", "-o", "r", "-q")
        with h5py.File(self.folder / "r.vtkhdf") as file, h5py.File(self.folder / "run/cycle_01/mesh.vtkhdf") as loop:
            self.assertEqual(file["VTKHDF/Points"].shape, loop["VTKHDF/Points"].shape)
        record = json.loads(self.done("mesh", "case.toml", "-o", "dry", "--dry-run", "--json")[0])
        self.assertGreater(record["file_bytes"]["dry.vtkhdf"], 1000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
