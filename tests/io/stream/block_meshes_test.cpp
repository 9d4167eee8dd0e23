// The blocks of a distributed mesh as meshes of their own, and formats with a zone for each: on any ranks the
// same.
#include "io/stream/block_meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/stream/stream_blocks.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

/// Columns of squares, the lower row quads and the upper one pairs of triangles: the first three columns are
/// block "left", of the others the lower row is "low" and the upper "high".
LoadedMesh three_blocks(std::int32_t columns) {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(columns);
  whole.mesh.boundaries[1].name = "far_field";  // a name for all formats
  whole.blocks = 3;
  whole.block_names = {"left", "low", "high"};
  for (std::int32_t column = 0; column < columns; ++column) {
    whole.quad_to_block.push_back(column < 3 ? 0 : 1);
    whole.triangle_to_block.insert(whole.triangle_to_block.end(), 2, column < 3 ? 0 : 2);
  }
  whole.solution = test::sample_solution(whole.mesh);
  name_interfaces(whole);
  return whole;
}

/// What this rank has of it.
struct Share {
  Mesh mesh;
  PlaneBlocks blocks;
  Field solution;

  explicit Share(const LoadedMesh& whole) {
    const MeshOrder order = own_order(whole.mesh);
    mesh = scatter_mesh(world(), whole.mesh, order);
    blocks.names = whole.block_names;
    blocks.of_triangles = scatter_triangles(world(), whole.triangle_to_block, order);
    blocks.of_quads =
        scatter_ordered(world(), std::span<const std::int32_t>(whole.quad_to_block), order.quads);
    solution = scatter_field(world(), *whole.solution, mesh, order);
  }
};

std::vector<std::pair<std::string, std::size_t>> boundaries_of(const Mesh& mesh) {
  std::vector<std::pair<std::string, std::size_t>> found;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    found.emplace_back(boundary.name, boundary.edges.size());
  return found;
}

TEST(NameInterfaces, GivesNamesToEdgesWithoutOne) {
  LoadedMesh whole = three_blocks(5);
  const auto all = boundaries_of(whole.mesh);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[2], std::pair(std::string("left__high"), std::size_t{1}));
  EXPECT_EQ(all[3], std::pair(std::string("left__low"), std::size_t{1}));
  EXPECT_EQ(all[4], std::pair(std::string("low__high"), std::size_t{2}));
  EXPECT_TRUE(validate(whole.mesh, {3, whole.triangle_to_block, whole.quad_to_block}).empty());
  whole.mesh.boundaries[3].name = "mine";
  name_interfaces(whole);
  EXPECT_EQ(boundaries_of(whole.mesh).size(), 5U) << "named edges keep their name";
}

TEST(BlockMeshes, AreTheSameOnAnyRanks) {
  const LoadedMesh whole = three_blocks(9);
  const Share share(whole);
  const MeshStream stream(world(), share.mesh, &share.solution, share.blocks);
  const auto blocks = block_meshes(stream, "a.su2");
  ASSERT_EQ(blocks.size(), 3U);
  const std::array<std::int64_t, 3> nodes{12, 14, 14}, triangles{6, 0, 12}, quads{3, 6, 0},
      edges{8 + 2, 14, 14};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(blocks[b]->name(), whole.block_names[b]);
    const StreamCounts& counts = blocks[b]->stream().counts();
    EXPECT_EQ(counts.nodes, nodes[b]);
    EXPECT_EQ(counts.of(CellKind::triangle), triangles[b]);
    EXPECT_EQ(counts.of(CellKind::quad), quads[b]);
    EXPECT_EQ(blocks[b]->stream().boundaries()->all_edges(), edges[b]);
    std::int64_t wrong = 0;  // numbers in the order of the whole mesh, and its values
    std::int64_t last = -1;
    const MeshStream& own = blocks[b]->stream();
    for (std::int64_t row = 0, at = 0; row < stream.point_rows(); ++row) {
      const NodeNumber number = blocks[b]->node_of_row(row);
      if (number < 0) continue;
      wrong += number > last ? 0 : 1;
      last = number;
      wrong += own.value(at, 1) == stream.value(row, 1) && own.point(at).x == stream.point(row).x ? 0 : 1;
      ++at;
    }
    EXPECT_EQ(world().sum(wrong), 0);
  }
}

/// Each node, cell and edge of the whole mesh by the places of its nodes, with block or name and value.
std::multiset<std::string> content_of(const LoadedMesh& loaded) {
  std::multiset<std::string> content;
  const Mesh& mesh = loaded.mesh;
  const auto text_of = [&](const auto& nodes) {
    std::multiset<std::string> places;
    for (const NodeId node : nodes)
      places.insert(std::to_string(mesh.point(node).x) + " " + std::to_string(mesh.point(node).y) + ", ");
    std::string text;
    for (const std::string& place : places) text += place;
    return text;
  };
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    content.insert(text_of(std::array{NodeId{node}}));
  std::int32_t cell = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    content.insert(text_of(nodes) + loaded.block_names[block_of_cell(loaded, cell++)]);
  });
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges) content.insert(text_of(edge) + boundary.name);
  }
  return content;
}

TEST(BlockMeshes, FilesWithZonesAreReadAsOneMesh) {
  const LoadedMesh whole = three_blocks(9);
  const Share share(whole);
  int with_zones = 0;
  for (const std::string& format : read_formats_for({Content::mesh, Content::blocks})) {
    if (!format_named(format)->has_zones) continue;
    SCOPED_TRACE(format);
    ++with_zones;
    const test::TemporaryFolder folder;
    const std::string path = folder.file("a." + format);
    OutputSet outputs(world());
    const MeshStream stream(world(), share.mesh, &share.solution, share.blocks);
    format_named(format)->write(outputs, stream, path);
    outputs.commit();
    if (!world().is_root()) continue;
    const LoadedMesh back = read_mesh(path);
    EXPECT_EQ(back.block_names, whole.block_names);
    for (const MeshFault& fault : validate(back.mesh, {3, back.triangle_to_block, back.quad_to_block}))
      ADD_FAILURE() << fault.what;
    EXPECT_EQ(content_of(back), content_of(whole));
    if (format == "cgns") {
      ASSERT_TRUE(back.solution);
      EXPECT_EQ(back.solution->values.size(), whole.solution->values.size());
      EXPECT_EQ(std::multiset<double>(back.solution->values.begin(), back.solution->values.end()),
                std::multiset<double>(whole.solution->values.begin(), whole.solution->values.end()));
    }
  }
  EXPECT_EQ(with_zones, 2);
}

}  // namespace
}  // namespace quadloop::io
