// Blocks, variables, temporaries and parts by the thousand: time grows with their number, not with its
// square.
#include "tests/support/growth.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <vector>

#include "io/files/interruption.hpp"
#include "io/mesh_file.hpp"
#include "mesher/partition/mesh_part.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::expect_linear;
using test::TemporaryFolder;
using test::world;

/// Each column of the sample is a block of a quad and two triangles.
LoadedMesh mesh_of_blocks(std::int32_t columns) {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(columns);
  whole.blocks = columns;
  for (std::int32_t block = 0; block < columns; ++block) {
    whole.block_names.push_back("block_of_a_long_name_" + std::to_string(block));
    whole.quad_to_block.push_back(block);
    whole.triangle_to_block.insert(whole.triangle_to_block.end(), {block, block});
  }
  return whole;
}

LoadedMesh mesh_of_variables(std::int32_t count) {
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(4);
  whole.triangle_to_block.assign(whole.mesh.triangles.size(), 0);
  whole.quad_to_block.assign(whole.mesh.quads.size(), 0);
  Field& field = whole.solution.emplace();
  for (std::int32_t v = 0; v < count; ++v)
    field.names.push_back("variable_of_a_long_name_" + std::to_string(v));
  field.values.assign(whole.mesh.points.size() * count, 1.5);
  return whole;
}

TEST(Growth, OfBlocks) {
  const TemporaryFolder folder;
  for (const std::string format : {"mesh", "vtu", "msh", "fluent.msh", "polyMesh"}) {
    const auto file = [&](int blocks) {
      return folder.file(std::to_string(blocks) + (format == "polyMesh" ? "." : "a.") + format);
    };
    expect_linear("writing blocks in " + format, 1000,
                  [&](int blocks) { write_mesh_file(world(), mesh_of_blocks(blocks), file(blocks)); });
    expect_linear("reading blocks in " + format, 1000, [&](int blocks) { read_mesh(file(blocks)); });
  }
}

TEST(Growth, OfVariables) {
  const TemporaryFolder folder;
  for (const std::string format : {"mesh", "qmesh", "vtu", "msh"}) {
    const auto file = [&](int variables) { return folder.file(std::to_string(variables) + "." + format); };
    expect_linear("writing variables in " + format, 1000, [&](int variables) {
      write_mesh_file(world(), mesh_of_variables(variables), file(variables));
    });
    expect_linear("reading variables in " + format, 1000, [&](int variables) { read_mesh(file(variables)); });
  }
}

/// Registered, and taken out again in the order in which an output's own are.
TEST(Growth, OfTemporaries) {
  expect_linear("temporaries", 8000, [](int count) {
    std::vector<Temporary> temporaries;
    for (int k = 0; k < count; ++k) temporaries.emplace_back("no such folder/" + std::to_string(k));
  });
}

TEST(Growth, OfParts) {
  const Mesh mesh = test::sample_mesh(8000);
  expect_linear("parts", 500, [&](int parts) {
    EXPECT_EQ(make_parts(world(), mesh, partition(world(), mesh, parts), {}).size(),
              static_cast<std::size_t>(parts));
  });
}

}  // namespace
}  // namespace quadloop::io
