#!/usr/bin/env python3
"""The figures of layers on small meshes whose layers are known."""
import sys
import unittest

import numpy as np

from layers import figures_of, find_layers, next_row, CellEdges
from mesh_files import Mesh, no_rows

COUNT, GROWTH, FIRST = 3, 1.5, 0.1
THICKNESS = FIRST * (1 + GROWTH + GROWTH**2)


def split(quads):
    return np.concatenate([quads[:, [0, 1, 3]], quads[:, [1, 2, 3]]])


def floor(width=0.5, columns=4, outer=0.3, triangles=False):
    """Columns of three layers on y = 0 and one row of cells over them."""
    heights = np.concatenate([[0], np.cumsum(FIRST * GROWTH**np.arange(COUNT)), [THICKNESS + outer]])
    points = np.array([(width * i, y) for i in range(columns + 1) for y in heights])
    rows = len(heights)
    quads = np.array([(i * rows + k, (i + 1) * rows + k, (i + 1) * rows + k + 1, i * rows + k + 1) for i in range(columns) for k in range(rows - 1)])
    wall = np.array([(i * rows, (i + 1) * rows) for i in range(columns)])
    if triangles:
        return Mesh(points, split(quads), boundaries={"wall": wall})
    return Mesh(points, quads=quads, boundaries={"wall": wall})


def sharp_edge():
    """One column over each side of an edge at (0, 0), a fan of two sectors, three layers, and a row of cells round all of it."""
    radii = np.concatenate([np.cumsum(FIRST * GROWTH**np.arange(COUNT)), [1.0]])
    angles = np.radians([90, 0, -90])
    points, number = [(0.0, 0.0)], {}
    for ray, angle in enumerate(angles):
        for ring, radius in enumerate(radii, 1):
            number[ray, ring] = len(points)
            points.append((radius * np.cos(angle), radius * np.sin(angle)))
    for side, y in (("up", 1), ("down", -1)):
        number[side, 0] = len(points)
        points.append((-0.5, 0.0 if y > 0 else -1e-12))
        for ring, radius in enumerate(radii, 1):
            number[side, ring] = len(points)
            points.append((-0.5, y * radius))
    triangles = [(0, number[1, 1], number[0, 1]), (0, number[2, 1], number[1, 1])]
    quads = []
    for ring in range(1, 4):
        quads += [(number[r, ring], number[r + 1, ring], number[r + 1, ring + 1], number[r, ring + 1]) for r in (0, 1)]
    for ring in range(4):
        low = lambda ray: 0 if ring == 0 else number[ray, ring]
        quads.append((number["up", ring], low(0), number[0, ring + 1], number["up", ring + 1]))
        quads.append((low(2), number["down", ring], number["down", ring + 1], number[2, ring + 1]))
    wall = np.array([(number["up", 0], 0), (0, number["down", 0])])
    return Mesh(np.array(points), np.array(triangles), np.array(quads), {"wall": wall})


def figures(mesh):
    return figures_of(mesh, find_layers(mesh, ["wall"], COUNT), FIRST, GROWTH, THICKNESS)


class LayersTest(unittest.TestCase):
    def test_a_perfect_floor_has_perfect_figures(self):
        said = figures(floor())
        self.assertEqual((said["columns"], said["incomplete"], said["layer_cells"], said["outer_cells"]), (4, 0, 12, 4))
        self.assertEqual((said["full"], said["first_close"], said["growth_close"]), (100, 100, 100))
        for name, value in {"first_worst": 0, "growth_most": GROWTH, "tilt_99": 0, "widths_most": 1, "skew_most": 0, "orthogonality": 0,
                            "outer_angle": 90, "outer_5": 0.3 / 0.225, "outer_area": 0.3 / 0.225, "least_height": 1}.items():
            self.assertAlmostEqual(said[name], value, 5, name)

    def test_the_same_in_triangles(self):
        mesh = floor(triangles=True)
        said, of_quads = figures(mesh), figures(floor())
        self.assertEqual((said["columns"], said["layer_cells"], said["outer_cells"]), (4, 24, 8))
        for name in ("full", "first_worst", "growth_most", "tilt_99", "widths_most"):
            self.assertAlmostEqual(said[name], of_quads[name], 12, name)

    def test_both_diagonals_are_one_quad(self):
        points = np.array([(0.0, 0), (1, 0), (1, 0.1), (0, 0.1)])
        for triangles in ([(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]):
            c, d, first, second = next_row(points, CellEdges(Mesh(points, np.array(triangles))), np.array([0]), np.array([1]))
            self.assertEqual((c[0], d[0]), (2, 3))
            self.assertEqual({first[0], second[0]}, {0, 1})

    def test_columns_that_lean_are_found_in_triangles_too(self):
        mesh = floor(width=1, triangles=True)
        mesh.points[:, 0] += 4 * mesh.points[:, 1]
        layers = find_layers(mesh, ["wall"], COUNT)
        self.assertEqual((layers.incomplete, layers.in_layers.sum()), (0, 24))
        self.assertTrue((layers.left == np.arange(4)[:, None] * (COUNT + 2) + np.arange(COUNT + 1)).all())

    def test_a_missing_layer_is_counted(self):
        mesh = floor()
        mesh.quads = np.delete(mesh.quads, 1, axis=0)  # the second layer of the first column
        self.assertEqual(find_layers(mesh, ["wall"], COUNT).incomplete, 1)
        self.assertEqual(find_layers(floor(), ["wall"], COUNT + 2).incomplete, 4, "there is no fifth")

    def test_each_fault_shows_in_its_figure(self):
        rows = COUNT + 2
        def moved(node, by):
            mesh = floor()
            mesh.points[node] += by
            return figures(mesh)
        self.assertAlmostEqual(moved(2 * rows + 1, (0, 0.01))["first_worst"], 0.05)
        self.assertEqual(moved(2 * rows + 1, (0, 0.01))["first_close"], 50)
        self.assertGreater(moved(2 * rows + 2, (0, 0.02))["growth_most"], GROWTH + 0.05)
        self.assertEqual(moved(2 * rows + 3, (0, -0.1))["full"], 50)
        self.assertAlmostEqual(moved(2 * rows + 3, (0, -0.1))["least_height"], 1 - 0.05 / THICKNESS)
        leaning = moved(2 * rows + 3, (0.1, 0))
        self.assertAlmostEqual(leaning["tilt_99"], np.degrees(np.arctan(0.1 / THICKNESS)), 3)
        self.assertAlmostEqual(leaning["widths_most"], 0.6 / 0.4)
        self.assertGreater(leaning["skew_most"], 0.2)

    def test_a_fan_belongs_to_the_layers(self):
        mesh = sharp_edge()
        layers = find_layers(mesh, ["wall"], COUNT)
        self.assertEqual(len(layers.left), 2)
        self.assertEqual(layers.in_layers.sum(), 2 * COUNT + 2 + 2 * (COUNT - 1), "two columns, two triangles, two rows of two quads")
        self.assertEqual((~layers.in_layers).sum(), 4)

    def test_non_orthogonality_of_a_sheared_mesh(self):
        mesh = floor()
        mesh.points[:, 0] += mesh.points[:, 1]
        self.assertAlmostEqual(figures(mesh)["orthogonality"], 45, 5)


if __name__ == "__main__":
    sys.exit(unittest.main())
