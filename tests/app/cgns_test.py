#!/usr/bin/env python3
"""CGNS as other programs read it: every boundary's BC points to a family, which says what it is; VTK's reader then shows them all.

    cgns_test.py QUADLOOP MPIRUN
"""
import shutil
import subprocess
import sys
import unittest

import h5py

from program import ProgramTest

CONDITIONS = {"a": ("wall", "BCWall"), "b": ("inflow", "BCInflow"), "c": ("symmetry", "BCSymmetryPlane"), "d": ("none", "UserDefined"),
              "farfield": ("farfield", "BCFarfield")}


def text_of(node):
    return bytes(node[" data"][()].astype("uint8")).decode().strip("\0 ")


class CgnsBoundaries(ProgramTest):
    def setUp(self):
        super().setUp()
        squares = [("a", -1, -1), ("b", 1, -1), ("c", 1, 1), ("d", -1, 1)]
        loops = [f"{name}\n4\n{x - .4} {y - .4}\n{x - .4} {y + .4}\n{x + .4} {y + .4}\n{x + .4} {y - .4}\n" for name, x, y in squares]
        self.write("a.geom", "4\n" + "".join(loops))
        tables = "".join(f'[boundary.{name}]\nbc = "{condition}"\n' for name, (condition, _) in CONDITIONS.items())
        self.write("a.toml", '[geometry]\nfile = "a.geom"\nfar_field = 3\n[spacing]\nmin = 0.2\nmax = 0.5\n[mesh]\nroot = [-3, -3, 6, 1, 1]\n' + tables)
        self.done("mesh", "a.toml", "-o", "m")
        self.path = str(self.folder / "m.cgns")

    def test_each_condition_stands_with_its_family(self):
        with h5py.File(self.path) as file:
            base = file["Base"]
            conditions = base["domain/ZoneBC"]
            self.assertEqual({name for name in conditions if name != " data"}, set(CONDITIONS))
            for name, (_, wanted) in CONDITIONS.items():
                self.assertEqual(text_of(conditions[name]), "FamilySpecified")
                self.assertEqual(text_of(conditions[name]["FamilyName"]), name)
                self.assertEqual(text_of(base[name]["FamBC"]), wanted)

    def test_we_read_the_conditions_back(self):
        """A mesh of all conditions goes through .cgns and comes out with the same families."""
        self.done("smooth", "m.cgns", "-o", "again.cgns", "--sweeps", "0")
        with h5py.File(self.folder / "again.cgns") as file:
            self.assertEqual({name: text_of(file["Base"][name]["FamBC"]) for name in CONDITIONS}, {n: c for n, (_, c) in CONDITIONS.items()})

    def test_vtk_shows_every_boundary(self):
        try:
            from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
        except ImportError:
            print("SKIPPED in cgns_test.py: python3-vtk9 is not installed, so nobody looks through VTK's reader", file=sys.stderr)
            self.skipTest("needs python3-vtk9")
        reader = vtkCGNSReader()
        reader.SetFileName(self.path)
        reader.UpdateInformation()
        reader.LoadBndPatchOn()
        reader.EnableAllBases()
        reader.EnableAllFamilies()
        reader.Update()
        zone = reader.GetOutput().GetBlock(0).GetBlock(0)
        patches = next(zone.GetBlock(i) for i in range(zone.GetNumberOfBlocks()) if zone.GetBlock(i).IsA("vtkMultiBlockDataSet"))
        shown = {patches.GetMetaData(i).Get(patches.NAME()): patches.GetBlock(i).GetNumberOfCells() for i in range(patches.GetNumberOfBlocks())
                 if patches.GetBlock(i) is not None}
        self.assertEqual(set(shown), set(CONDITIONS))
        self.assertTrue(all(cells > 0 for cells in shown.values()), shown)

    def test_cgnscheck_knows_the_solution(self):
        """Variables of the standard have its dimensions, or are said to have none."""
        nodes = int((self.folder / "m.mesh").read_text().split("\n")[1])
        names = "density x_velocity y_velocity pressure temperature mach x_momentum y_momentum Entropy"
        rows = nodes * ("1 " * len(names.split()) + "\n")
        self.write("s.mesh", (self.folder / "m.mesh").read_text() + f"#Number of constants\n0\n#Number of variables\n9\n#names: {names}\n{rows}")
        self.done("convert", "s.mesh", "s.cgns", "-q")
        self.done("extrude", "s.mesh", "-o", "solid.cgns", "--layers", "1", "--thickness", "1", "-q")
        with h5py.File(self.folder / "s.cgns") as file:
            solution = file["Base/domain/FlowSolution"]
            exponents = lambda name: solution[name]["DimensionalExponents"][" data"][()].tolist()
            self.assertEqual((exponents("Density"), exponents("VelocityX")), ([1, -3, 0, 0, 0], [0, 1, -1, 0, 0]))
            self.assertEqual(text_of(solution["Mach/DataClass"]), "NondimensionalParameter")
        if not shutil.which("cgnscheck"):
            self.skipTest("needs cgnscheck")
        for name in ("s.cgns", "solid.cgns"):
            said = subprocess.run(["cgnscheck", name], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertNotRegex(said.stdout + said.stderr, "WARNING|ERROR")

    def test_names_of_variables_that_do_not_fit(self):
        text = (self.folder / "m.mesh").read_text()
        long = 40 * "y"
        rows = int(text.split("\n")[1]) * "1 2\n"
        self.write("s.mesh", f"{text}#Number of constants\n0\n#Number of variables\n2\n#names: {long} GridLocation\n{rows}")
        for command in (("convert", "s.mesh", "s.cgns"), ("extrude", "s.mesh", "-o", "solid.cgns", "--layers", "1", "--thickness", "1")):
            self.assertIn(f"2 variables are renamed, as this format cannot hold every name; the first, '{long}', is '{long[:32]}' there",
                          self.done(*command)[1])
        self.done("convert", "s.cgns", "back.mesh", "-q")
        self.assertIn(f"#names: {long} GridLocation\n", (self.folder / "back.mesh").read_text())

    def test_parts_hold_their_numbers(self):
        """The same as their .links files tell."""
        self.done("convert", "m.cgns", "p.cgns", "--parts", "3", "-q")
        for number in (1, 2, 3):
            links = (self.folder / f"p.part_000{number}.links").read_text().splitlines()
            rows = iter([[int(word) for word in line.split()] for line in links if not line.startswith("#")])
            column = lambda: [next(rows) for _ in range(next(rows)[0])]
            with h5py.File(self.folder / f"p.part_000{number}.cgns") as file:
                part = file["Base/domain/Part"]
                numbers = lambda name: part[name][" data"][()].tolist()
                self.assertEqual(numbers("Number"), next(rows))
                nodes = column()
                self.assertEqual(numbers("GlobalNodeNumber"), [node for node, _ in nodes])
                self.assertEqual(numbers("NodeOwner"), [owner for _, owner in nodes])
                for name in ("GlobalTriangleNumber", "GlobalQuadNumber"):
                    self.assertEqual(numbers(name), [cell for (cell,) in column()])
                for _ in range(next(rows)[0]):
                    column()
                for _ in range(next(rows)[0]):
                    other, shared = next(rows)
                    self.assertEqual(numbers(f"part_000{other}/SharedNodes"), [next(rows)[0] for _ in range(shared)])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
