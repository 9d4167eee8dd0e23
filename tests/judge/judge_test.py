#!/usr/bin/env python3
"""The judge judged: good meshes pass, and meshes broken on purpose are caught, each by the rule that it breaks."""
import copy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import sample_meshes as samples
from judge import area_of, areas_of_blocks, check_blocks, differences, judge
from mesh_files import Unreadable, read_geometry, read_mesh


def rules_of(mesh, **options):
    return {fault.rule for fault in judge(mesh, **options)}


def node_at(mesh, x, y):
    return int(np.flatnonzero((mesh.points == (x, y)).all(axis=1))[0])


class GoodMeshes(unittest.TestCase):
    def test_hybrid_with_a_hole(self):
        mesh = samples.frame()
        self.assertEqual(judge(mesh, geometry=samples.outline_of_frame(), corners=True, area=12.0), [])
        self.assertEqual(area_of(mesh), 12.0)

    def test_two_blocks(self):
        mesh = samples.two_blocks()
        self.assertEqual(judge(mesh, geometry=samples.outline_of_two_blocks(), corners=True, area=16.0), [])
        self.assertEqual(areas_of_blocks(mesh), {"ring": 12.0, "core": 4.0})

    def test_an_edge_between_blocks_need_not_be_delaunay(self):
        mesh = samples.two_triangles(0.5)
        mesh.blocks, mesh.of_cells = ("above", "below"), np.array([0, 1])
        mesh.boundaries["middle"] = np.array([(0, 1)])
        self.assertEqual(judge(mesh, delaunay=True), [])

    def test_triangles_alone(self):
        self.assertEqual(judge(samples.frame(triangles_alone=True), delaunay=True), [])

    def test_two_pieces_and_pieces_that_touch_in_a_node(self):
        self.assertEqual(judge(samples.squares((0, 0, 1), (2, 0, 1))), [])
        self.assertEqual(judge(samples.squares((0, 0, 1), (1, 1, 1))), [])

    def test_four_nodes_on_one_circle_are_delaunay(self):
        self.assertEqual(judge(samples.two_triangles(1.0), delaunay=True), [])
        self.assertEqual(judge(samples.two_triangles(1.0 + 1e-15), delaunay=True), [])


class Outlines(unittest.TestCase):
    def geometry(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.geom")
            path.write_text(text)
            return read_geometry(path)

    def test_many_points_stand_for_a_curve(self):
        half = "2\n1 0 curve 1 1 weights 1 0.7071067811865476 1 spacing 0.25\n0 1 curve -1 1 weights 1 0.7071067811865476 1\n"
        chains = self.geometry(f"2\nround\n3\n{half[2:]}-1 0\nside open\n2\n0 0 curve 1 1\n2 0\n")
        (closed, points), = chains["round"]
        self.assertTrue(closed)
        on_arc = points[:-1]
        np.testing.assert_allclose(np.hypot(*on_arc.T), 1, atol=1e-15)
        self.assertLess(np.abs(np.diff(points, axis=0)).max(), 1e-4)
        self.assertEqual(points[-1].tolist(), [-1, 0])
        (closed, points), = chains["side"]
        self.assertFalse(closed)
        np.testing.assert_allclose(points[:, 1], points[:, 0] * (2 - points[:, 0]) / 2, atol=1e-12)
        self.assertEqual(points[-1].tolist(), [2, 0])

    def test_a_row_that_is_no_segment(self):
        for row in ("1 0 curve", "1 0 arc 3 4", "1 0 curve 3", "1"):
            with self.assertRaises(Unreadable):
                self.geometry(f"1\na\n2\n{row}\n0 1\n")


class BrokenMeshes(unittest.TestCase):
    def setUp(self):
        self.mesh = samples.frame()

    def assert_breaks(self, rule, mesh=None, **options):
        self.assertIn(rule, rules_of(mesh or self.mesh, **options))

    def test_a_coordinate_that_is_no_number(self):
        for value in (np.nan, np.inf):
            self.mesh.points[3, 1] = value
            self.assert_breaks("finite coordinates")

    def test_a_crack_of_no_width(self):
        twin = len(self.mesh.points)
        self.mesh.points = np.vstack([self.mesh.points, self.mesh.points[self.mesh.quads[0, 2]]])
        self.mesh.quads[0, 2] = twin
        self.assert_breaks("no two nodes at one place")

    def test_a_node_of_no_cell(self):
        self.mesh.points = np.vstack([self.mesh.points, [9, 9]])
        self.assert_breaks("every node is a cell's")

    def test_no_cells(self):
        empty = samples.Mesh(np.empty((0, 2)))
        self.assert_breaks("a mesh has cells", empty)

    def test_a_cell_that_holds_a_node_twice(self):
        self.mesh.quads[0, 1] = self.mesh.quads[0, 0]
        self.assert_breaks("a cell's nodes differ")

    def test_a_cell_twice(self):
        self.mesh.triangles = np.vstack([self.mesh.triangles, np.roll(self.mesh.triangles[0], 1)])
        self.assert_breaks("no cell twice")
        self.assert_breaks("two cells lie on two sides of an edge")

    def test_a_cell_that_runs_clockwise(self):
        for cells in self.mesh.kinds():
            broken = copy.deepcopy(self.mesh)
            table = broken.triangles if cells.shape[1] == 3 else broken.quads
            table[1] = table[1][::-1].copy()
            self.assert_breaks("cells run counter-clockwise and are convex", broken)

    def test_a_quad_that_is_not_convex(self):
        self.mesh.points[node_at(self.mesh, 0, 0)] = (0.7, 0.7)
        self.assert_breaks("cells run counter-clockwise and are convex")

    def test_a_quad_and_a_triangle_that_are_flat_in_one_corner(self):
        flat_quad, flat_triangle = copy.deepcopy(self.mesh), self.mesh
        flat_quad.points[node_at(flat_quad, 0, 0)] = (0.5, 0.5)
        self.assert_breaks("cells run counter-clockwise and are convex", flat_quad)
        flat_triangle.points[node_at(flat_triangle, 0, 4)] = (0.5, 3.5)
        self.assert_breaks("cells run counter-clockwise and are convex", flat_triangle)

    def test_a_missing_cell(self):
        self.mesh.quads = np.delete(self.mesh.quads, 1, axis=0)
        self.assert_breaks("boundary edges are edges of cells")
        self.assert_breaks("an edge of one cell is a boundary's")

    def test_a_hanging_node(self):
        """A quad beside another is halved alone: their common edge has a node of one of them."""
        a, b, c, d = self.mesh.quads[0]  # b - c is the common edge
        middle = len(self.mesh.points)
        self.mesh.points = np.vstack([self.mesh.points, [1, 0.5]])
        self.mesh.quads = self.mesh.quads[1:]
        self.mesh.triangles = np.vstack([self.mesh.triangles, [(a, b, middle), (a, middle, d), (middle, c, d)]])
        self.assert_breaks("no hanging nodes")

    def test_a_boundary_edge_that_runs_the_wrong_way(self):
        self.mesh.boundaries["outer"][2] = self.mesh.boundaries["outer"][2][::-1].copy()
        self.assert_breaks("boundaries have the domain to their left")
        self.assert_breaks("boundaries are closed loops")

    def test_a_whole_loop_that_runs_the_wrong_way(self):
        self.mesh.boundaries["inner"] = self.mesh.boundaries["inner"][:, ::-1].copy()
        self.assert_breaks("boundaries have the domain to their left")

    def test_a_missing_boundary_edge(self):
        self.mesh.boundaries["outer"] = self.mesh.boundaries["outer"][1:]
        self.assert_breaks("an edge of one cell is a boundary's")
        self.assert_breaks("boundaries are closed loops")

    def test_a_boundary_edge_twice_and_under_two_names(self):
        twice = copy.deepcopy(self.mesh)
        twice.boundaries["outer"] = np.vstack([twice.boundaries["outer"], twice.boundaries["outer"][:1]])
        self.assert_breaks("no boundary edge twice", twice)
        self.mesh.boundaries["other"] = self.mesh.boundaries["inner"][:1].copy()
        self.assert_breaks("no boundary edge twice")

    def test_a_boundary_inside_the_mesh(self):
        inside = (node_at(self.mesh, 1, 0), node_at(self.mesh, 1, 1))
        self.mesh.boundaries["wall"] = np.array([inside, inside[::-1]])
        self.assert_breaks("boundary edges bound one cell")

    def test_edges_between_blocks(self):
        mesh = samples.two_blocks()
        turned, missing, twice = (copy.deepcopy(mesh) for _ in range(3))
        turned.boundaries["inner"][2] = turned.boundaries["inner"][2][::-1].copy()
        self.assert_breaks("the first of two blocks is left of its edge", turned)
        missing.boundaries["inner"] = missing.boundaries["inner"][1:]
        self.assert_breaks("an edge between two blocks is a boundary's", missing)
        twice.boundaries["inner"] = np.vstack([twice.boundaries["inner"], twice.boundaries["inner"][:1]])
        self.assert_breaks("no boundary edge twice", twice)
        mesh.of_cells[:] = 0
        self.assert_breaks("boundary edges bound one cell", mesh)

    def test_a_block_of_another_area(self):
        mesh = samples.two_blocks()
        for x in (1, 2, 3):
            mesh.points[node_at(mesh, x, 3)] = (x, 3.2)
        outline = samples.outline_of_two_blocks()
        for points in (points for _, points in outline["inner"]):
            points[points[:, 1] == 3] += (0, 0.2)
        self.assertEqual(judge(mesh, geometry=outline), [])
        self.assert_breaks("boundary nodes lie on the outline", mesh, geometry=samples.outline_of_two_blocks())
        for _, points in outline["inner"]:
            points[:, 1] = 1 + (points[:, 1] - 1) * 1.5  # its nodes lie on it, but those of the mesh do not reach its end
        self.assertEqual({fault.rule for fault in check_blocks(mesh, outline)}, {"areas of blocks"})

    def test_an_interface_with_cells_on_one_side(self):
        mesh = samples.frame()
        mesh.blocks = ("ring", "core")
        self.assert_breaks("lines between two blocks have cells on both sides", mesh, geometry=samples.outline_of_two_blocks())

    def test_a_boundary_edge_that_is_no_cells(self):
        a, b = node_at(self.mesh, 0, 0), node_at(self.mesh, 2, 0)
        self.mesh.boundaries["wall"] = np.array([(a, b), (b, a)])
        self.assert_breaks("boundary edges are edges of cells")

    def test_a_boundary_without_edges(self):
        self.mesh.boundaries["nothing"] = samples.no_rows(2)
        self.assert_breaks("boundaries have edges")

    def test_a_node_that_cells_go_round_twice(self):
        self.assert_breaks("cells go once round a node", samples.double_fan())

    def test_boundaries_that_cross(self):
        self.assert_breaks("boundaries meet at nodes alone", samples.squares((0, 0, 1), (0.5, 0.5, 1)))

    def test_a_node_of_one_boundary_on_an_edge_of_another(self):
        self.assert_breaks("boundaries meet at nodes alone", samples.squares((0, 0, 1), (1, 0.5, 2)))

    def test_boundaries_that_share_part_of_a_line(self):
        self.assert_breaks("boundaries meet at nodes alone", samples.squares((0, 0, 1), (1, 0, 2)))

    def test_cells_over_cells(self):
        self.assert_breaks("the domain is covered once", samples.squares((0, 0, 4), (1, 1, 1)))

    def test_an_edge_that_is_not_delaunay(self):
        self.assert_breaks("edges are locally Delaunay", samples.two_triangles(0.99), delaunay=True)
        self.assert_breaks("edges are locally Delaunay", samples.two_triangles(1 - 1e-15), delaunay=True)

    def test_quads_in_a_delaunay_mesh(self):
        self.assert_breaks("triangles alone", delaunay=True)

    def test_another_area(self):
        self.assert_breaks("area", area=12.0 + 1e-9)

    def test_another_outline(self):
        outline = samples.outline_of_frame()
        outline["more"] = outline["inner"]
        self.assert_breaks("every boundary of the outline is the mesh's", geometry=outline)
        del outline["more"], outline["inner"]
        self.assert_breaks("every boundary of the mesh is the outline's", geometry=outline)

    def test_a_boundary_node_off_the_outline(self):
        self.mesh.points[node_at(self.mesh, 2, 0)] = (2, 1e-8)
        self.assert_breaks("boundary nodes lie on the outline", geometry=samples.outline_of_frame())

    def test_a_corner_that_is_no_node(self):
        self.mesh.points[node_at(self.mesh, 0, 0)] = (0.1, 0)
        self.assert_breaks("sharp corners are nodes", geometry=samples.outline_of_frame(), corners=True)

    def test_files_that_differ(self):
        for change in (lambda m: m.points.__setitem__((0, 0), 1e-16), lambda m: m.quads.__setitem__(0, np.roll(m.quads[0], 1)),
                       lambda m: m.boundaries.__setitem__("new", m.boundaries.pop("outer"))):
            other = copy.deepcopy(self.mesh)
            change(other)
            self.assertNotEqual(differences(self.mesh, other), [])
        self.assertEqual(differences(self.mesh, copy.deepcopy(self.mesh)), [])


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.native, self.cgns = (Path(self.folder.name) / name for name in ("m.mesh", "m.cgns"))
        self.mesh = samples.frame()
        self.text = samples.native_text(self.mesh)

    def read_native(self, text):
        self.native.write_text(text)
        return read_mesh(self.native)

    def test_what_is_written_is_read(self):
        samples.write_cgns(self.mesh, self.cgns)
        self.assertEqual(differences(self.read_native(self.text), self.mesh), [])
        self.assertEqual(differences(read_mesh(self.cgns), self.mesh), [])

    def test_names_and_cells_of_blocks(self):
        mesh = samples.two_blocks()
        self.assertEqual(differences(self.read_native(samples.native_text(mesh)), mesh), [])
        other = self.read_native(samples.native_text(mesh).replace("# block core", "# block heart"))
        self.assertEqual(other.blocks, ("ring", "heart"))
        self.assertNotEqual(differences(other, mesh), [])

    def test_a_solution_may_follow(self):
        rows = "\n".join("1 2" for _ in self.mesh.points)
        solution = f"#Number of constants\n1\n7\n#Number of variables\n2\n#names: a b\n{rows}\n"
        self.assertEqual(differences(self.read_native(self.text + solution), self.mesh), [])
        for wrong in (solution + "1 2\n", solution[:-4]):
            self.assertRaises(Unreadable, self.read_native, self.text + wrong)

    def test_damaged_native_files(self):
        nodes = len(self.mesh.points)
        lines = self.text.splitlines()
        for wrong in (self.text[:len(self.text) // 2], self.text.replace(f"\n{nodes}\n", f"\n{nodes + 1}\n", 1), "\n".join(lines[:2] + lines[3:]),
                      self.text.replace("\n1 2\n", f"\n1 {nodes + 1}\n", 1), self.text.replace("\n1 2\n", "\n0 2\n", 1),
                      self.text.replace("\n0.0 0.0\n", "\n0.0 zero\n", 1), self.text.replace("\n0.0 0.0\n", "\n0.0\n", 1)):
            self.assertNotEqual(wrong, self.text)
            self.assertRaises(Unreadable, self.read_native, wrong)

    def test_damaged_cgns_files(self):
        import h5py

        def damage(place, change):
            samples.write_cgns(self.mesh, self.cgns)
            with h5py.File(self.cgns, "r+") as file:
                data = file[f"Base/domain/{place}/ data"]
                data[...] = change(data[()])
            self.assertRaises(Unreadable, read_mesh, self.cgns)
        damage("QUAD_4/ElementRange", lambda values: values + 1)
        damage("TRI_3/ElementConnectivity", lambda values: values + 100)
        damage("TRI_3", lambda values: values + 1)  # of another type
        damage("ZoneBC/inner/PointRange", lambda values: values - 1)
        damage("ZoneBC/inner/PointRange", lambda values: values * 0 + 1)

    def test_the_command(self):
        def status(text, *options):
            self.native.write_text(text)
            command = [sys.executable, "-B", Path(__file__).with_name("judge.py"), self.native, *options]
            return subprocess.run(command, capture_output=True, check=False).returncode
        self.assertEqual(status(self.text, "--area", "12"), 0)
        self.assertEqual(status(self.text, "--delaunay"), 1)
        self.assertEqual(status(self.text[:-9]), 2)


if __name__ == "__main__":
    unittest.main()
