// Whether an outline belongs to a mesh, and which way its loops run there.
#include "smoother/outline/outline_match.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::smoother {
namespace {

/// The unit square, its sides as the grid's boundaries are: "wall" south and east, "far" north and west.
/// Named otherwise, if asked.
Geometry square(const std::string& wall = "wall", const std::string& far = "far", Point shift = {}) {
  std::vector<Boundary> boundaries(2);
  boundaries[0].name = wall;
  boundaries[1].name = far;
  std::vector<Point> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (Point& p : points) p = p + shift;
  return {boundaries, points, {0, 4}, {BoundaryId{0}, BoundaryId{0}, BoundaryId{1}, BoundaryId{1}}};
}

const Mesh mesh = test::Grid{8}.mesh();  // edges of 1/8

std::string refused(const Geometry& outline) {
  try {
    require_match(outline, mesh, "o.geom");
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(OutlineMatch, SaysNothingOfItsOwnOutline) {
  EXPECT_TRUE(require_match(square(), mesh, "o.geom").empty());
}

TEST(OutlineMatch, WarnsOfAnAbsentBoundary) {
  const auto warnings = require_match(square("wall", "sea"), mesh, "o.geom");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].find("o.geom: lacks these boundaries of the mesh: 'far';"), 0U) << warnings[0];
}

TEST(OutlineMatch, RefusesAnOutlineWithoutAnyOfItsNames) {
  const std::string said = refused(square("hull", "sea"));
  EXPECT_EQ(said.find("o.geom: has none of the mesh's boundaries, 'wall', 'far', but 'hull', 'sea'"), 0U)
      << said;
  EXPECT_NE(said.find("--geometry-out"), std::string::npos) << said;
}

TEST(OutlineMatch, RefusesNodesOffByMoreThanATenthOfAnEdge) {
  const double tenth = 0.1 / 8;
  const std::string said = refused(square("wall", "far", {0, 1.01 * tenth}));
  EXPECT_NE(said.find("boundary 'wall'"), std::string::npos) << said;
  EXPECT_NE(said.find("node (0, 0) is farther away than a tenth of its edge, which is 0.125 long"),
            std::string::npos)
      << said;
  EXPECT_EQ(refused(square("wall", "far", {0, 0.99 * tenth})), "nothing");
}

TEST(OutlineMatch, CountsNodesThatAreNearAlone) {
  const auto warnings = require_match(square("wall", "far", {0, 0.0078125}), mesh,
                                      "o.geom");  // the east and west side but for an end lie on it
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(
      warnings[0].find(
          "o.geom: 9 of 16 nodes of the boundary 'wall' do not lie on the geometry, by up to 0.0078125;"),
      0U)
      << warnings[0];
}

TEST(OutlineMatch, TakesTheSideOfTheDomainFromTheMesh) {
  const Geometry right = square(), wrong = with_loops_turned(right, {1});
  EXPECT_EQ(wrong.point(0), (Point{0, 0}));
  EXPECT_EQ(wrong.point(1), (Point{0, 1}));
  EXPECT_EQ(wrong.boundary_of(0), BoundaryId{1});
  EXPECT_EQ(wrong.boundary_of(3), BoundaryId{0});
  EXPECT_EQ(loops_against(right, mesh), std::vector<char>{0});
  EXPECT_EQ(loops_against(wrong, mesh), std::vector<char>{1});
  const Geometry back = with_loops_turned(wrong, {1});
  EXPECT_EQ(back.digest(), right.digest());
}

TEST(OutlineMatch, LoopsThatTheMeshDoesNotKnowStay) {
  EXPECT_EQ(loops_against(square("hull", "sea"), mesh), std::vector<char>{0});
}

}  // namespace
}  // namespace quadloop::smoother
