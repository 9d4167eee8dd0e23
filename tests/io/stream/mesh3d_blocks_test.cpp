// Blocks of 3D meshes: extruded and held, through each format that has a place for them; those of a plane
// polyMesh; how readers collect them. The first on several ranks.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <map>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/cell_faces.hpp"
#include "io/model/check_mesh3d.hpp"
#include "io/stream/block_meshes.hpp"
#include "io/stream/stream_blocks.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;
using Names = std::vector<std::string>;

/// Five quads, the last two of which are "right", under ten triangles, of which the last four are.
LoadedMesh two_blocks() {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(5);
  whole.blocks = 2;
  whole.block_names = {"left", "right"};
  whole.triangle_to_block = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
  whole.quad_to_block = {0, 0, 0, 1, 1};
  return whole;
}

/// Of each cell by the places of its nodes, whatever their order and numbers.
std::map<std::vector<std::array<double, 3>>, std::string> blocks_by_places(const FileMesh& mesh,
                                                                           const Names& names) {
  std::map<std::vector<std::array<double, 3>>, std::string> blocks;
  const std::vector<std::int32_t> block_of = blocks_of_cells(mesh);
  for_each_cell(mesh, [&](const auto& cell, std::int64_t number) {
    std::vector<std::array<double, 3>> places;
    for (const std::int32_t node : cell)
      places.push_back({mesh.points[node].x, mesh.points[node].y, mesh.points[node].z});
    std::ranges::sort(places);
    blocks[places] = names.empty() ? "domain" : names[block_of[number]];
  });
  return blocks;
}

/// The names of two blocks in a file of the format.
Names names_in(const std::string& format, const Names& names) {
  return format_named(format)->holds(Content::block_names) ? names : Names{"block_1", "block_2"};
}

Names formats_with_blocks() {
  Names names = read_formats_for({Content::mesh3d});
  std::erase_if(names, [](const std::string& name) { return !format_named(name)->holds(Content::blocks); });
  return names;
}

std::string path_of(const test::TemporaryFolder& folder, const std::string& format) {
  return folder.file("a." + format);
}

TEST(StreamBlocks, AnExtrudedMeshKeepsThemOnAnyRanks) {
  LoadedMesh whole = two_blocks();
  name_interfaces(whole);
  const MeshOrder order = own_order(whole.mesh);
  const Mesh named = scatter_mesh(world(), whole.mesh, order);
  ASSERT_EQ(whole.mesh.boundaries.back().name, "left__right");
  whole.mesh.boundaries.pop_back();
  const Mesh part = scatter_mesh(world(), whole.mesh, order);
  PlaneBlocks blocks = plane_blocks(whole);
  blocks.of_triangles = scatter_triangles(world(), whole.triangle_to_block, order);
  blocks.of_quads = scatter_ordered(world(), std::span<const std::int32_t>(whole.quad_to_block), order.quads);
  EXPECT_EQ(formats_with_blocks(), (Names{"cgns", "vtu", "pvtu", "su2", "fluent.msh", "msh", "msh41",
                                          "b8.ugrid", "lb8.ugrid", "polyMesh"}));
  for (const std::string& format : formats_with_blocks()) {
    SCOPED_TRACE(format);
    ExtrudedMesh mesh =
        extruded(format_named(format)->has_zones ? named : part, {0, 0.5, 2}, ExtrusionAxis::z);
    mesh.blocks = &blocks;
    const test::TemporaryFolder folder;
    OutputSet outputs(world());
    write_mesh(outputs, mesh, path_of(folder, format));
    outputs.commit();
    if (!world().is_root()) continue;
    const std::optional<FileMesh> back = test::read_mesh3d(path_of(folder, format));
    ASSERT_TRUE(back);
    ASSERT_EQ(back->block_names, names_in(format, whole.block_names));
    EXPECT_EQ(back->points.size(), 3 * whole.mesh.points.size());
    ASSERT_EQ(blocks_of_cells(*back).size(), 30);
    const Mesh3dStatistics statistics = check_mesh3d(*back);
    EXPECT_TRUE(statistics.faults.empty());
    ASSERT_EQ(statistics.blocks.size(), 2);
    EXPECT_EQ(statistics.blocks[0].cells, 18);
    EXPECT_EQ(statistics.blocks[1].cells, 12);
    EXPECT_NEAR(statistics.blocks[0].volume, 12, 1e-12);
    EXPECT_NEAR(statistics.blocks[1].volume, 8, 1e-12);
  }
}

TEST(StreamBlocks, EveryPairOfFormatsKeepsThem) {
  const test::TemporaryFolder folder;
  if (!world().is_root()) return;
  const Communicator alone(MPI_COMM_SELF);
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},    {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}, {0.5, 0.5, 2}};
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
  mesh.prisms = {{1, 8, 2, 5, 9, 6}};
  mesh.pyramids = {{4, 5, 6, 7, 10}};
  constexpr std::int32_t no_node = FileBoundary::no_node;
  mesh.boundaries = {{"rest",
                      "wall",
                      {{3, 2, 1, 0},
                       {1, 2, 8, no_node},
                       {0, 1, 5, 4},
                       {2, 3, 7, 6},
                       {3, 0, 4, 7},
                       {1, 8, 9, 5},
                       {8, 2, 6, 9},
                       {5, 9, 6, no_node},
                       {4, 5, 10, no_node},
                       {5, 6, 10, no_node},
                       {6, 7, 10, no_node},
                       {7, 4, 10, no_node}}}};
  mesh.block_names = {"tip", "base"};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::pyramid)] = {0};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::prism)] = {1};
  mesh.cell_to_block[static_cast<std::size_t>(CellKind::hexahedron)] = {1};
  ASSERT_TRUE(check_mesh3d(mesh).faults.empty());
  for (const std::string& first : formats_with_blocks()) {
    for (const std::string& second : formats_with_blocks()) {
      SCOPED_TRACE(first + " to " + second);
      test::write_alone(alone, mesh, path_of(folder, first));
      const std::optional<FileMesh> between = test::read_mesh3d(path_of(folder, first));
      test::write_alone(alone, *between, folder.file("b." + second));
      const std::optional<FileMesh> back = test::read_mesh3d(folder.file("b." + second));
      EXPECT_TRUE(back->warnings.empty());
      const Names kept = names_in(first, mesh.block_names);
      EXPECT_EQ(blocks_by_places(*back, back->block_names), blocks_by_places(mesh, names_in(second, kept)));
      EXPECT_EQ(back->points.size(), mesh.points.size());
      EXPECT_TRUE(check_mesh3d(*back).faults.empty());
      for (const std::string& loss : losses_in(*between, folder.file("b." + second)))
        EXPECT_EQ(loss.find("blocks are"), std::string::npos) << loss;
    }
  }
  const std::vector<std::string> losses = losses_in(mesh, "a.b8.ugrid");
  EXPECT_TRUE(std::ranges::any_of(losses, [](const std::string& loss) {
    return loss.find("cannot store the names of blocks") != std::string::npos;
  }));
}

TEST(StreamBlocks, APlanePolyMeshHasThemAsZones) {
  const test::TemporaryFolder folder;
  if (!world().is_root()) return;
  const LoadedMesh whole = two_blocks();
  write_mesh_file(Communicator(MPI_COMM_SELF), whole, folder.file("polyMesh"));
  const LoadedMesh back = read_mesh(folder.file("polyMesh"));
  EXPECT_TRUE(validate(back.mesh, {back.blocks, back.triangle_to_block, back.quad_to_block}).empty());
  EXPECT_EQ(back.block_names, whole.block_names);
  EXPECT_EQ(back.triangle_to_block, whole.triangle_to_block);
  EXPECT_EQ(back.quad_to_block, whole.quad_to_block);
}

TEST(StreamBlocks, ZonesOfAPolyMeshMayOverlapAndLeaveCellsOut) {
  const test::TemporaryFolder folder;
  if (!world().is_root()) return;
  const std::string path = folder.file("polyMesh");
  write_mesh_file(Communicator(MPI_COMM_SELF), two_blocks(), path);
  const auto write_zones = [&](const std::string& zones) {
    test::write_bytes(path + "/cellZones", "FoamFile { format ascii; }\n" + zones);
  };
  write_zones(
      "2 ( a { type cellZone; cellLabels List<label> 2(0 14); } b { cellLabels List<label> 2 ( 3 0 ); } )");
  const std::optional<FileMesh> back = test::read_mesh3d(path);
  EXPECT_EQ(back->block_names, (Names{"a", "b", "domain"}));
  EXPECT_EQ(blocks_of_cells(*back), (std::vector<std::int32_t>{0, 2, 2, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 0}));
  ASSERT_EQ(back->warnings.size(), 1);
  EXPECT_NE(back->warnings[0].find("1 cell in several zones"), std::string::npos);
  const LoadedMesh plane = read_mesh(path);  // has the cells of a block one after another
  EXPECT_TRUE(std::ranges::is_sorted(plane.triangle_to_block));
  EXPECT_TRUE(std::ranges::is_sorted(plane.quad_to_block));
  write_zones("1 ( a { type cellZone; cellLabels List<label> 1(15); } )");
  EXPECT_THROW(test::read_mesh3d(path), InputError);
  write_zones("1 ( a { type cellZone; cellLabels List<label> 0(); } )");
  EXPECT_FALSE(test::read_mesh3d(path)->has_blocks());
}

TEST(StreamBlocks, CellsAreNumberedBlockByBlock) {
  const Communicator alone(MPI_COMM_SELF);
  const PlaneBlocks blocks{{"a", "b"}, {1, 0, 1}, {0, 1}};
  EXPECT_EQ(numbers_by_block(alone, blocks), (std::vector<std::int64_t>{2, 0, 3, 1, 4}));
}

}  // namespace
}  // namespace quadloop::io
