// The faces of a 3D mesh, each once with whoever has it.
#include "io/model/mesh3d_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace quadloop::io {
namespace {

TEST(Mesh3dFaces, ComeOnceWithTheirOwners) {
  FileMesh mesh;
  mesh.points.resize(10);
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
  mesh.prisms = {{1, 8, 2, 5, 9, 6}};  // cell 0: kinds of fewer nodes come first
  mesh.boundaries = {{"floor", "none", {{1, 2, 8, FileBoundary::no_node}, {3, 2, 1, 0}}}};
  std::vector<std::size_t> mentions;
  std::int32_t lowest_before = 0;
  for_each_face(mesh, [&](std::int32_t lowest, std::span<const FaceMention> same) {
    EXPECT_GE(lowest, lowest_before);
    lowest_before = lowest;
    mentions.push_back(same.size());
    if (same.size() < 2) return;
    if (same[0].owner < 0) {
      EXPECT_EQ(same[0].owner, -1);
      EXPECT_EQ(same[1].owner, same[0].number == 0 ? 0 : 1);
      EXPECT_EQ(same[1].number, 0);  // the first face of both
    } else {
      EXPECT_EQ(same[0].owner, 0);
      EXPECT_EQ(same[1].owner, 1);
      EXPECT_EQ(same[0].number, 4);  // of the prism that of its nodes 2, 0, 3 and 5
      EXPECT_EQ(same[1].number, 3);  // of the cube that of its nodes 1, 2, 6 and 5
      EXPECT_EQ(same[0].others, (std::array<std::int32_t, 3>{2, 5, 6}));
    }
  });
  EXPECT_EQ(mentions.size(), 10U);
  EXPECT_EQ(std::ranges::count(mentions, 2U), 3);
}

}  // namespace
}  // namespace quadloop::io
