#!/usr/bin/env python3
"""`quadloop morph`: the same cells on a changed outline, with layers, on any number of ranks; what it refuses.

    morph_test.py QUADLOOP MPIRUN
"""
import json
import math
import sys
import unittest

from program import ProgramTest

CASE = """[geometry]
file = "body.geom"
far_field = 4
[spacing]
min = 0.02
max = 0.5
[boundary.body]
spacing = 0.1
layers = { first = 1e-3, growth = 1.3, count = 6 }
[output]
formats = ["mesh"]
"""


def lens(camber=0.0, points=40, turned=False, cut=None):
    """Two arcs that meet in sharp tips, bent; clockwise, or the other way. `cut`: where a tip is cut off."""
    arc = [(-1 + 2 * i / points, 0.2 * math.sin(math.pi * i / points)) for i in range(points)]
    outline = [(x, y + camber * (1 - x * x)) for x, y in arc + [(-x, -y) for x, y in arc]]
    if cut is not None:
        outline = [(x, y) for x, y in outline if x < cut]
    outline = outline[::-1] if turned else outline
    return f"1\nbody\n{len(outline)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in outline)


def nodes_of(mesh):
    rows = mesh.decode().splitlines()
    return [tuple(map(float, row.split())) for row in rows[2:2 + int(rows[1])]]


class Morph(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("case.toml", CASE)
        self.write("body.geom", lens())
        self.mesh()

    def mesh(self, *options):
        self.done("mesh", "case.toml", "-o", "in", "--geometry-out", "old.geom", "--quiet", *options)

    def morph(self, text, *options, ranks=1):
        self.write("new.geom", text)
        stdout, stderr = self.done("morph", "in.mesh", "--geometry", "new.geom", "-o", "out.mesh", "--json", *options, ranks=ranks)
        self.assertEqual(stderr, "")
        return (self.folder / "out.mesh").read_bytes(), json.loads(stdout)

    def with_far_field(self, text):
        """The outline with the square that the mesh was made in."""
        far = (self.folder / "old.geom").read_text().partition("farfield")[1:]
        return "2" + text[1:] + "".join(far)

    def cells(self, mesh):
        return mesh.decode().split("\n", 2 + len(nodes_of(mesh)))[-1]

    def test_the_same_cells_on_the_new_outline(self):
        before = (self.folder / "in.mesh").read_bytes()
        for options in ([], ["--from", "body.geom"]):
            moved, said = self.morph(lens(0.1), *options)
            self.assertEqual(self.cells(moved), self.cells(before))
            self.assertFalse(said["smoothed"])
            self.assertGreater(said["largest_move"], 0.09)
            self.write("whole.geom", self.with_far_field(lens(0.1)))
            self.done("check", "out.mesh", "--geometry", "whole.geom")

    def test_layers_keep_their_heights(self):
        def heights():
            return [wall for wall in json.loads(self.done("check", name, "--json")[0])["layers"] if wall["boundary"] == "body"][0]
        name = "in.mesh"
        before = heights()
        self.morph(lens(0.1), "--from", "body.geom")
        name = "out.mesh"
        after = heights()
        self.assertEqual(before["columns"], after["columns"])
        for key in ("first", "thickness"):
            self.assertAlmostEqual(after[key][1] / before[key][1], 1, delta=1e-3, msg=f"the median {key}")

    def test_its_own_outline_moves_nothing(self):
        moved, said = self.morph(lens(), "--from", "body.geom")
        for (x, y), (u, v) in zip(nodes_of(moved), nodes_of((self.folder / "in.mesh").read_bytes()), strict=True):
            self.assertLess(math.hypot(x - u, y - v), 1e-12)

    def test_its_own_outline_keeps_every_bit_without_from(self):
        before = (self.folder / "in.mesh").read_bytes()
        whole = self.with_far_field(lens())
        for text in (lens(), lens(turned=True), whole):
            moved, said = self.morph(text)
            self.assertEqual(moved, before)
            self.assertEqual(said["nodes_moved"], 0)

    def test_its_own_outline_keeps_every_bit_where_a_base_or_a_corner_is_no_edge_of_the_mesh(self):
        def rounded(text):
            """With a point more on the base."""
            rows = text.splitlines()
            return "\n".join(rows[:2] + [str(int(rows[2]) + 1)] + rows[3:83] + ["0.9755 0.001"] + rows[83:]) + "\n"
        blunt = lens(points=80, cut=0.98)
        self.write("case.toml", "\n".join(line for line in CASE.splitlines() if "layers" not in line))
        for text in (blunt, rounded(blunt)):
            for options in ((), ("--set", "mesh.type=\"delaunay\""), ("--set", "mesh.mirror=\"x\"")):
                if options and "mirror" in options[1] and text != blunt:
                    continue
                self.write("body.geom", text)
                self.assertIn("the two ends became one node", self.done("mesh", "case.toml", "-o", "in", *options)[1])
                before = (self.folder / "in.mesh").read_bytes()
                for ranks in (1, 3):
                    self.assertEqual(self.morph(text, ranks=ranks)[0], before)

    def test_a_half_model_keeps_every_bit_on_its_whole_loop(self):
        blunt = lens(points=80, cut=0.98)
        self.write("case.toml", "\n".join(line for line in CASE.splitlines() if "layers" not in line))
        self.write("body.geom", blunt)
        self.mesh("--set", 'mesh.mirror="x"', "--set", 'mesh.half="axis"')
        before = (self.folder / "in.mesh").read_bytes()
        self.assertEqual({y for x, y in nodes_of(before) if x > 0.97 and abs(y) < 1e-3}, {0.0}, "the axis is straight")
        self.assertEqual(self.morph((self.folder / "old.geom").read_text())[0], before)
        self.refused(1, ["as that of a half model", "--geometry-out"], "morph", "in.mesh", "--geometry", "body.geom", "-o", "out.mesh")

    def test_a_flap_turns_as_it_does_with_from(self):
        """What lies ahead of the hinge stays."""
        hinge, slope = 0.4, math.tan(math.radians(15))

        def deflected(x, y):
            return x, y - slope * max(0, x - hinge)
        rows = lens().splitlines()
        flap = "\n".join(rows[:3] + ["{!r} {!r}".format(*deflected(*map(float, row.split()))) for row in rows[3:]]) + "\n"
        before = nodes_of((self.folder / "in.mesh").read_bytes())
        known, _ = self.morph(flap, "--from", "body.geom")
        moved, said = self.morph(flap)
        self.assertEqual(self.cells(moved), self.cells(known))
        on_body = {node for node, (x, y) in enumerate(before) if abs(x) <= 1 and abs(abs(y) - 0.2 * math.sin(math.pi * (x + 1) / 2)) < 2e-3}
        self.assertGreater(len(on_body), 40)
        for node, (old, a, b) in enumerate(zip(before, nodes_of(moved), nodes_of(known), strict=True)):
            self.assertLess(math.dist(a, b), 0.02)
            if node in on_body and old[0] < 0.35:
                self.assertLess(math.dist(a, old), 1e-9)
        self.assertEqual(self.morph(flap, ranks=3)[0], moved)

    def test_whichever_way_the_outline_runs_and_however_many_points_it_has(self):
        along, _ = self.morph(lens(0.1))
        other, _ = self.morph(lens(0.1, turned=True))
        fine, _ = self.morph(lens(0.1, points=80))
        for mesh, limit in ((other, 1e-12), (fine, 0.01)):
            for (x, y), (u, v) in zip(nodes_of(along), nodes_of(mesh), strict=True):
                self.assertLess(math.hypot(x - u, y - v), limit)

    def test_the_same_bytes_on_any_ranks(self):
        for kind in ("hybrid", "delaunay"):
            self.mesh("--type", kind)
            for text in (lens(0.1), lens(0.5)):  # as it comes, and smoothed
                one, said = self.morph(text)
                for ranks in (2, 3, 5):
                    self.assertEqual(self.morph(text, ranks=ranks)[0], one, f"{kind}, {ranks} ranks")
            self.assertTrue(said["smoothed"])

    def direction(self, text):
        """A table in which the camber of an outline grows, point by point."""
        points = [tuple(map(float, line.split())) for line in text.splitlines()[3:]]
        rows = [f"body,{x!r},{y!r},0,{1 - x * x!r}\n" for x, y in points]
        self.write("direction.csv", "boundary,x,y,dx,dy\n" + "".join(reversed(rows)))  # in any order

    def fields_of(self, mesh, names):
        """Rows of the solution at a native mesh's end, of these variables."""
        head, _, rows = mesh.decode().partition("#names: ")[2].partition("\n")
        columns = [head.split().index(name) for name in names]
        return [[float(row.split()[k]) for k in columns] for row in rows.splitlines()]

    def with_gradient(self, mesh):
        """A mesh with numbers in the place of an adjoint's dJ/dX."""
        plain = mesh.decode().partition("#Number of constants")[0]
        rows = [[math.sin(3 * x + y), math.cos(x - 2 * y)] for x, y in nodes_of(mesh)]
        text = "#Number of constants\n0\n#Number of variables\n2\n#names: dJ_dx dJ_dy\n" + "".join(f"{a!r} {b!r}\n" for a, b in rows)
        self.write("adjoint.mesh", plain + text)
        return rows

    def outline_gradient(self, ranks=1):
        self.done("morph", "in.mesh", "--geometry", "new.geom", "--from", "body.geom", "--nodal-gradient", "adjoint.mesh", "--outline-gradient",
                  "gradient.csv", ranks=ranks)
        return (self.folder / "gradient.csv").read_text()

    def test_velocities_are_what_differences_say(self):
        step = 1e-5
        back, ahead = (nodes_of(self.morph(lens(0.05 + h), "--from", "body.geom")[0]) for h in (-step, step))
        self.direction(lens(0.05))
        moved, said = self.morph(lens(0.05), "--from", "body.geom", "--direction", "direction.csv")
        velocities = self.fields_of(moved, ("dx_ds", "dy_ds"))
        for (x, y), (u, v), (dx, dy) in zip(back, ahead, velocities, strict=True):
            self.assertLess(math.hypot((u - x) / (2 * step) - dx, (v - y) / (2 * step) - dy), 1e-7)
        self.assertGreater(max(dy for dx, dy in velocities), 0.99)
        self.assertEqual(self.morph(lens(0.05), "--from", "body.geom", "--direction", "direction.csv", ranks=3)[0], moved)

    def test_gradients_of_nodes_become_those_of_points(self):
        self.direction(lens(0.05))
        moved, said = self.morph(lens(0.05), "--from", "body.geom", "--direction", "direction.csv")
        of_nodes = self.with_gradient(moved)
        gain = sum(a * dx + b * dy for (a, b), (dx, dy) in zip(of_nodes, self.fields_of(moved, ("dx_ds", "dy_ds")), strict=True))
        table = self.outline_gradient()
        lines = table.splitlines()
        self.assertEqual(lines[0], "boundary,x,y,dJ_dx,dJ_dy")
        rows = [list(map(float, line.split(",")[1:])) for line in lines[1:]]
        self.assertEqual([(x, y) for x, y, *_ in rows], [tuple(map(float, line.split())) for line in lens(0.05).splitlines()[3:]])
        self.assertAlmostEqual(sum((1 - x * x) * gy for x, y, gx, gy in rows) / gain, 1, delta=1e-10)
        for ranks in (2, 3, 5):
            self.assertEqual(self.outline_gradient(ranks), table, f"{ranks} ranks")

    def test_refusals_of_derivatives(self):
        self.write("new.geom", lens(0.05))
        self.direction(lens())
        morph = ["morph", "in.mesh", "--geometry", "new.geom", "-o", "out.mesh"]
        self.refused(1, ["direction.csv:2", "the geometry has no point"], *morph, "--from", "body.geom", "--direction", "direction.csv")
        self.direction(lens(0.05))
        self.refused(1, ["new.geom", "--from"], *morph, "--direction", "direction.csv")
        self.write("bad.csv", "boundary,x,y,dx,dy\nbody,0,0,1\n")
        self.refused(1, ["bad.csv:2", "no row of a point"], *morph, "--from", "body.geom", "--direction", "bad.csv")
        self.refused(2, ["require each other"], *morph, "--nodal-gradient", "in.mesh")
        morph += ["--from", "body.geom", "--outline-gradient", "gradient.csv", "--nodal-gradient"]
        self.refused(1, ["in.mesh", "without a solution"], *morph, "in.mesh")
        self.write("far.geom", lens(0.5))
        self.with_gradient((self.folder / "in.mesh").read_bytes())
        self.refused(1, ["far.geom", "had to be smoothed"], "morph", "in.mesh", "--geometry", "far.geom", "--from", "body.geom", "--nodal-gradient", "adjoint.mesh",
                     "--outline-gradient", "gradient.csv")
        self.assertFalse((self.folder / "gradient.csv").exists())

    def test_columns_of_a_direction_go_by_their_names(self):
        self.direction(lens(0.05))
        moved, said = self.morph(lens(0.05), "--from", "body.geom", "--direction", "direction.csv")
        rows = [line.split(",") for line in (self.folder / "direction.csv").read_text().splitlines()]
        table = "# by a script\n" + "".join(",".join((dy, x, name, y, dx)) + "\n" for name, x, y, dx, dy in rows)
        self.write("swapped.csv", table)
        self.assertEqual(self.morph(lens(0.05), "--from", "body.geom", "--direction", "swapped.csv")[0], moved)
        morph = ["morph", "in.mesh", "--geometry", "new.geom", "-o", "out.mesh", "--from", "body.geom", "--direction", "bad.csv"]
        for text, said in (
                ("", ["bad.csv: has no row of a point"]),
                ("boundary,x,y,dx,dy\n", ["bad.csv: has no row of a point"]),
                ("boundary,x,y,dx,dz\n", ["bad.csv:1", "'dz' is the name of no column", "boundary,x,y,dx,dy"]),
                ("boundary,x,y,dx\n", ["bad.csv:1", "there is no column 'dy'"]),
                ("boundary,x,y,dx,dx,dy\n", ["bad.csv:1", "two columns are named 'dx'"]),
                ("".join(",".join(row) + "\n" for row in rows[1:]), ["bad.csv:1", "'body' is the name of no column"]),
                ("boundary,x,y,dx,dy\nfarfield," + ",".join(rows[1][1:]) + "\n", ["bad.csv:2", "of boundary 'body', not of 'farfield'"])):
            self.write("bad.csv", text)
            self.refused(1, said, *morph)

    def test_no_input_is_written_over(self):
        self.write("new.geom", lens(0.05))
        self.direction(lens(0.05))
        self.with_gradient((self.folder / "in.mesh").read_bytes())
        morph = ["morph", "in.mesh", "--geometry", "new.geom", "--from", "body.geom", "--nodal-gradient", "adjoint.mesh", "--outline-gradient"]
        (self.folder / "link.geom").symlink_to("new.geom")
        for name in ("adjoint.mesh", "./adjoint.mesh", "in.mesh", "new.geom", "link.geom", "body.geom"):
            before = (self.folder / name).read_bytes()
            self.refused(2, [name, "overwritten"], *morph, name)
            self.assertEqual((self.folder / name).read_bytes(), before)
        self.refused(2, ["out.mesh", "overwritten"], *morph, "out.mesh", "-o", "out.mesh")
        self.refused(2, ["adjoint.mesh", "overwritten"], *morph, "gradient.csv", "-o", "adjoint.mesh")
        self.refused(2, ["--fields", "'a' is named twice"], *morph, "gradient.csv", "--fields", "a", "a")

    def test_refusals(self):
        self.write("cut.geom", lens(cut=0.9))
        self.refused(1, ["cut.geom", "'body'", "feature points and that of the mesh has"], "morph", "in.mesh", "--geometry", "cut.geom", "-o", "out.mesh")
        self.write("other.geom", lens().replace("body", "wing"))
        self.refused(1, ["other.geom", "'wing'"], "morph", "in.mesh", "--geometry", "other.geom", "-o", "out.mesh")
        self.write("far.geom", lens(camber=3.5))
        self.refused(1, ["in.mesh", "far.geom", "near (", "% of the movement"], "morph", "in.mesh", "--geometry", "far.geom", "-o", "out.mesh")
        self.refused(1, ["far.geom: the mesh's node (", "is not on boundary 'body'"], "morph", "in.mesh", "--geometry", "far.geom", "--from", "far.geom", "-o", "out.mesh")
        self.assertFalse((self.folder / "out.mesh").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
