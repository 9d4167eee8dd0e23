#include "adapt/morph/merged_bases.hpp"

#include <gtest/gtest.h>

#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop::adapt {
namespace {

Geometry body(const std::vector<Point>& points) {
  Warnings warnings;
  AssembleOptions options;
  options.domain_is_known = true;
  return assemble({{"body", false, points, "test"}}, options, warnings);
}

TEST(MergedBases, EndsThatAreOneNodeOfTheMeshBecomeOneVertex) {
  const std::vector<Point> blunt{{0, 1}, {-4, 0}, {0, -1}, {4, -0.01}, {4.005, 0}, {4, 0.01}};
  const Geometry to = body(blunt), merged = body({{0, 1}, {-4, 0}, {0, -1}, {4, 0}});
  const Geometry as_in_mesh = with_bases_as_in(merged, to);
  ASSERT_EQ(as_in_mesh.size(), 4);
  EXPECT_EQ(as_in_mesh.point(3), (Point{4, 0}));
  EXPECT_EQ(with_bases_as_in(to, to).size(), 6) << "the mesh has all of its nodes";
  std::vector<Point> moved = blunt;
  for (Point& p : moved) p.y += 0.5;
  EXPECT_EQ(with_bases_as_in(merged, body(moved)).size(), 6) << "somewhere else";
}

}  // namespace
}  // namespace quadloop::adapt
