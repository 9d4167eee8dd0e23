#!/usr/bin/env python3
"""Layers from the case file to the tables and files, through `check`, `convert` and `smooth`.

    layers_test.py QUADLOOP MPIRUN
"""
import itertools
import json
import math
import re
import struct
import sys
import unittest
from pathlib import Path

from program import ProgramTest

sys.path[:0] = [str(Path(__file__).parents[1] / name) for name in ("judge", "cases")]
import judge  # noqa: E402
from mesh_files import read_geometry, read_mesh  # noqa: E402
from quadloop_runs import NativeMesh  # noqa: E402

BOX = "4\n{wall} open\n2\n0 0\n4 0\noutlet open\n2\n4 0\n4 2\ntop open\n2\n4 2\n0 2\ninlet open\n2\n0 2\n0 0\n"
CASE = """[geometry]
file = "box.geom"
[spacing]
min = 0.035
max = 0.5
[boundary.wall]
spacing = 0.2
layers = {{ {layers} }}
"""


class Layers(ProgramTest):
    def make(self, layers="first = 0.001, growth = 1.3, count = 12", more="", *options, out="out", ranks=1):
        self.write("box.geom", BOX.format(wall="wall"))
        self.write("case.toml", CASE.format(layers=layers) + more)
        stdout, stderr = self.done("mesh", "case.toml", "-o", out, "--json", *options, ranks=ranks)
        self.assertEqual(stderr, "")
        return json.loads(stdout)

    def checked(self, name):
        return json.loads(self.done("check", name, "--json")[0])

    def nodes(self, name):
        rows = (self.folder / name).read_text().splitlines()
        return [tuple(map(float, row.split())) for row in rows[2:2 + int(rows[1])]]

    def test_what_was_asked_is_reached_and_measured(self):
        thickness = 0.001 * (1.3**12 - 1) / 0.3
        said = self.make()
        (row,) = said["layers"]
        self.assertEqual((row["boundary"], row["count_asked"], row["count"]), ("wall", 12, 12))
        self.assertEqual(row["thickness_share_least"], 1)
        self.assertEqual(row["wall_share_full"], 1)
        for key in ("first_asked", "first_least", "first_median"):
            self.assertAlmostEqual(row[key], 0.001, places=12)
        self.assertAlmostEqual(row["growth_least"], 1.3, places=9)
        self.assertAlmostEqual(row["thickness_asked"], thickness, places=12)
        (measured,) = self.checked("out.mesh")["layers"]
        self.assertEqual((measured["count"], measured["columns"]), (12, row["columns"]))
        for value in measured["first"]:
            self.assertAlmostEqual(value, 0.001, places=12)
        for value in measured["growth"]:
            self.assertAlmostEqual(value, 1.3, places=9)
        for value in measured["thickness"]:
            self.assertAlmostEqual(value, thickness, places=9)
        self.assertEqual(said["layer_cells"], 12 * (row["columns"] - 1))
        self.assertEqual(said["layer_cells"] + said["outer_cells"], said["triangles"] + said["quads"])
        self.assertLess(abs(math.log(said["cells_estimated"] / (said["triangles"] + said["quads"]))), math.log(1.5))

    def test_a_smallest_leaf_above_the_last_layer_is_warned_of(self):
        self.write("box.geom", BOX.format(wall="wall"))
        self.write("case.toml", CASE.format(layers="first = 0.001, growth = 1.3, count = 12").replace("0.035", "0.05"))
        _, stderr = self.done("mesh", "case.toml", "-o", "out")
        self.assertIn("boundary 'wall': its last layer is 0.0179 high near (", stderr)
        self.assertIn("but spacing.min = 0.05 is larger", stderr)

    def test_every_way_to_ask(self):
        self.make("first = 0.001, growth = [1.1, 1.5], count = 16, equal = 2")
        (row,) = self.checked("out.mesh")["layers"]
        heights, height, growth = [], 0.001, 1.1
        for layer in range(16):
            if layer >= 2:
                height *= growth
                if layer - 1 >= 5:
                    growth = min(1.5, 1.05 * growth)
            heights.append(height)
        self.assertAlmostEqual(row["thickness"][0], sum(heights), places=9)
        self.assertAlmostEqual(row["growth"][0], 1, places=9)
        self.assertAlmostEqual(row["growth"][2], max(b / a for a, b in zip(heights, heights[1:])), places=9)
        self.make("first = 0.001, growth = 1.3, thickness = 0.05", "", "--set", "spacing.min=0.02")
        (row,) = self.checked("out.mesh")["layers"]
        self.assertEqual(row["count"], 11)
        self.assertGreaterEqual(row["thickness"][0], 0.05)
        self.make('first = "yplus:1", growth = 1.3, count = 12', "[flow]\nreynolds = 5000\nreference_length = 2\n")
        (row,) = self.checked("out.mesh")["layers"]
        friction = (2 * math.log10(5000) - 0.65) ** -2.3
        self.assertAlmostEqual(row["first"][1], 2 / (5000 * math.sqrt(friction / 2)), places=9)

    def test_thin_layers_in_a_narrow_place_are_a_warning_that_names_it(self):
        self.write("slot.geom", "2\nwall open\n2\n0 0\n4 0\nrest open\n6\n4 0\n4 2\n2.1 0.2\n1.9 0.2\n0 2\n0 0\n")
        self.write("case.toml", CASE.format(layers="first = 0.001, growth = 1.3, count = 16").replace("box.geom", "slot.geom").replace("min = 0.05", "min = 0.005"))
        stdout, stderr = self.done("mesh", "case.toml", "-o", "out", "--json")
        (row,) = json.loads(stdout)["layers"]
        self.assertEqual(row["count"], 16)
        self.assertAlmostEqual(row["first_least"], 0.001, places=9)
        self.assertLess(row["thickness_share_least"], 0.5)
        self.assertTrue(1.8 < row["least_at"][0] < 2.2 and abs(row["least_at"][1]) < 1e-9, row)
        self.assertRegex(stderr, r"boundary 'wall': near \(.*\) the 16 layers are [\d.]+ thick in total, [\d.]+ % of the requested .*; reduce count")

    def test_files_keep_them_and_say_where_they_do_not(self):
        self.make("first = 0.001, growth = 1.3, count = 12", '[output]\nformats = ["mesh", "cgns", "vtu"]\n')
        line = next(row for row in (self.folder / "out.mesh").read_text().splitlines() if row.startswith("# layers"))
        self.assertRegex(line, r"^# layers wall 12 0\.07\d+$")
        for suffix in ("cgns", "vtu"):
            self.done("convert", f"out.{suffix}", "back.mesh")
            self.assertIn(line + "\n", (self.folder / "back.mesh").read_text(), suffix)
            self.assertNotIn("Number of variables", (self.folder / "back.mesh").read_text(), suffix)
            self.assertEqual(self.checked(f"out.{suffix}")["layers"], self.checked("out.mesh")["layers"])
        for suffix in ("su2", "msh"):
            _, stderr = self.done("convert", "out.mesh", f"back.{suffix}")
            self.assertIn("cannot store the number of layers", stderr)
            self.assertNotIn("layers", self.checked(f"back.{suffix}"))

    def test_vtu_has_their_heights_on_the_wall(self):
        said = self.make("first = 0.001, growth = 1.3, count = 12", '[output]\nformats = ["vtu"]\n')
        content = (self.folder / "out.vtu").read_bytes()
        data = content.index(b'<AppendedData encoding="raw">\n_') + len(b'<AppendedData encoding="raw">\n_')

        def field(name):
            at = data + int(re.search(rf'type="Float64" Name="{name}"[^>]* offset="(\d+)"/>'.encode(), content).group(1))
            (size,) = struct.unpack_from("<Q", content, at)
            return struct.unpack_from(f"<{size // 8}d", content, at + 8)

        asked, height, places = field("layer_height_asked"), field("layer_height"), field("Points")
        thickness = said["layers"][0]["thickness_asked"]
        for i, (want, reached) in enumerate(zip(asked, height, strict=True)):
            on_wall = places[3 * i + 1] == 0
            self.assertAlmostEqual(want, thickness if on_wall else 0, places=12)
            self.assertAlmostEqual(reached, thickness if on_wall else 0, places=9)

    def test_smoothing_keeps_their_nodes_to_the_bit(self):
        for kind in ("hybrid", "delaunay"):
            self.make("first = 0.001, growth = 1.3, count = 12", "[smooth]\nsweeps = 0\n", "--type", kind, "--set", "mesh.root=[0, 0, 2, 2, 1]")
            rows = (self.folder / "out.mesh").read_text().splitlines()
            thickness = float(next(row for row in rows if row.startswith("# layers")).split()[-1])
            # the nodes outside are shaken, so that there is something to do
            for i in range(2, 2 + int(rows[1])):
                x, y = map(float, rows[i].split())
                if 0 < x < 4 and thickness + 0.2 < y < 1.9:
                    rows[i] = f"{x + 0.02 * math.sin(37 * i)} {y + 0.02 * math.sin(53 * i)}"
            self.write("shaken.mesh", "\n".join(rows) + "\n")
            before = self.nodes("shaken.mesh")
            _, stderr = self.done("smooth", "shaken.mesh", "-o", "smooth.mesh")
            self.assertNotIn("an aspect ratio above", stderr)
            after = self.nodes("smooth.mesh")
            self.assertNotEqual(before, after)
            for p, q in zip(before, after, strict=True):
                if p[1] < thickness + 1e-9:
                    self.assertEqual(p, q)
            self.assertEqual(self.checked("smooth.mesh")["layers"], self.checked("shaken.mesh")["layers"])
            self.done("smooth", "shaken.mesh", "-o", "three.mesh", ranks=3)
            self.assertEqual((self.folder / "three.mesh").read_bytes(), (self.folder / "smooth.mesh").read_bytes())

    def test_a_file_that_does_not_tell_is_doubted(self):
        self.make()
        text = (self.folder / "out.mesh").read_text()
        self.write("foreign.mesh", re.sub(r"# layers.*\n", "", text))
        _, stderr = self.done("smooth", "foreign.mesh", "-o", "smooth.mesh")
        self.assertRegex(stderr, r"foreign.mesh: \d+ cells with an aspect ratio above 20")

    def test_ranks_and_types_say_and_write_the_same(self):
        for kind in ("hybrid", "delaunay"):
            formats = '[output]\nformats = ["mesh", "vtu"]\n'
            alone = self.make("first = 0.001, growth = 1.3, count = 12", formats, "--type", kind)
            for ranks in (2, 3):
                others = self.make("first = 0.001, growth = 1.3, count = 12", formats, "--type", kind, out="many", ranks=ranks)
                self.assertEqual(others["layers"], alone["layers"])
                for key in ("layer_cells", "outer_cells", "layer_worst_quality", "outer_min_angle"):
                    self.assertEqual(others[key], alone[key])
                for suffix in ("mesh", "vtu"):
                    self.assertEqual((self.folder / f"many.{suffix}").read_bytes(), (self.folder / f"out.{suffix}").read_bytes())

    def test_too_many_cells_are_counted_with_those_of_layers(self):
        self.make()
        self.write("case.toml", CASE.format(layers="first = 1e-6, growth = 1.1, count = 100"))
        self.refused(1, ["of them are in layers: use fewer"], "mesh", "case.toml", "--max-cells", "5000")


# Inlets of a channel from (0, 1) to (0, 0), rational Bezier curves: control points and weights. They bulge out of the channel, or into it.
INLETS = {
    "arc out": ([(-0.5 * math.tan(0.6), 0.5)], [1, math.cos(0.6), 1]),
    "arc in": ([(0.5 * math.tan(0.6), 0.5)], [1, math.cos(0.6), 1]),
    "ellipse out": ([(-0.3, 0.6)], [1, 0.7, 1]),
    "ellipse in": ([(0.3, 0.4)], [1, 0.7, 1]),
    "spline": ([(-0.12, 0.7), (0.1, 0.3)], [1, 1, 1, 1]),
}
CHANNEL = "4\nfloor open\n2\n0 0\n2 0\noutlet open\n2\n2 0\n2 1\ntop open\n2\n2 1\n0 1\ninlet open\n2\n0 1 curve {}\n0 0\n"
CHANNEL_CASE = """[geometry]
file = "channel.geom"
[spacing]
min = 0.02
max = 0.2
curvature = 8
"""
CHANNEL_WALL = "[boundary.{}]\nspacing = 0.06\nlayers = {{ first = 0.004, growth = 1.2, count = 12 }}\n"


def point_of(poles, weights, t):
    """De Casteljau's algorithm."""
    rows = [(w * x, w * y, w) for (x, y), w in zip(poles, weights)]
    while len(rows) > 1:
        rows = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(rows, rows[1:])]
    x, y, w = rows[0]
    return x / w, y / w


class EndsOnCurves(ProgramTest):
    def channel(self, inlet, walls):
        control, weights = INLETS[inlet]
        self.write("channel.geom", CHANNEL.format(" ".join(map(repr, sum(control, ()))) + " weights " + " ".join(map(repr, weights))))
        self.write("case.toml", CHANNEL_CASE + "".join(CHANNEL_WALL.format(wall) for wall in walls))
        return [(0, 1), *control, (0, 0)], weights

    def require_on_inlet(self, mesh, curve):
        """That all nodes of the inlet lie on it to 1e-12, and so do those of the layers; y decreases along each inlet."""
        nodes = mesh.points[sorted(set(mesh.boundaries["inlet"].ravel()))]
        for x, y in nodes:
            low, high = 0.0, 1.0
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if point_of(*curve, middle)[1] > y else (low, middle)
            self.assertLess(abs(point_of(*curve, low)[0] - x), 1e-12, (x, y))
        return nodes

    def test_nodes_of_the_last_column_lie_on_the_curve(self):
        for inlet, (kind, walls) in itertools.product(INLETS, (("hybrid", ["floor", "top"]), ("delaunay", ["floor"]))):
            with self.subTest(inlet=inlet, kind=kind, walls=walls):
                curve = self.channel(inlet, walls)
                stdout, stderr = self.done("mesh", "case.toml", "-o", "out", "--json", "--type", kind)
                self.assertEqual(stderr, "")
                for row in json.loads(stdout)["layers"]:
                    self.assertEqual((row["count"], row["thickness_share_least"]), (12, 1))
                    self.assertAlmostEqual(row["first_least"], 0.004, delta=1e-5)
                mesh = read_mesh(str(self.folder / "out.mesh"))
                self.assertEqual(judge.judge(mesh, geometry=read_geometry(str(self.folder / "channel.geom")), corners=True), [])
                y = self.require_on_inlet(mesh, curve)[:, 1]
                self.assertEqual(sum(y < 0.17), 13)
                self.assertEqual(sum(y > 0.83), 13 if "top" in walls else sum(y > 0.83))

    def mesh_of_middle(self, control, weights, *settings):
        """The channel with layers on floor and top, which end on one curve, between y = -0.5 and 0.5."""
        row = " ".join(f"{x!r} {round(y - 0.5, 12)!r}" for x, y in control) + " weights " + " ".join(map(repr, weights))
        self.channel("spline", ["floor", "top"])
        rows = CHANNEL.format(row).replace("0 1 curve", "0 0.5 curve").splitlines()
        self.write("channel.geom", "\n".join({"0 0": "0 -0.5", "2 0": "2 -0.5", "2 1": "2 0.5", "0 1": "0 0.5"}.get(text, text) for text in rows) + "\n")
        self.done("mesh", "case.toml", "-o", "out", "--set", "mesh.root=[-1, -2, 4, 1, 1]", *settings)
        return NativeMesh(self.folder / "out.mesh")

    def require_images(self, mesh, other):
        image = other.mapped(lambda x, y: (x, 0.0 - y), True)
        image.boundaries = {{"floor": "top", "top": "floor"}.get(name, name): edges for name, edges in image.boundaries.items()}
        for here, there in zip(mesh.canonical(), image.canonical()):
            self.assertTrue(here == there, sorted(set(here) ^ set(there))[:4])

    def test_a_mirrored_curve_gives_mirrored_columns(self):
        for inlet, kind in itertools.product(INLETS, ("hybrid", "delaunay")):
            with self.subTest(inlet=inlet, kind=kind):
                control, weights = INLETS[inlet]
                mirrored = [(x, 1 - y) for x, y in control[::-1]]
                settings = ("smooth.sweeps=0", f'mesh.type="{kind}"')
                self.require_images(*(self.mesh_of_middle(points, weights, *settings) for points in (control, mirrored)))

    def test_columns_at_both_ends_of_a_symmetric_curve_are_images(self):
        for inlet, kind in itertools.product(("arc out", "arc in"), ("hybrid", "delaunay")):
            with self.subTest(inlet=inlet, kind=kind):
                mesh = self.mesh_of_middle(*INLETS[inlet], 'mesh.mirror="x"', f'mesh.type="{kind}"')
                self.require_images(mesh, mesh)

    def test_ranks_write_the_same_and_smoothing_stays_on_the_curve(self):
        for kind in ("hybrid", "delaunay"):
            curve = self.channel("spline", ["floor", "top"])
            for ranks in (1, 2, 3, 5):
                self.done("mesh", "case.toml", "-o", f"out{ranks}", "--type", kind, ranks=ranks)
                self.assertEqual((self.folder / f"out{ranks}.mesh").read_bytes(), (self.folder / "out1.mesh").read_bytes())
            self.done("smooth", "out1.mesh", "-o", "smooth.mesh", "--geometry", "channel.geom")
            self.require_on_inlet(read_mesh(str(self.folder / "smooth.mesh")), curve)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
