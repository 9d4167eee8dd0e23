#!/usr/bin/env python3
"""Other programs read our 3D meshes, and plane ones in their formats: the same counts, patches by their names. What is not installed is skipped, with the reason.

    extrude_readers_test.py QUADLOOP MPIRUN CASES
"""
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from convert_test import TWO_BLOCKS
from program import ProgramTest

CASES = Path(sys.argv[3]).resolve()
FOAM = "/usr/share/openfoam"
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1;
"""
SCHEMES = """FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }
ddtSchemes{} gradSchemes{} divSchemes{} laplacianSchemes{} interpolationSchemes{} snGradSchemes{}
"""


def module(name):
    try:
        return __import__(name)
    except ImportError:
        return None


def program(name):
    return unittest.skipUnless(shutil.which(name), f"{name} is not installed")


class Readers(ProgramTest):
    def extruded(self, output, layers=2, case="naca0012", axis="z"):
        self.done("mesh", str(CASES / case / "case.toml"), "-o", case, "-q")
        (self.folder / output).parent.mkdir(parents=True, exist_ok=True)
        self.done("extrude", f"{case}.mesh", "-o", output, "--layers", str(layers), "--thickness", "0.2", "--axis", axis, "-q")
        lines = (self.folder / f"{case}.mesh").read_text().split("\n")
        number = {title: int(lines[lines.index(title) + 1]) for title in
                  ("#Number of grid points", "#Number of triangular elements", "#Number of quadrilateral elements")}
        nodes, triangles, quads = number.values()
        return (layers + 1) * nodes, layers * triangles, layers * quads

    def tool(self, *command, **options):
        return subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options).stdout

    @program("checkMesh")
    def test_openfoam_finds_nothing_wrong(self):
        for case in ("naca0012", "three_element", "ring", "naca0012_layers"):
            for layers in (1, 2):
                with self.subTest(case=case, layers=layers):
                    nodes, prisms, hexahedra = self.extruded(f"{case}{layers}/constant/polyMesh", layers, case)
                    (self.folder / f"{case}{layers}/system").mkdir()
                    for name, text in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", SCHEMES.replace("fvSchemes", "fvSolution"))):
                        self.write(f"{case}{layers}/system/{name}", text)
                    said = self.tool("checkMesh", "-case", f"{case}{layers}", env={**os.environ, "WM_PROJECT_DIR": FOAM})
                    complaints = [line for line in said.split("\n") if line.lstrip().startswith("***") and "aspect ratio" not in line]
                    self.assertEqual(complaints, [], said)
                    if case != "naca0012_layers":
                        self.assertIn("Mesh OK.", said)
                    found = {key: int(re.search(rf"{key}:\s+(\d+)", said)[1]) for key in ("points", "prisms", "hexahedra")}
                    self.assertEqual(found, {"points": nodes, "prisms": prisms, "hexahedra": hexahedra})
                    for patch in ("back", "front"):
                        self.assertRegex(said, rf"\n\s+{patch}\s+\d+")

    def foam_case(self, name):
        (self.folder / name / "system").mkdir(parents=True)
        (self.folder / name / "constant").mkdir()
        for file, text in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", SCHEMES.replace("fvSchemes", "fvSolution"))):
            self.write(f"{name}/system/{file}", text)

    def check_foam(self, name):
        """What checkMesh counts in a mesh with which it is content."""
        said = self.tool("checkMesh", "-case", name, env={**os.environ, "WM_PROJECT_DIR": FOAM})
        self.assertIn("Mesh OK.", said)
        return {key: int(re.search(rf"{key}:\s+(\d+)", said)[1]) for key in ("points", "prisms", "hexahedra")}, said

    def plane(self):
        """A mesh with conditions, and what it is drawn out by one layer."""
        nodes, prisms, hexahedra = self.extruded("a.vtu", layers=1)
        return {"points": nodes, "prisms": prisms, "hexahedra": hexahedra}

    @program("checkMesh")
    def test_openfoam_reads_a_converted_plane_mesh(self):
        wanted = self.plane()
        self.foam_case("plane")
        self.done("convert", "naca0012.cgns", "plane/constant/polyMesh", "-q")
        found, said = self.check_foam("plane")
        self.assertEqual(found, wanted)
        self.assertRegex(said, r"\n\s+airfoil\s+\d+")
        self.foam_case("solid")  # and one that went through another format of three dimensions
        self.done("convert", "a.vtu", "solid/constant/polyMesh", "-q")
        self.assertEqual(self.check_foam("solid")[0], wanted)

    @program("fluentMeshToFoam")
    def test_fluent_files_come_through_openfoam(self):
        wanted = self.plane()
        self.done("convert", "naca0012.cgns", "a.fluent.msh", "-q")
        for name, options in (("thick", ()), ("thin", ("-2D", "0.1"))):
            self.foam_case(name)
            self.tool("fluentMeshToFoam", "-case", name, *options, "a.fluent.msh", env={**os.environ, "WM_PROJECT_DIR": FOAM})
            self.assertEqual(self.check_foam(name)[0], wanted)
            boundary = (self.folder / name / "constant/polyMesh/boundary").read_text()
            self.assertRegex(boundary, r"airfoil\s*{\s*type\s+wall;")
            self.done("convert", f"{name}/constant/polyMesh", "back.cgns", "-q")
            self.done("check", "back.cgns", "-q")
            table = self.done("convert", "back.cgns", "back.mesh")[0]
            self.assertRegex(table, rf"nodes +{wanted['points'] // 2}\n")
            self.assertIn("(airfoil)", (self.folder / "back.mesh").read_text())

    @program("fluent3DMeshToFoam")
    def test_openfoam_reads_fluent_files_of_three_dimensions(self):
        nodes, prisms, hexahedra = self.extruded("a.fluent.msh")
        self.foam_case("solid")
        self.tool("fluent3DMeshToFoam", "-case", "solid", "a.fluent.msh", env={**os.environ, "WM_PROJECT_DIR": FOAM})
        self.assertEqual(self.check_foam("solid")[0], {"points": nodes, "prisms": prisms, "hexahedra": hexahedra})
        self.tool("foamMeshToFluent", "-case", "solid", env={**os.environ, "WM_PROJECT_DIR": FOAM})  # and we what it writes
        table = self.done("check", "solid/fluentInterface/solid.msh")[0]
        self.assertRegex(table, rf"(?s)nodes +{nodes}\n.*prisms +{prisms}\n.*hexahedra +{hexahedra}\n.*airfoil +\d+")

    @program("checkMesh")
    def test_openfoam_finds_the_zones_of_blocks(self):
        self.write("two.mesh", TWO_BLOCKS)
        for name, layers in (("flat", "1"), ("thick", "2")):
            self.foam_case(name)
            self.done("extrude", "two.mesh", "-o", f"{name}/constant/polyMesh", "--layers", layers, "--thickness", "0.5", "-q")
            said = self.check_foam(name)[1]
            for zone, cells in (("block_1", 2), ("block_2", 1)):
                self.assertRegex(said, rf"\n\s+{zone}\s+{cells * int(layers)}\s")

    @unittest.skipUnless(module("vtk"), "python3-vtk9 is not installed")
    def test_vtk_reads_fluent_files(self):
        import vtk
        wanted = self.plane()
        self.done("convert", "naca0012.cgns", "a.fluent.msh", "-q")
        vtk.vtkObject.GlobalWarningDisplayOff()  # it misses a file of results
        reader = vtk.vtkFLUENTReader()
        reader.SetFileName(str(self.folder / "a.fluent.msh"))
        reader.Update()
        grid = reader.GetOutput().GetBlock(0)
        self.assertEqual(grid.GetNumberOfCells(), wanted["prisms"] + wanted["hexahedra"])
        areas = [grid.GetCell(c).ComputeArea() if grid.GetCellType(c) == 5 else 1 for c in range(grid.GetNumberOfCells())]
        self.assertGreater(min(areas), 0)

    @unittest.skipUnless(module("vtk"), "python3-vtk9 is not installed")
    def test_vtk_reads_fluent_files_of_three_dimensions(self):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
        nodes, prisms, hexahedra = self.extruded("a.fluent.msh")
        vtk.vtkObject.GlobalWarningDisplayOff()
        reader = vtk.vtkFLUENTReader()
        reader.SetFileName(str(self.folder / "a.fluent.msh"))
        reader.Update()
        grid = reader.GetOutput().GetBlock(0)
        types = vtk_to_numpy(grid.GetCellTypesArray())
        self.assertEqual((grid.GetNumberOfPoints(), (types == 13).sum(), (types == 12).sum()), (nodes, prisms, hexahedra))
        size = vtk.vtkCellSizeFilter()
        size.SetInputData(grid)
        size.Update()
        volumes = vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume"))
        self.assertGreater(volumes[types == 12].min(), 0)
        # VTK 9.1 makes every wedge of such a file inside out, of what OpenFOAM writes too.
        self.assertLess(volumes[types == 13].max(), 0)

    @program("gmsh")
    def test_gmsh_reads_three_dimensions(self):
        nodes, prisms, hexahedra = self.extruded("a.msh")
        said = self.tool("gmsh", "-check", "a.msh")
        self.assertIn(f"{nodes} nodes", said)
        self.assertNotRegex(said, "Error|Warning")
        self.tool("gmsh", "a.msh", "-0", "-format", "msh41", "-o", "b.msh")
        self.assertTrue((self.folder / "b.msh").read_text().startswith("$MeshFormat\n4.1"))
        for source in ("a.msh", "naca0012.mesh"):  # of three dimensions and of two
            self.done("convert", source, "new.msh", "--format", "msh41", "-q")
            said = self.tool("gmsh", "-check", "new.msh")
            self.assertNotRegex(said, "Error|Warning")
            self.tool("gmsh", "new.msh", "-0", "-format", "msh22", "-o", "old.msh")
            self.assertIn('"airfoil"', (self.folder / "old.msh").read_text())
            self.done("check", "new.msh", "-q")
        table = self.done("check", "b.msh")[0]  # Gmsh puts elements in an order of its own
        self.assertRegex(table, rf"(?s)nodes +{nodes}\n.*prisms +{prisms}\n.*hexahedra +{hexahedra}\n.*airfoil +\d+")

    @unittest.skipUnless(module("vtk"), "python3-vtk9 is not installed")
    def test_vtk_reads_cells_and_patches(self):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
        nodes, prisms, hexahedra = self.extruded("a.vtu")
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.folder / "a.vtu"))
        reader.Update()
        grid = reader.GetOutput()
        types = vtk_to_numpy(grid.GetCellTypesArray()).tolist()
        self.assertEqual((grid.GetNumberOfPoints(), types.count(13), types.count(12)), (nodes, prisms, hexahedra))
        names = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("boundary_names"))).decode().split("\0")[:-1]
        self.assertEqual(names[-2:], ["back", "front"])
        patch = vtk_to_numpy(grid.GetCellData().GetArray("boundary"))
        self.assertEqual((patch == len(names)).sum() * 2, prisms + hexahedra)
        quality = vtk.vtkCellSizeFilter()
        quality.SetInputData(grid)
        quality.Update()
        volumes = vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Volume"))[patch == 0]
        self.assertGreater(volumes.min(), 0)

    @unittest.skipUnless(module("vtk"), "python3-vtk9 is not installed")
    def test_vtk_reads_pieces_and_writes_them(self):
        import numpy
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        wanted = self.plane()
        self.done("convert", "naca0012.cgns", "a.pvtu", "-q")
        reader = vtk.vtkXMLPUnstructuredGridReader()
        reader.SetFileName(str(self.folder / "a.pvtu"))
        reader.Update()
        grid = reader.GetOutput()
        self.assertEqual(grid.GetNumberOfPoints(), wanted["points"] // 2)
        boundary = vtk_to_numpy(grid.GetCellData().GetArray("boundary"))
        part = numpy.where(boundary == 0, numpy.arange(len(boundary)) * 3 // len(boundary), -1)  # cells alone, in three pieces
        array = numpy_to_vtk(part, deep=True)
        array.SetName("part")
        grid.GetCellData().AddArray(array)
        names = []
        for n in range(3):
            cells = vtk.vtkThreshold()
            cells.SetInputData(grid)
            cells.SetInputArrayToProcess(0, 0, 0, 1, "part")
            cells.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_BETWEEN)
            cells.SetLowerThreshold(n)
            cells.SetUpperThreshold(n)
            writer = vtk.vtkXMLUnstructuredGridWriter()
            names.append(f"part_{n}.vtu")
            writer.SetFileName(str(self.folder / names[-1]))
            writer.SetInputConnection(cells.GetOutputPort())
            writer.SetDataModeToAppended()
            writer.EncodeAppendedDataOff()
            writer.Write()
        self.write("parts.pvtu", "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>" +
                   "".join(f"<Piece Source=\"{name}\"/>" for name in names) + "</PUnstructuredGrid></VTKFile>")
        table = self.done("convert", "parts.pvtu", "back.cgns")[0]
        self.assertRegex(table, rf"(?s)nodes +{wanted['points'] // 2}\n.*triangles +{wanted['prisms']}\n.*quads +{wanted['hexahedra']}\n")
        self.done("check", "back.cgns", "-q")

    @unittest.skipUnless(module("meshio"), "python3-meshio is not installed")
    def test_meshio_finds_boundaries_by_name(self):
        import meshio
        self.extruded("a.vtu")
        self.done("convert", "naca0012.mesh", "plane.vtu", "-q")
        for name, dimension in (("a.vtu", 2), ("plane.vtu", 1)):
            mesh = meshio.read(self.folder / name)
            self.assertEqual(mesh.field_data["airfoil"].tolist(), [1, dimension])

    @unittest.skipUnless(module("meshio"), "python3-meshio is not installed")
    def test_meshio_reads_vtu_su2_and_ugrid(self):
        import meshio
        for name in ("a.vtu", "a.su2", "a.b8.ugrid", "a.lb8.ugrid"):
            with self.subTest(name=name):
                nodes, prisms, hexahedra = self.extruded(name)
                mesh = meshio.read(self.folder / name)
                counts = {}
                for block in mesh.cells:
                    counts[block.type] = counts.get(block.type, 0) + len(block.data)
                self.assertEqual((len(mesh.points), counts["wedge"], counts["hexahedron"]), (nodes, prisms, hexahedra))

    @program("cgnscheck")
    def test_cgnscheck_finds_no_error(self):
        nodes, prisms, hexahedra = self.extruded("a.cgns", axis="y")
        said = self.tool("cgnscheck", "-v", "a.cgns")
        self.assertNotIn("ERROR", said)
        self.assertIn(f"Vertex Size=[{nodes}]", said)
        self.assertIn(f"Cell Size=[{prisms + hexahedra}]", said)
        for name in ("airfoil", "back", "front", "PENTA_6", "HEXA_8"):
            self.assertIn(name, said)


if __name__ == "__main__":
    unittest.main(argv=["extrude_readers_test.py"])
