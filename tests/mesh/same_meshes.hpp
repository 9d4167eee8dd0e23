#pragma once

#include <gtest/gtest.h>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::test {

/// The same nodes, cells and boundary edges, in the same order and to the last bit.
inline void expect_same_meshes(const Mesh& a, const Mesh& b) {
  EXPECT_TRUE(a.points == b.points);
  EXPECT_TRUE(a.triangles == b.triangles);
  EXPECT_TRUE(a.quads == b.quads);
  ASSERT_EQ(a.boundaries.size(), b.boundaries.size());
  for (std::size_t i = 0; i < a.boundaries.size(); ++i) {
    EXPECT_EQ(a.boundaries[i].name, b.boundaries[i].name);
    EXPECT_TRUE(a.boundaries[i].edges == b.boundaries[i].edges) << a.boundaries[i].name;
  }
}

}  // namespace quadloop::test
