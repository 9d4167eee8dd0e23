#!/usr/bin/env python3
"""`quadloop check --geometry` accepts what `quadloop mesh` makes of outlines finer than its leaves: fractals, and seas full of islets.

    check_test.py QUADLOOP MPIRUN
"""
import cmath
import json
import math
import random
import unittest

from program import ProgramTest


def loop_text(name, points):
    return f"{name}\n{len(points)}\n" + "".join(f"{p.real!r} {p.imag!r}\n" for p in points)


def snowflake(depth, turn=0.0):
    """Koch's, counter-clockwise, in the unit circle."""
    points = [cmath.exp(1j * (math.tau * (k / 3 + 0.25) + turn)) for k in range(3)]
    for _ in range(depth):
        finer = []
        for a, b in zip(points, points[1:] + points[:1]):
            third = (b - a) / 3
            finer += [a, a + third, a + third + third * cmath.exp(-1j * math.pi / 3), a + 2 * third]
        points = finer
    return points


def rough_loop(rng, centre, radius, count):
    """An islet, clockwise."""
    angles = sorted((rng.random() * math.tau for _ in range(count)), reverse=True)
    return [centre + radius * rng.uniform(0.5, 1) * cmath.exp(1j * a) for a in angles]


def archipelago(seed):
    rng = random.Random(seed)
    loops = [loop_text("sea", [0j, 20 + 0j, 20 + 20j, 20j])]
    for x in range(1, 20):
        for y in range(1, 20):
            radius = 0.45 * rng.random() ** 4
            loops.append(loop_text(f"islet_{x}_{y}", rough_loop(rng, complex(x, y), max(radius, 0.005), rng.randint(8, 40))))
    return f"{len(loops)}\n" + "".join(loops)


class CheckAgrees(ProgramTest):
    def expect_agreement(self, geometry, smallest, largest, kind, sweeps):
        """Returns what `check` says beside the geometry that was given."""
        self.write("a.geom", geometry)
        self.write("a.toml", '[geometry]\nfile = "a.geom"\nvanish = "allow"\n'
                   f'[spacing]\nmin = {smallest}\nmax = {largest}\n[mesh]\ntype = "{kind}"\n[smooth]\nsweeps = {sweeps}\n')
        said = self.done("mesh", "a.toml", "-o", "m", "--geometry-out", "meshed.geom")[1]
        as_meshed = json.loads(self.done("check", "m.mesh", "--json", "--geometry", "meshed.geom")[0])
        self.assertEqual(as_meshed["loops_dropped"], 0)
        as_given = json.loads(self.done("check", "m.mesh", "--json", "--geometry", "a.geom")[0])
        self.assertEqual(as_given["loops_dropped"] > 0, "was dropped" in said)
        self.assertEqual(as_given["sharp_corners_lost"] > 0, "was dropped" in said or "no node of the mesh" in said)
        return as_given

    def test_fractals(self):
        box = loop_text("box", [-3 - 3j, 3 - 3j, 3 + 3j, -3 + 3j])
        for depth, turn, inside, parts in ((5, 0, True, 100), (6, 0, True, 100), (6, 0.1, True, 50), (6, 0, False, 300), (6, 0.1, False, 400)):
            for kind, sweeps in (("hybrid", 0), ("delaunay", 20)):
                with self.subTest(depth=depth, turn=turn, inside=inside, parts=parts, kind=kind):
                    flake = snowflake(depth, turn)
                    text = "1\n" + loop_text("flake", flake) if inside else "2\n" + box + loop_text("flake", flake[::-1])
                    extent = 2 if inside else 6
                    self.expect_agreement(text, extent / parts, extent / 20, kind, sweeps)

    def test_archipelagos(self):
        for seed, smallest, kind, sweeps in ((1, 0.15, "hybrid", 20), (2, 0.3, "hybrid", 0), (2, 0.3, "delaunay", 20)):
            with self.subTest(seed=seed, kind=kind):
                fit = self.expect_agreement(archipelago(seed), smallest, 2, kind, sweeps)
                self.assertGreater(fit["loops_dropped"], 100)

    def test_a_bay_behind_a_narrow_mouth(self):
        """The mouth crosses a leaf's side beside a kept corner, which took both crossings along, and the bay with them."""
        coast = [4.6j, 3.4 + 4.6j, 3.45 + 3.95j, 3.05 + 3.4j, 3.9 + 3.3j, 3.95 + 3.75j, 3.62 + 4.2j, 3.6 + 4.6j, 8 + 4.6j, 8 + 8j, 8j]
        self.write("bay.geom", "1\n" + loop_text("coast", coast))
        self.write("bay.toml", '[geometry]\nfile = "bay.geom"\n[spacing]\nmin = 1\nmax = 1\n[mesh]\nroot = [0, 0, 8, 1, 1]\n')
        self.assertEqual(self.done("mesh", "bay.toml")[1], "")
        self.assertEqual(json.loads(self.done("check", "bay.mesh", "--json", "--geometry", "bay.geom")[0])["sharp_corners_lost"], 0)

    def test_a_large_island_that_is_missing_is_a_fault(self):
        sea, rock = loop_text("sea", [0j, 40 + 0j, 40 + 40j, 40j]), loop_text("rock", [19 + 19j, 19 + 22j, 22 + 22j, 22 + 19j])
        self.expect_agreement("1\n" + sea, 0.25, 0.5, "hybrid", 0)
        self.write("more.geom", "2\n" + sea + rock)
        self.refused(1, ["a loop of boundary rock, 3 wide and 3 high, is not in the mesh, where cells are"], "check", "m.mesh", "--quiet",
                     "--geometry", "more.geom")

    def test_a_loop_that_runs_the_wrong_way_is_turned_as_in_mesh(self):
        self.write("turned.geom", "1\n" + loop_text("sea", [0j, 9j, 9 + 9j, 9 + 0j]))
        self.expect_agreement("1\n" + loop_text("sea", [0j, 9 + 0j, 9 + 9j, 9j]), 1, 2, "hybrid", 0)
        self.done("check", "m.mesh", "--geometry", "turned.geom")


if __name__ == "__main__":
    unittest.main(argv=["check_test.py"])
