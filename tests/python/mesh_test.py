"""Meshes as arrays: views without copies, names, checks, files, pictures, conversions."""
import gc
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import quadloop as ql

PROGRAM = sys.argv[1]
CASE = ql.Case(outlines={"ring": ql.polygon([[0, 0], [4, 0], [4, 3], [0, 3]]), "hole": [[1, 1], [2, 1], [2, 2]]}, spacing={"max": 0.25})


def area(mesh):
    total = 0.0
    for cells in (mesh.triangles, mesh.quads):
        p = mesh.points[cells]
        q = np.roll(p, -1, axis=1)
        total += 0.5 * (p[:, :, 0] * q[:, :, 1] - p[:, :, 1] * q[:, :, 0]).sum()
    return total


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = ql.mesh(CASE)

    def test_cells_cover_the_domain_and_edges_bound_it(self):
        mesh = self.mesh
        self.assertAlmostEqual(area(mesh), 11.5, 12)
        self.assertEqual(set(mesh.edges), {"ring", "hole"})
        around = sum(np.hypot(*(mesh.points[e[:, 1]] - mesh.points[e[:, 0]]).T).sum() for e in [mesh.edges["ring"]])
        self.assertAlmostEqual(around, 14, 12)
        self.assertEqual(mesh.nodes, mesh.owned)
        np.testing.assert_array_equal(mesh.global_ids, np.arange(mesh.owned))
        self.assertEqual(mesh.check(), [])
        self.assertGreater(mesh.quality.worst_quality, 0.3)

    def test_arrays_are_views_that_outlive_the_mesh_and_cannot_be_changed(self):
        mesh = ql.mesh(CASE)
        points, again, hole = mesh.points, mesh.points, mesh.edges["hole"]
        self.assertTrue(np.shares_memory(points, again))
        for array in (points, mesh.triangles, mesh.quads, hole):
            self.assertFalse(array.flags.writeable or array.flags.owndata)
        copy = points.copy()
        del mesh
        gc.collect()
        others = [ql.mesh(CASE.changed(spacing={"max": 0.2})) for _ in range(3)]
        np.testing.assert_array_equal(points, copy)
        self.assertEqual(len(others), 3)

    def test_a_million_cells_are_handed_over_without_a_copy(self):
        mesh = ql.mesh(ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.001}))
        self.assertGreater(len(mesh.quads) + len(mesh.triangles), 1_000_000)
        for array, again in [(mesh.points, mesh.points), (mesh.quads, mesh.quads)]:
            self.assertTrue(np.shares_memory(array, again) and not array.flags.owndata)

    def test_files_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            self.mesh.write(Path(folder, "library.mesh"))
            Path(folder, "case.toml").write_text(CASE.toml)
            subprocess.run([PROGRAM, "-q", "mesh", "case.toml", "-o", "command"], cwd=folder, check=True)
            self.assertEqual(Path(folder, "library.mesh").read_bytes(), Path(folder, "command.mesh").read_bytes())
            height = self.mesh.points[:, 1] ** 2
            self.mesh.write(Path(folder, "solved.vtu"), {"height": height})
            back, solution = ql.read(Path(folder, "solved.vtu"))
            order, old = np.lexsort(back.points.T), np.lexsort(self.mesh.points.T)
            np.testing.assert_array_equal(back.points[order], self.mesh.points[old])
            np.testing.assert_array_equal(solution["height"][order], height[old])
            with self.assertRaises(ql.OutputError):
                self.mesh.write(Path(folder, "none", "a.mesh"))
            with self.assertRaisesRegex(ql.InputError, "7 values"):
                self.mesh.write(Path(folder, "a.vtu"), {"height": np.zeros(7)})

    def test_the_report_of_layers(self):
        layers = {"first": 0.01, "growth": 1.2, "count": 6}
        mesh = ql.mesh(CASE.changed(boundary={"hole": {"bc": "wall", "layers": layers}}))
        report = mesh.layers["hole"]
        self.assertEqual((report.count, report.count_reached), (6, 6))
        self.assertAlmostEqual(report.first, 0.01, 6)
        self.assertGreater(report.coverage, 0.9)
        self.assertEqual(self.mesh.layers, {})

    def test_meshes_from_arrays_and_smoothing(self):
        mesh = self.mesh
        copy = ql.from_arrays(mesh.points, mesh.triangles, mesh.quads, mesh.edges)
        self.assertEqual(copy.check(), [])
        np.testing.assert_array_equal(copy.edges["hole"], mesh.edges["hole"])
        inside = np.setdiff1d(np.arange(mesh.owned), np.concatenate([edges.ravel() for edges in mesh.edges.values()]))
        points = mesh.points.copy()
        points[inside] += 0.08 * np.sin(1000 * points[inside, ::-1])
        shaken = ql.from_arrays(points, mesh.triangles, mesh.quads, mesh.edges)
        better = ql.smooth(CASE.changed(smooth={"sweeps": 5}, mesh={"quads": "all"}), shaken)
        self.assertGreater(better.quality.mean_quality, shaken.quality.mean_quality)
        self.assertEqual(better.check(), [])
        with self.assertRaisesRegex(ql.InputError, "names node 9"):
            ql.from_arrays([[0, 0], [1, 0], [0, 1]], [[0, 1, 9]])
        with self.assertRaisesRegex(ql.InputError, "whole numbers"):
            ql.from_arrays([[0, 0], [1, 0], [0, 1]], [[0.0, 1.0, 2.0]])

    def test_a_mesh_is_extruded_as_by_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            height = {"height": self.mesh.points[:, 1]}
            self.mesh.write(f"{folder}/a.mesh", height)
            for axis in ("z", "y"):
                subprocess.run([PROGRAM, "extrude", "a.mesh", "-o", "command.vtu", "--layers", "2", "--thickness", "1", "--axis", axis, "-q"], cwd=folder, check=True)
                self.mesh.extrude(f"{folder}/module.vtu", [0, 0.5, 1], height, axis=axis)
                self.assertEqual(Path(folder, "module.vtu").read_bytes(), Path(folder, "command.vtu").read_bytes())
            with self.assertRaisesRegex(ql.InputError, "does not lie above"):
                self.mesh.extrude(f"{folder}/module.vtu", [1, 0])
            with self.assertRaisesRegex(ql.InputError, "axis is"):
                self.mesh.extrude(f"{folder}/module.vtu", [0, 1], axis="x")

    def test_blocks_of_a_file_are_kept_as_by_convert(self):
        sides = {"left": [[0.5, 1], [0, 1], [0, 0], [0.5, 0]], "right": [[0.5, 0], [1, 0], [1, 1], [0.5, 1]], "between": [[0.5, 0], [0.5, 1]]}
        blocks = [{"name": "west", "boundaries": ["left", "between"]}, {"name": "east", "boundaries": ["right", "between"]}]
        made = ql.mesh(ql.Case(outlines={name: ql.curve(points) for name, points in sides.items()}, spacing={"max": 0.1}, block=blocks))
        self.assertEqual(made.check(), [])
        with tempfile.TemporaryDirectory() as folder:
            made.write(f"{folder}/a.vtu")
            mesh, _ = ql.read(f"{folder}/a.vtu")
            self.assertEqual(mesh.blocks["names"], ["west", "east"])
            self.assertEqual(len(mesh.blocks["quads"]), len(mesh.quads))
            self.assertEqual(mesh.check(), [])
            mesh.write(f"{folder}/module.msh")
            subprocess.run([PROGRAM, "convert", "a.vtu", "command.msh", "-q"], cwd=folder, check=True)
            self.assertEqual(Path(folder, "module.msh").read_bytes(), Path(folder, "command.msh").read_bytes())

    def test_pictures_of_the_kinds_of_files(self):
        height = {"height": self.mesh.points[:, 1]}
        for kind, head in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            shown = self.mesh.picture(kind, "height", height)
            self.assertTrue(shown.startswith(head), kind)
            with tempfile.TemporaryDirectory() as folder:
                self.mesh.plot(f"{folder}/a.{kind}", "height", height)
                self.assertTrue(Path(folder, f"a.{kind}").read_bytes().startswith(head))
        with self.assertRaisesRegex(ql.InputError, "format is"):
            self.mesh.picture("gif")
        with self.assertRaisesRegex(ql.InputError, "depth"):
            self.mesh.png("depth", height)
        flow = {"density": 1 + 0 * height["height"], "x_velocity": height["height"], "y_velocity": 0 * height["height"], "pressure": 1 + 0 * height["height"]}
        self.assertTrue(self.mesh.png("mach", flow).startswith(b"\x89PNG"))

    def test_a_notebook_shows_picture_and_table(self):
        self.assertTrue(self.mesh._repr_png_().startswith(b"\x89PNG"))
        self.assertIn("edges of hole", self.mesh._repr_html_())
        shown = self.mesh.png("height", {"height": self.mesh.points[:, 1]}, size=500)
        self.assertTrue(shown.startswith(b"\x89PNG") and shown != self.mesh.png(size=500))

    def test_conversions_keep_names(self):
        meshio = types.SimpleNamespace(Mesh=lambda points, cells, **more: types.SimpleNamespace(points=points, cells=cells, **more))
        with mock.patch.dict(sys.modules, {"meshio": meshio}):
            converted = self.mesh.to_meshio({"x": self.mesh.points[:, 0]})
        self.assertEqual(set(converted.cell_sets), {"ring", "hole"})
        given = types.SimpleNamespace(points=converted.points, cell_sets=converted.cell_sets,
                                      cells=[types.SimpleNamespace(type=kind, data=data) for kind, data in converted.cells])
        back = ql.from_meshio(given)
        np.testing.assert_array_equal(back.quads, self.mesh.quads)
        np.testing.assert_array_equal(back.edges["ring"], self.mesh.edges["ring"])
        lines = dict(zip(self.mesh.edges, converted.cells[2:]))
        np.testing.assert_array_equal(lines["hole"][1], self.mesh.edges["hole"])
        self.assertEqual([len(part) for part in converted.cell_sets["hole"]], [len(self.mesh.edges["hole"]) if name == "hole" else 0 for name in ("", "", *self.mesh.edges)])


unittest.main(argv=["mesh_test"])
