// Files of the library beside plane meshes: 3D meshes and pictures; blocks and inner lines of a file.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <string>

#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/quadloop.hpp"
#include "tests/quadloop/mesh_of_text.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Mesh square_with_line() {
  return test::mesh_of_text(test::unit_square +
                            "[[line]]\nname = \"cut\"\npath = [[0.2, 0.5], [0.8, 0.5]]\n");
}

Mesh two_blocks() { return test::mesh_of_text(test::square_of_blocks); }

Field flow_on(const Mesh& mesh) {
  Field field{{"density", "x_velocity", "y_velocity", "pressure"}, {}, {}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    field.values.insert(field.values.end(), {1, 0.5 + 0.3 * mesh.points[i].x, 0, 1 / 1.4});
  return field;
}

TEST(LibraryFiles, AnExtrudedMeshReadsBackAsItsPlane) {
  const test::TemporaryFolder folder;
  const Mesh mesh = square_with_line();
  extrude(world(), mesh, {0.5, 2}, folder.file("a.polyMesh"));
  const MeshFile back = read(world(), folder.file("a.polyMesh"));
  EXPECT_EQ(world().sum(back.mesh.owned_nodes), world().sum(mesh.owned_nodes));
  EXPECT_TRUE(check(world(), back.mesh).empty());
  const std::vector<std::string> warnings =
      extrude(world(), mesh, {0.5, 1, 2}, folder.file("a.vtu"), flow_on(mesh));
  EXPECT_NE(warnings.back().find("inner lines"), std::string::npos) << warnings.back();
  if (world().is_root()) {
    EXPECT_NE(test::bytes_of(folder.file("a.vtu")).find("density"), std::string::npos);
  }
  for (const std::vector<double>& heights :
       {std::vector<double>{1}, std::vector<double>{1, 0}, std::vector<double>{0, NAN}})
    EXPECT_THROW(extrude(world(), mesh, heights, folder.file("b.vtu")), InputError);
  EXPECT_THROW(extrude(world(), mesh, {0, 1}, folder.file("b.png")), InputError);
}

TEST(LibraryFiles, EdgesBetweenBlocksAreNoPatch) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> warnings = extrude(world(), two_blocks(), {0, 1}, folder.file("a.vtu"));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("edges between two blocks are no patch"), std::string::npos) << warnings[0];
  if (world().is_root()) {
    EXPECT_EQ(test::bytes_of(folder.file("a.vtu")).find("between"), std::string::npos);
  }
}

TEST(LibraryFiles, ReadingKeepsBlocksAndInnerLines) {
  const test::TemporaryFolder folder;
  write(world(), two_blocks(), folder.file("a.msh"));
  const Mesh blocks = read(world(), folder.file("a.msh")).mesh;
  EXPECT_EQ(blocks.blocks.names, (std::vector<std::string>{"west", "east"}));
  EXPECT_EQ(blocks.blocks.of_triangles.size(), blocks.triangles.size());
  EXPECT_EQ(blocks.blocks.of_quads.size(), blocks.quads.size());
  write(world(), square_with_line(), folder.file("b.msh"));
  const Mesh line = read(world(), folder.file("b.msh")).mesh;
  std::int64_t edges = 0;
  for (const BoundaryEdges& boundary : line.boundaries)
    edges += boundary.name == "cut" && boundary.inner_line ? std::ssize(boundary.edges) : 0;
  EXPECT_GT(world().sum(edges), 5);
}

TEST(LibraryFiles, PicturesAreThoseOfTheWholeMesh) {
  const test::TemporaryFolder folder;
  const Mesh mesh = two_blocks();
  const Field flow = flow_on(mesh);
  PlotOptions options;
  options.size = 400;
  for (const char* field : {"", "x_velocity", "mach"}) {
    options.field = field;
    const std::string bytes = picture(world(), mesh, flow, options);
    EXPECT_EQ(bytes.empty(), !world().is_root());
    Mesh whole = gather_whole(world(), mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(bytes.starts_with("\x89PNG")) << field;
    EXPECT_EQ(bytes, picture(Communicator(MPI_COMM_SELF), whole, flow_on(whole), options)) << field;
  }
  options.field = "";
  options.colouring = io::PlotColouring::block;
  plot(world(), mesh, folder.file("a.svg"), {}, options);
  if (world().is_root()) {
    EXPECT_TRUE(test::bytes_of(folder.file("a.svg")).starts_with("<?xml"));
  }
  options.field = "temperature";
  EXPECT_THROW(picture(world(), mesh, flow, options), InputError);
  options.field = "pressure";
  options.map = "rainbow";
  EXPECT_THROW(picture(world(), mesh, flow, options), InputError);
  EXPECT_THROW(plot(world(), mesh, folder.file("a.gif")), InputError);
  EXPECT_THROW(plot(world(), mesh, folder.file("none/a.png")), OutputError);
}

}  // namespace
}  // namespace quadloop
