#!/usr/bin/env python3
"""`quadloop smooth --geometry`: which outlines fit a mesh, what is said of those that do not, and the table at its end.

    smooth_test.py QUADLOOP MPIRUN
"""
import json
import math
import sys
import unittest

from program import ProgramTest

CASE = '[geometry]\nfile = "body.geom"\nfar_field = 4\n[spacing]\nmin = 0.05\nmax = 0.5\n[boundary.body]\nspacing = 0.1\n[smooth]\nsweeps = 0\n'


def lens(shift=0.0, turned=False, name="body", digits=17):
    """Two arcs that meet in sharp tips, clockwise (the domain outside) or, turned, the other way."""
    arc = [(-1 + 2 * i / 40, 0.3 * math.sin(math.pi * i / 40)) for i in range(40)]
    points = arc + [(-x, -y) for x, y in arc]
    points = points[::-1] if turned else points
    return f"1\n{name}\n{len(points)}\n" + "".join(f"{x + shift:.{digits}g} {y:.{digits}g}\n" for x, y in points)


def nodes_of(mesh):
    rows = mesh.decode().splitlines()
    return [tuple(map(float, row.split())) for row in rows[2:2 + int(rows[1])]]


class SmoothAlongAnOutline(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("case.toml", CASE)
        self.write("body.geom", lens())
        self.done("mesh", "case.toml", "-o", "cut", "--geometry-out", "whole.geom", "--quiet")

    def smooth(self, *options, out="out.mesh", ranks=1):
        stdout, stderr = self.done("smooth", "cut.mesh", "-o", out, *options, ranks=ranks)
        return (self.folder / out).read_bytes(), stdout, stderr

    def assert_same_places(self, mesh, other):
        for (x, y), (u, v) in zip(nodes_of(mesh), nodes_of(other), strict=True):
            self.assertLess(math.hypot(x - u, y - v), 1e-9)

    def test_the_two_sides_of_a_crack_stay_together(self):
        """Six by four squares with a crack along y = 2 from x = 1 to 3, nodes doubled but for its ends, nodes beside it moved."""
        def node(i, j, upper=False):
            return 35 if upper and (i, j) == (2, 2) else 7 * j + i
        points = [(i + (0.8 if (i, j) == (2, 1) else -0.8 if (i, j) == (2, 3) else 0), j) for j in range(5) for i in range(7)] + [(2, 2)]
        cells = [[node(i, j, j == 2), node(i + 1, j, j == 2), node(i + 1, j + 1), node(i, j + 1)] for j in range(4) for i in range(6)]
        outer = [(node(i, 0), node(i + 1, 0)) for i in range(6)] + [(node(6, j), node(6, j + 1)) for j in range(4)]
        outer += [(node(i + 1, 4), node(i, 4)) for i in range(6)] + [(node(0, j + 1), node(0, j)) for j in range(4)]
        crack = [(node(2, 2), node(1, 2)), (node(3, 2), node(2, 2)), (node(1, 2), 35), (35, node(3, 2))]
        rows = lambda edges: "".join(f"3 {a} {b}\n" for a, b in edges)
        self.write("a.su2", f"NDIME= 2\nNELEM= {len(cells)}\n" + "".join("9 " + " ".join(map(str, c)) + "\n" for c in cells)
                   + f"NPOIN= {len(points)}\n" + "".join(f"{x} {y}\n" for x, y in points)
                   + f"NMARK= 2\nMARKER_TAG= outer\nMARKER_ELEMS= {len(outer)}\n" + rows(outer)
                   + f"MARKER_TAG= crack\nMARKER_ELEMS= {len(crack)}\n" + rows(crack))
        self.done("check", "a.su2")
        self.done("smooth", "a.su2", "-o", "b.su2", "--sweeps", "5")
        self.done("check", "b.su2")
        lines = (self.folder / "b.su2").read_text().split("\n")
        first = next(k for k, line in enumerate(lines) if line.startswith("NPOIN")) + 1
        moved = [tuple(map(float, line.split()[:2])) for line in lines[first:first + 36]]
        self.assertEqual(moved.count((2, 2)), 2)
        self.assertNotEqual(moved[node(2, 1)], points[node(2, 1)])

    def test_parallelograms_are_spared(self):
        self.done("mesh", "case.toml", "-o", "parallel", "--quiet", "--set", 'mesh.quads="parallel"')
        _, stderr = self.done("smooth", "parallel.mesh", "-o", "out.mesh", "--geometry", "whole.geom")
        said = json.loads(self.done("check", "out.mesh", "--json")[0])
        skew = round((1 - said["parallelogram_share"]) * said["quads"])
        self.assertLess(skew, 0.05 * said["quads"])
        self.assertEqual(f"out.mesh: {skew} of the {said['quads']} quads were parallelograms and no longer are" in stderr, skew > 0, stderr)

    def test_its_own_outline_in_silence(self):
        free, _, _ = self.smooth()
        along, _, stderr = self.smooth("--geometry", "whole.geom")
        self.assertEqual(stderr, "")
        self.assertNotEqual(along, free)

    def test_the_body_alone_whichever_way_it_runs(self):
        along, _, _ = self.smooth("--geometry", "whole.geom")
        for turned in (False, True):
            self.write("body.geom", lens(turned=turned))
            on_one, _, _ = self.smooth("--geometry", "body.geom")
            for ranks in (1, 2):
                alone, _, stderr = self.smooth("--geometry", "body.geom", ranks=ranks)
                self.assertEqual(alone, on_one)
                self.assert_same_places(alone, along)  # but for rounding on the far field
                self.assertEqual(stderr.count("warning"), 1, stderr)
                self.assertIn("body.geom: lacks these boundaries of the mesh: 'farfield'; nodes there slide only where it is straight", stderr)

    def test_a_rounded_outline(self):
        self.write("rounded.geom", lens(digits=4))
        _, _, stderr = self.smooth("--geometry", "rounded.geom")
        self.assertRegex(stderr, r"rounded.geom: \d+ of \d+ nodes of the boundary 'body' do not lie on the geometry, by up to .*e-05;")

    def test_outlines_that_do_not_fit(self):
        self.write("moved.geom", lens(shift=0.2))
        self.write("other.geom", lens(name="wing"))
        self.refused(1, ["moved.geom: the boundary 'body'", "its node (", "mesh --geometry-out"],
                     "smooth", "cut.mesh", "-o", "out.mesh", "--geometry", "moved.geom")
        self.refused(1, ["other.geom: has none of the mesh's boundaries, 'body', 'farfield', but 'wing'", "mesh --geometry-out"],
                     "smooth", "cut.mesh", "-o", "out.mesh", "--geometry", "other.geom")
        self.refused(1, ["no boundary farfield", "give the geometry that was meshed, as written by `mesh --geometry-out`"],
                     "check", "cut.mesh", "--geometry", "body.geom", "--quiet")
        self.assertFalse((self.folder / "out.mesh").exists())

    def test_the_table_tells_area_ratios_as_check_does(self):
        _, table, _ = self.smooth("--geometry", "whole.geom")
        rows = {line[:26].strip(): line[26:].split() for line in table.splitlines()}
        for column, mesh in enumerate(("cut.mesh", "out.mesh")):
            checked, _ = self.done("check", mesh)
            for name in ("largest area ratio", "area ratio, 99 %"):
                value = next(line.split()[-1] for line in checked.splitlines() if line.strip().startswith(name))
                self.assertAlmostEqual(float(rows[name][column]), float(value), places=3)

    def test_the_mesh_itself_may_be_overwritten(self):
        wanted, _, _ = self.smooth()
        self.done("smooth", "cut.mesh", "-o", "cut.mesh", "--quiet")
        self.assertEqual((self.folder / "cut.mesh").read_bytes(), wanted)


class Cascade:
    """A square of triangles with uneven nodes; those of its lower and upper side lie at the same x. A curve inside, in halves of its own or not."""

    def __init__(self, n=8):
        self.n = n
        shift = [[0.35 / n * math.sin(12.9898 * i + 78.233 * j) for i in range(n + 1)] for j in range(n + 1)]

        def place(i, j):
            sideways = shift[j % n][i] if 0 < i < n else 0
            upwards = shift[i][n - j] if 0 < j < n and j != n // 2 else 0
            return i / n + sideways, j / n + upwards
        self.points = [place(i, j) for j in range(n + 1) for i in range(n + 1)]
        self.triangles = []
        for j in range(n):
            for i in range(n):
                a, b, c, d = self.node(i, j), self.node(i + 1, j), self.node(i + 1, j + 1), self.node(i, j + 1)
                self.triangles += [(a, b, c), (a, c, d)]
        self.sides = {"low": [(self.node(i, 0), self.node(i + 1, 0)) for i in range(n)], "out": [(self.node(n, j), self.node(n, j + 1)) for j in range(n)],
                      "up": [(self.node(i + 1, n), self.node(i, n)) for i in range(n)], "in": [(self.node(0, j + 1), self.node(0, j)) for j in range(n)]}
        self.curve = [(self.node(i, n // 2), self.node(i + 1, n // 2)) for i in range(2, n - 2)]

    def node(self, i, j):
        return j * (self.n + 1) + i

    def su2(self):
        rows = [f"NDIME= 2\nNELEM= {len(self.triangles)}"] + [f"5 {a} {b} {c}" for a, b, c in self.triangles]
        rows += [f"NPOIN= {len(self.points)}"] + [f"{x!r} {y!r}" for x, y in self.points] + [f"NMARK= {len(self.sides)}"]
        for name, edges in self.sides.items():
            rows += [f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(edges)}"] + [f"3 {a} {b}" for a, b in edges]
        return "\n".join(rows) + "\n"

    def msh(self, curve=False, periodic=False):
        groups = dict(self.sides, **({"crack": self.curve} if curve else {}))
        rows = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", str(len(groups))] + [f'1 {k + 1} "{name}"' for k, name in enumerate(groups)]
        rows += ["$EndPhysicalNames\n$Nodes", str(len(self.points))] + [f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(self.points)]
        elements = [f"1 2 {k + 1} {k + 1} {a + 1} {b + 1}" for k, edges in enumerate(groups.values()) for a, b in edges]
        elements += [f"2 2 9 1 {a + 1} {b + 1} {c + 1}" for a, b, c in self.triangles]
        rows += ["$EndNodes\n$Elements", str(len(elements))] + [f"{k + 1} {row}" for k, row in enumerate(elements)] + ["$EndElements"]
        if periodic:
            pairs = [(self.node(i, self.n) + 1, self.node(i, 0) + 1) for i in range(self.n + 1)]
            rows += ["$Periodic\n2\n0 4 1", f"1\n{pairs[0][0]} {pairs[0][1]}", "1 3 1\nAffine 1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1", str(len(pairs))]
            rows += [f"{a} {b}" for a, b in pairs] + ["$EndPeriodic"]
        return "\n".join(rows) + "\n"


class NodesThatStay(ProgramTest):
    def setUp(self):
        super().setUp()
        self.cascade = Cascade()

    def smooth(self, name, *options, ranks=1):
        """The nodes that moved."""
        stdout, stderr = self.done("smooth", name, "-o", "out.mesh", *options, ranks=ranks)
        mesh = (self.folder / "out.mesh").read_bytes()
        moved = {k for k, (a, b) in enumerate(zip(self.cascade.points, nodes_of(mesh), strict=True)) if math.dist(a, b) > 1e-12}
        self.assertGreater(len(moved), 20)
        return moved, stderr, mesh

    def nodes(self, *names):
        groups = dict(self.cascade.sides, crack=self.cascade.curve)
        return {node for name in names for edge in groups[name] for node in edge}

    def test_boundaries_slide_and_fixed_ones_stay(self):
        self.write("a.msh", self.cascade.msh())
        free, _, _ = self.smooth("a.msh")
        for name in self.cascade.sides:
            self.assertTrue(free & self.nodes(name), name)
        moved, stderr, one = self.smooth("a.msh", "--fix", "low", "out")
        self.assertFalse(moved & self.nodes("low", "out"))
        self.assertTrue(moved & self.nodes("up") and moved & self.nodes("in"))
        self.assertEqual(self.smooth("a.msh", "--fix", "low", "out", ranks=3)[2], one)
        self.refused(1, ["--fix: a.msh has no boundary, inner curve or block 'lower'", "'low'"], "smooth", "a.msh", "-o", "out.mesh", "--fix", "lower")

    def test_periodic_sides_stay(self):
        self.write("a.su2", self.cascade.su2())
        self.write("a.msh", self.cascade.msh(periodic=True))
        self.write("plain.msh", self.cascade.msh())
        self.done("convert", "plain.msh", "polyMesh")
        boundary = self.folder / "polyMesh" / "boundary"
        text = boundary.read_text()
        for name, partner in (("low", "up"), ("up", "low")):
            head, tail = text.split(f"    {name}\n", 1)
            kind, tail = tail.split(";", 1)
            text = f"{head}    {name}\n{kind.rsplit(None, 1)[0]} cyclic; neighbourPatch {partner};{tail}"
        boundary.write_text(text)
        for name in ("a.su2", "a.msh", "polyMesh"):
            moved, stderr, _ = self.smooth(name)
            self.assertFalse(moved & self.nodes("low", "up"), name)
            self.assertTrue(moved & self.nodes("in"), name)
            self.assertIn(f"{name}: the nodes of 'low', 'up' are fixed", stderr)

    def test_inner_curves_stay_and_are_named(self):
        self.write("a.msh", self.cascade.msh(curve=True))
        moved, stderr, _ = self.smooth("a.msh")
        self.assertFalse(moved & self.nodes("crack"))
        self.assertTrue(moved & self.nodes("low"))
        self.assertIn("a.msh: the nodes of the inner curves 'crack' are fixed", stderr)
        self.assertRegex(stderr, "4 edges between two cells belong to inner lines, not to boundaries: .*crack")
        self.assertFalse(self.smooth("a.msh", "--fix", "crack", "in")[0] & self.nodes("in"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
