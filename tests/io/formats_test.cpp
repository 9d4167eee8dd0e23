// The table of formats: what lists are made from it, and that each row reads what it writes.
#include "io/formats.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using Names = std::vector<std::string>;

TEST(Formats, AreListedByWhatTheyHold) {
  EXPECT_EQ(formats_for({}),
            (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf", "su2", "fluent.msh", "msh", "msh41",
                   "b8.ugrid", "lb8.ugrid", "ugrid", "medit", "polyMesh", "csv", "dat"}));
  EXPECT_EQ(formats_for({Content::mesh3d}), (Names{"cgns", "vtu", "pvtu", "vtkhdf", "su2", "fluent.msh",
                                                   "msh", "msh41", "b8.ugrid", "lb8.ugrid", "polyMesh"}));
  EXPECT_EQ(formats_for({Content::mesh}),
            (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf", "su2", "fluent.msh", "msh", "msh41",
                   "ugrid", "medit", "polyMesh"}));
  EXPECT_EQ(formats_for({Content::mesh, Content::solution}),
            (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf"}));
  EXPECT_EQ(read_formats_for({Content::mesh, Content::solution}),
            (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu"}));
  EXPECT_EQ(formats_for({Content::constants}), (Names{"mesh", "qmesh"}));
  EXPECT_EQ(formats_for({Content::blocks, Content::conditions}),
            (Names{"qmesh", "cgns", "fluent.msh", "b8.ugrid", "lb8.ugrid", "ugrid", "polyMesh"}));
  EXPECT_EQ(formats_for({Content::layers}), (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf"}));
}

TEST(Formats, StandInASentenceBySuffix) {
  EXPECT_EQ(suffixes_for({Content::mesh}),
            ".mesh, .qmesh, .cgns, .vtu, .pvtu, .vtkhdf, .su2, .fluent.msh, .msh, .msh41, .ugrid, .medit or "
            "polyMesh");
  EXPECT_EQ(read_suffixes_for({Content::mesh}),
            ".mesh, .qmesh, .cgns, .vtu, .pvtu, .su2, .fluent.msh, .msh, .msh41, .ugrid, .medit or polyMesh");
  EXPECT_EQ(read_suffixes_for({Content::solution}, "and"),
            ".mesh, .qmesh, .cgns, .vtu, .pvtu, .csv and .dat");
  EXPECT_EQ(suffixes_for({Content::conditions}),
            ".qmesh, .cgns, .fluent.msh, .b8.ugrid, .lb8.ugrid, .ugrid or polyMesh");
}

TEST(Formats, AreFoundByNameAndSuffix) {
  EXPECT_EQ(format_named("vtu")->name, "vtu");
  EXPECT_EQ(format_of("a/b.tree.cgns")->name, "cgns");
  EXPECT_EQ(format_of("a.msh")->name, "msh");
  EXPECT_EQ(format_of("a.fluent.msh")->name, "fluent.msh");
  EXPECT_EQ(format_of("a.ugrid")->name, "ugrid");
  EXPECT_EQ(format_of("a.b8.ugrid")->name, "b8.ugrid");
  EXPECT_EQ(format_of("a.MSH")->name, "msh");
  EXPECT_EQ(format_of("A.B8.UGRID")->name, "b8.ugrid");
  EXPECT_EQ(format_of("a.POLYMESH/")->name, "polyMesh");
  for (const char* path : {"a", "mesh", "a.mesh/b", ".mesh", "a.tree.h5", "a."})
    EXPECT_EQ(format_of(path), nullptr) << path;
  EXPECT_EQ(format_named(""), nullptr);
  EXPECT_EQ(format_named(".vtu"), nullptr);
}

TEST(Formats, NativeOneComesFirstAndKeepsAll) {
  EXPECT_EQ(native_format().name, "mesh");
  for (const Content content : {Content::mesh, Content::solution, Content::constants, Content::layers})
    EXPECT_TRUE(native_format().holds(content));
  EXPECT_EQ(default_formats(), (Names{"mesh", "cgns"}));
}

void expect_same_solution(const FileFormat& format, const LoadedMesh& loaded, const Field& solution) {
  ASSERT_EQ(loaded.solution.has_value(), format.holds(Content::solution));
  if (!loaded.solution) return;
  EXPECT_EQ(loaded.solution->values, solution.values);
  EXPECT_EQ(loaded.solution->constants,
            format.holds(Content::constants) ? solution.constants : std::vector<double>{});
}

/// Each from its lowest node on: a file of faces alone does not tell with which node a cell begins.
std::vector<std::array<NodeId, 3>> from_lowest(std::vector<std::array<NodeId, 3>> cells) {
  for (auto& nodes : cells) std::ranges::rotate(nodes, std::ranges::min_element(nodes));
  return cells;
}

TEST(Formats, EachReadsWhatItWrites) {
  const Communicator alone(MPI_COMM_SELF);
  const test::TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  const Field solution = test::sample_solution(mesh);
  Names read;
  for (const FileFormat& format : file_formats()) {
    if (!format.is_read()) continue;
    SCOPED_TRACE(format.name);
    const std::string path = folder.file("a." + format.name);
    OutputSet outputs(alone);
    if (format.holds(Content::mesh) || format.holds(Content::solution)) read.push_back(format.name);
    if (format.holds(Content::mesh)) {
      format.write(outputs, MeshStream(alone, mesh, &solution), path);
      outputs.commit();
      const LoadedMesh loaded = plane_of(format.read(Communicator(MPI_COMM_SELF), path), path);
      EXPECT_EQ(loaded.mesh.points, mesh.points);
      EXPECT_EQ(from_lowest(loaded.mesh.triangles), from_lowest(mesh.triangles));
      if (format.name != "fluent.msh") {
        EXPECT_EQ(loaded.mesh.triangles, mesh.triangles);
      }
      expect_same_solution(format, loaded, solution);
    } else if (format.holds(Content::solution)) {
      format.write_solution(outputs, mesh, path, solution, 1.4);
      outputs.commit();
      EXPECT_EQ(format.read_solution(Communicator(MPI_COMM_SELF), path).solution.values, solution.values);
    }
  }
  Names written = written_formats();
  std::erase(written, "vtkhdf");
  EXPECT_EQ(read, written);
}

TEST(Formats, OfPlaneMeshesAreWritten) {
  EXPECT_EQ(written_formats(), (Names{"mesh", "qmesh", "cgns", "vtu", "pvtu", "vtkhdf", "su2", "fluent.msh",
                                      "msh", "msh41", "ugrid", "medit", "polyMesh", "csv", "dat"}));
}

/// What a file is counts more than what its name says.
TEST(Formats, OtherFilesAreNamedForWhatTheyAre) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& bytes) {
    const std::string path = folder.file(name);
    test::write_bytes(path, bytes);
    try {
      require_kind_of_suffix(path);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size());
    }
    return std::string();
  };
  const std::string no_end(1, '\0');
  EXPECT_EQ(refusal("a.vtu", "# vtk DataFile Version 3.0\n"),
            ": is a VTK file in the legacy format; save it as an unstructured grid in XML (.vtu)");
  EXPECT_EQ(refusal("a.su2", "$MeshFormat\n4.1 0 8\n"),
            ": is a mesh of Gmsh; give it a name that ends in .msh");
  EXPECT_EQ(refusal("a.e", "CDF\1" + no_end).find(": is a NetCDF file, such as Exodus II; save the mesh as"),
            0U);
  EXPECT_EQ(refusal("a.cas.h5", "\x89HDF\r\n").find(": is a mesh of Fluent in HDF5"), 0U);
  EXPECT_EQ(refusal("a.msh", "solid part\n facet normal 0 0 1\n").find(": is an STL surface"), 0U);
  for (const char* text :
       {"CEND\nBEGIN BULK\n", "GRID,1,,0.,0.,0.\n", "$ by hand\nGRID*\n", "ID A,B\nBEGIN BULK\n"})
    EXPECT_EQ(refusal("bdf.mesh", text).find(": is a Nastran file"), 0U) << text;
  EXPECT_EQ(refusal("unv.mesh", "    -1\n  2411\n").find(": is a universal file of I-deas"), 0U);
  for (const char* nodes : {"3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n", "3 2 0 0\n1 0 0\n", "1 2 0 0\n0 0.5 0.5",
                            "# of triangle\n\n3 2 1 1 # head\n# rows\n1 0 0 7 1\n2 1 0 7 1\n"}) {
    for (const char* name : {"node.mesh", "a.node"})
      EXPECT_EQ(refusal(name, nodes).find(": is a file of nodes of Triangle"), 0U) << nodes;
  }
  EXPECT_EQ(refusal("med.mesh", "\x89HDF\r\n heap INFOS_GENERALES").find(": is a mesh of Salome (MED)"), 0U);
  for (const char* name : {"a.vtkhdf", "b.h5"})
    EXPECT_EQ(refusal(name, "\x89HDF\r\n VTKHDF").find(": is a VTKHDF file, which is written but not read"),
              0U);
  EXPECT_EQ(refusal("own.mesh", "3 \n1 0\n2 1\n3 0\n1\n"), "");
  EXPECT_EQ(refusal("a.cas", "(0 \"Fluent\")"), ": is a mesh of Fluent; give it a name that ends in .msh");
  std::string stl(84 + 2 * 50, ' ');
  stl[80] = 2;
  stl[81] = stl[82] = stl[83] = '\0';
  EXPECT_EQ(refusal("a.stl", stl).find(": is a binary STL surface"), 0U);
  for (const auto& [name, bytes] : {std::pair{"a.MSH", "\n$MeshFormat\n"},
                                    {"b.msh", "(0 \"Fluent\")"},
                                    {"a.mesh", "MeshVersionFormatted 2\n"},
                                    {"b.mesh", "#Number of grid points\n"},
                                    {"a.cgns", "\x89HDF\r\n"},
                                    {"c.vtu", "<?xml version=\"1.0\"?>\n<VTKFile "},
                                    {"b.su2", "NDIME= 2"},
                                    {"d.vtu", ""}})
    EXPECT_EQ(refusal(name, bytes), "") << name;
}

TEST(Formats, OfMeshesAreReadAndWritten) {
  for (const FileFormat& format : file_formats()) {
    const bool is_of_meshes = format.holds(Content::mesh) || format.holds(Content::mesh3d);
    EXPECT_EQ(format.write != nullptr, is_of_meshes) << format.name;
    EXPECT_EQ(format.read != nullptr, is_of_meshes && format.name != "vtkhdf") << format.name;
  }
}

}  // namespace
}  // namespace quadloop::io
