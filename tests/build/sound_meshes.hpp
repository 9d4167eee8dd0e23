#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>

#include "mesher/build/build_mesh.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/require_sound.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// Expects of a mesh on all ranks that it is the one made on one rank, node by node.
inline void expect_equal_meshes(const Mesh& whole, const Mesh& alone) {
  EXPECT_EQ(whole.points, alone.points);
  EXPECT_EQ(whole.triangles, alone.triangles);
  EXPECT_EQ(whole.quads, alone.quads);
  EXPECT_EQ(whole.blocks.of_triangles, alone.blocks.of_triangles);
  EXPECT_EQ(whole.blocks.of_quads, alone.blocks.of_quads);
  ASSERT_EQ(whole.boundaries.size(), alone.boundaries.size());
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b)
    EXPECT_EQ(whole.boundaries[b].edges, alone.boundaries[b].edges);
}

/// Expects that a mesh of each type is valid and the same on one rank. Calls `check(whole, made)` for each on
/// the root, with the whole mesh and the result of this rank. *Collective.*
template <class Check>
void expect_sound_meshes(const Geometry& geometry, const MeshOptions& given, const Check& check) {
  const Communicator self(MPI_COMM_SELF);
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshOptions options = given;
    options.type = type;
    const MeshResult made = build_mesh(world(), geometry, options);
    require_sound(world(), made.mesh);
    const Mesh whole = gather_whole(world(), made.mesh);
    const MeshResult alone = build_mesh(self, geometry, options);
    if (!world().is_root()) continue;
    expect_equal_meshes(whole, alone.mesh);
    const auto blocks = std::max<std::int32_t>(1, static_cast<std::int32_t>(geometry.block_names().size()));
    for (const MeshFault& fault : validate(whole, {blocks, whole.blocks.of_triangles, whole.blocks.of_quads}))
      ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what << " at " << fault.place.x << " "
                    << fault.place.y;
    EXPECT_TRUE(type != MeshType::delaunay || is_delaunay(whole, whole.blocks.of_triangles));
    check(whole, made);
  }
}

}  // namespace quadloop::test
