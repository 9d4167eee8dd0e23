#!/usr/bin/env python3
"""A table: every format that other programs read, of two and of three dimensions, with each program that reads it. Counts are equal, boundaries have their
names, values of nodes and cells are there. What is not installed is skipped, with the reason; the rest of what those programs do is in extrude_readers_test.py.

    readers_test.py QUADLOOP MPIRUN
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

from convert_test import GEOMETRY
from program import ProgramTest

CASE = """[geometry]
file = "a.geom"
[spacing]
min = 0.25
max = 1
[boundary.my-wall]
bc = "wall"
[boundary.box]
bc = "farfield"
[output]
formats = ["cgns"]
"""
NAMES = {"box", "my-wall"}
LAYERS = 2
FOAM = "/usr/share/openfoam"
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1;
"""
SCHEMES = """FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }
ddtSchemes{} gradSchemes{} divSchemes{} laplacianSchemes{} interpolationSchemes{} snGradSchemes{}
"""


def has_module(name):
    try:
        __import__(name)
    except ImportError:
        return False
    return True


def with_values(mesh):
    """A native mesh with a variable at nodes and one in cells."""
    lines = mesh.split("\n")
    number = lambda title: int(lines[lines.index(title) + 1])
    nodes, cells = number("#Number of grid points"), number("#Number of triangular elements") + number("#Number of quadrilateral elements")
    rows = lambda count: "".join(f"{(i + 1) / 7!r}\n" for i in range(count))
    return (mesh + "#Number of constants\n0\n#Number of variables\n1\n#names: density\n" + rows(nodes) +
            "#Number of cell variables\n1\n#names: pressure\n" + rows(cells)), nodes, number("#Number of triangular elements"), cells


# Of meshes of two dimensions and of three: who reads each format, and what that needs.
IN_BOTH = {
    "vtu": {"vtk": "vtk", "meshio": "meshio"},
    "pvtu": {"vtk": "vtk"},
    "vtkhdf": {"vtk_hdf": "vtk"},
    "cgns": {"vtk_cgns": "vtk", "cgnscheck": "cgnscheck"},
    "su2": {"meshio": "meshio"},
    "msh": {"gmsh": "gmsh", "meshio": "meshio"},
    "msh41": {"gmsh": "gmsh"},
}


class Readers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.geom", GEOMETRY)
        self.write("case.toml", CASE)
        self.done("mesh", "case.toml", "-o", "a", "-q")
        self.done("convert", "a.cgns", "a.mesh", "-q")
        text, self.nodes, self.triangles, self.cells = with_values((self.folder / "a.mesh").read_text())
        self.write("s.mesh", text)
        self.done("convert", "s.mesh", "s.cgns", "-q")
        (self.folder / "case/constant").mkdir(parents=True)
        (self.folder / "case/system").mkdir()
        for name, control in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", SCHEMES.replace("fvSchemes", "fvSolution"))):
            self.write(f"case/system/{name}", control)

    # The programs: each gives {"nodes": n, "cells": n, "names": set, "values": set} of a file, as far as it tells.

    def vtk(self, name):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
        reader = vtk.vtkXMLPUnstructuredGridReader() if name.endswith("pvtu") else vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        grid = reader.GetOutput()
        cells = grid.GetCellData()
        inside = int((vtk_to_numpy(cells.GetArray("boundary")) == 0).sum())
        arrays = lambda data: {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())} - {"boundary"}
        found = {"nodes": grid.GetNumberOfPoints(), "cells": inside, "values": arrays(grid.GetPointData()) | arrays(cells)}
        if grid.GetFieldData().GetArray("boundary_names") is not None:  # a list of pieces has none
            found["names"] = set(bytes(vtk_to_numpy(grid.GetFieldData().GetArray("boundary_names"))).decode().split("\0")[:-1])
        return found

    def vtk_hdf(self, name):
        from vtkmodules.vtkIOHDF import vtkHDFReader
        from vtk.util.numpy_support import vtk_to_numpy
        reader = vtkHDFReader()
        reader.SetFileName(str(self.folder / name))
        self.assertTrue(reader.CanReadFile(str(self.folder / name)))
        reader.Update()
        grid = reader.GetOutputDataObject(0)
        cells, names = grid.GetCellData(), grid.GetFieldData().GetAbstractArray("boundary_names")
        arrays = lambda data: {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())} - {"boundary"}
        return {"nodes": grid.GetNumberOfPoints(), "cells": int((vtk_to_numpy(cells.GetArray("boundary")) == 0).sum()),
                "values": arrays(grid.GetPointData()) | arrays(cells), "names": {names.GetValue(i) for i in range(names.GetNumberOfValues())}}

    def vtk_cgns(self, name):
        from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
        reader = vtkCGNSReader()
        reader.SetFileName(str(self.folder / name))
        reader.UpdateInformation()
        reader.LoadBndPatchOn()
        reader.EnableAllBases()
        reader.EnableAllFamilies()
        reader.EnableAllPointArrays()
        reader.Update()
        zone = reader.GetOutput().GetBlock(0).GetBlock(0)
        blocks = [zone.GetBlock(i) for i in range(zone.GetNumberOfBlocks())]
        grid = next(block for block in blocks if not block.IsA("vtkMultiBlockDataSet"))
        patches = next(block for block in blocks if block.IsA("vtkMultiBlockDataSet"))
        names = {patches.GetMetaData(i).Get(patches.NAME()) for i in range(patches.GetNumberOfBlocks())}
        return {"nodes": grid.GetNumberOfPoints(), "cells": grid.GetNumberOfCells(), "names": names}

    def vtk_fluent(self, name):
        import vtk
        vtk.vtkObject.GlobalWarningDisplayOff()  # it misses a file of results
        reader = vtk.vtkFLUENTReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        return {"cells": reader.GetOutput().GetBlock(0).GetNumberOfCells()}

    def meshio(self, name):
        import meshio
        mesh = meshio.read(self.folder / name)
        kinds = {"triangle", "quad"} if name.startswith("plane") else {"wedge", "hexahedron"}
        found = {"nodes": len(mesh.points), "cells": sum(len(block.data) for block in mesh.cells if block.type in kinds)}
        if name.endswith((".vtu", ".msh", ".msh41")):
            found["names"] = set(mesh.field_data) - {"domain", "boundary_names"}
        if name.endswith(".vtu"):
            found["values"] = (set(mesh.point_data) | set(mesh.cell_data)) - {"boundary"}
        return found

    def tool(self, *command, **options):
        return subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options).stdout

    def gmsh(self, name):
        path = self.folder / name
        if path.suffix == ".msh41":
            path = path.rename(path.with_suffix(".msh"))
        self.assertNotRegex(self.tool("gmsh", "-check", path.name), "Error|Warning")
        said = self.tool("gmsh", path.name, "-0", "-format", "msh22", "-o", "again.msh")
        self.assertNotRegex(said, "Error|Warning")
        text = (self.folder / "again.msh").read_text()
        kinds = {"2", "3"} if name.startswith("plane") else {"6", "5"}
        elements = text.split("$Elements\n")[1].split("$EndElements")[0].split("\n")[1:-1]
        return {"nodes": int(text.split("$Nodes\n")[1].split("\n")[0]), "cells": sum(line.split()[1] in kinds for line in elements),
                "names": set(re.findall(r'"(.*)"', text.split("$EndPhysicalNames")[0])) - {"domain"}}

    def cgnscheck(self, name):
        said = self.tool("cgnscheck", "-v", name)
        self.assertNotIn("ERROR", said)
        number = lambda what: int(re.search(rf"{what} Size=\[(\d+)\]", said)[1])
        return {"nodes": number("Vertex"), "cells": number("Cell"), "names": set(re.findall(r'checking BC "(.*)"', said))}

    def check_mesh(self, name):
        shutil.rmtree(self.folder / "case/constant/polyMesh", ignore_errors=True)
        shutil.move(self.folder / name, self.folder / "case/constant/polyMesh")
        return self.check_case(name)

    def fluent_foam(self, name):
        shutil.rmtree(self.folder / "case/constant/polyMesh", ignore_errors=True)
        self.tool("fluent3DMeshToFoam", "-case", "case", name, env={**os.environ, "WM_PROJECT_DIR": FOAM})
        return self.check_case(name)

    def check_case(self, name):
        said = self.tool("checkMesh", "-case", "case", env={**os.environ, "WM_PROJECT_DIR": FOAM})
        self.assertIn("Mesh OK.", said)
        number = lambda key: int(re.search(rf"\n\s+{key}:\s+(\d+)", said)[1])
        return {"nodes": number("points") // (2 if name.startswith("plane") else 1), "cells": number("cells"),
                "names": set(re.findall(r"\n\s+([\w-]+)\s+\d+\s+\d+\s+ok", said))}

    def compare(self, found, wanted, label):
        for key, value in found.items():
            if key == "values":
                self.assertLessEqual({"density", "pressure"}, value, label)
            elif key == "names":
                self.assertEqual({re.sub(r"[^\w-]", "_", one) for one in value}, wanted["names"], label)
            else:
                self.assertEqual(value, wanted[key], label)

    def go_through(self, table, stem, make, wanted):
        """`make(format)` writes `stem`.format; each of the table's programs that are here reads it."""
        for format, programs in table.items():
            for program, needed in programs.items():
                with self.subTest(format=format, program=program):
                    present = has_module(needed) if needed in ("vtk", "meshio") else shutil.which(needed)
                    if not present:
                        self.skipTest(f"{needed} is not installed")
                    name = f"{stem}.{format}"
                    make(name)
                    self.compare(getattr(self, program)(name), wanted, f"{format} by {program}")

    def test_two_dimensions(self):
        table = {
            **IN_BOTH,
            "fluent.msh": {"vtk_fluent": "vtk"},
        }
        wanted = {"nodes": self.nodes, "cells": self.cells, "names": NAMES}
        self.go_through(table, "plane", lambda name: self.done("convert", "s.cgns", name, "-q"), wanted)
        self.go_through({"polyMesh": {"check_mesh": "checkMesh"}}, "plane", lambda name: self.done("convert", "s.cgns", name, "-q"),
                        {**wanted, "names": NAMES | {"back", "front"}})

    def test_three_dimensions(self):
        table = {
            **IN_BOTH,
            "fluent.msh": {"vtk_fluent": "vtk", "fluent_foam": "fluent3DMeshToFoam"},
            "b8.ugrid": {"meshio": "meshio"},
            "lb8.ugrid": {"meshio": "meshio"},
            "polyMesh": {"check_mesh": "checkMesh"},
        }
        wanted = {"nodes": (LAYERS + 1) * self.nodes, "cells": LAYERS * self.cells, "names": NAMES | {"back", "front"}}
        extrude = lambda name: self.done("extrude", "s.cgns", "-o", name, "--layers", str(LAYERS), "--thickness", "0.5", "-q")
        self.go_through(table, "solid", extrude, wanted)

    @unittest.skipUnless(has_module("vtk"), "python3-vtk9 is not installed")
    def test_parts(self):
        """VTK has the nodes of all pieces one after another; each piece counts its own boundaries."""
        self.done("convert", "s.cgns", "p.vtu", "--parts", "3", "-q")
        found = self.vtk("p.pvtu")
        self.assertEqual(found["cells"], self.cells)
        self.assertLessEqual({"density", "pressure"}, found["values"])
        pieces = [self.vtk(f"p.part_000{number}.vtu") for number in (1, 2, 3)]
        self.assertEqual(sum(piece["cells"] for piece in pieces), self.cells)
        self.assertEqual(found["nodes"], sum(piece["nodes"] for piece in pieces))
        self.assertEqual(set().union(*(piece["names"] for piece in pieces)), NAMES | {f"part_000{number}" for number in (1, 2, 3)})

    @unittest.skipUnless(shutil.which("cgnscheck"), "cgnscheck is not installed")
    def test_cgns_parts(self):
        self.done("convert", "s.cgns", "p.cgns", "--parts", "3", "-q")
        for number in (1, 2, 3):
            self.assertNotIn("ERROR", self.tool("cgnscheck", "-v", f"p.part_000{number}.cgns"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
