#!/usr/bin/env python3
"""Meshes of domains with curves, from the case file to the mesh.

    curves_test.py QUADLOOP MPIRUN
"""
import itertools
import sys
import unittest
from pathlib import Path

from program import ProgramTest

sys.path.insert(0, str(Path(__file__).parents[1] / "judge"))
import judge  # noqa: E402
from mesh_files import read_geometry, read_mesh  # noqa: E402

# Where the east side, an arc, leaves the corner in the north-east, a triangle is thinner than the arc is off its chord: it is inverted when its nodes
# move onto the arc.
PLATE = """4
south open
2
0 0
2 0.16
east open
2
2 0.16 curve 1.724510951219321 0.8460485441300427 weights 1 0.9074814356997533 1
2.069336 1.5
north open
2
2.069336 1.5
-0.01 1.5
west open
2
-0.01 1.5 curve 0.38208836399001256 1.0025917002043778 -0.21727899007356158 0.4985736956217318
0 0
"""
CASE = """[geometry]
file = "plate.geom"
[spacing]
max = 0.25
curvature = 8
"""


class ThinCells(ProgramTest):
    def test_cells_that_moves_onto_a_curve_would_invert_are_built_on_shorter_chords(self):
        self.write("plate.geom", PLATE)
        self.write("case.toml", CASE)
        rebuilt = 0
        for kind, sweeps in itertools.product(("hybrid", "delaunay"), (0, 20)):
            with self.subTest(kind=kind, sweeps=sweeps):
                for ranks in (1, 3):
                    stdout, _ = self.done("mesh", "case.toml", "-o", f"on_{ranks}", "--type", kind, "--verbose", "--set", f"smooth.sweeps={sweeps}", ranks=ranks)
                for suffix in ("mesh", "tree.h5"):
                    self.assertEqual((self.folder / f"on_1.{suffix}").read_bytes(), (self.folder / f"on_3.{suffix}").read_bytes())
                faults = judge.judge(read_mesh(str(self.folder / "on_1.mesh")), delaunay=kind == "delaunay",
                                     geometry=read_geometry(str(self.folder / "plate.geom")), corners=True)
                self.assertEqual(faults, [])
                rebuilt += "trials" in stdout
        self.assertEqual(rebuilt, 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
