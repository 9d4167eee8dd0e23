// Figures of faces of a mesh that is worked out by hand, and the same on any number of ranks.
#include "mesher/mesh/check/face_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::Grid;
using test::node;
using test::world;

/// A unit square, and beside it a parallelogram that rises by `rise`.
Mesh square_and_parallelogram(double rise) {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {2, rise}, {0, 1}, {1, 1}, {2, 1 + rise}};
  mesh.owned_nodes = 6;
  mesh.quads = {{node(0), node(1), node(4), node(3)}, {node(1), node(2), node(5), node(4)}};
  mesh.boundaries = {{"all",
                      "none",
                      {{node(0), node(1)},
                       {node(1), node(2)},
                       {node(2), node(5)},
                       {node(5), node(4)},
                       {node(4), node(3)},
                       {node(3), node(0)}}}};
  return mesh;
}

FaceStatistics face_statistics_of(const Mesh& whole) {
  const Mesh part = scatter_mesh(world(), world().is_root() ? whole : Mesh{},
                                 world().is_root() ? space_filling_order(whole) : MeshOrder{});
  return face_statistics(world(), part, {}).others;
}

TEST(FaceStatistics, OfASquareAndAParallelogram) {
  const FaceStatistics statistics = face_statistics_of(square_and_parallelogram(1));
  EXPECT_NEAR(statistics.non_orthogonality, std::atan(0.5) * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(statistics.skewness, 1,
              1e-12);  // at the right end: the foot of the centre is the edge's lower end
  EXPECT_NEAR(statistics.aspect_ratio, 2, 1e-12);
  EXPECT_EQ(statistics.non_orthogonal + statistics.skew + statistics.flat, 0);
}

TEST(FaceStatistics, CountsWhatIsSevereOnce) {
  const FaceStatistics steep = face_statistics_of(square_and_parallelogram(10));
  EXPECT_EQ(steep.non_orthogonal, 1);  // atan(5) is 78.7 degrees
  EXPECT_EQ(steep.skew, 1);            // at the right end; the inner edge has 2.5 by a fifth of sqrt(26)
  EXPECT_EQ(steep.flat, 0);
  Mesh flat = square_and_parallelogram(0);
  for (Point& p : flat.points) p.y /= 1024;
  EXPECT_EQ(face_statistics_of(flat).flat, 2);
  EXPECT_NEAR(face_statistics_of(flat).aspect_ratio, 1024, 1e-9);
}

/// The two cells again and again: a pair leads from the right end to the left one.
Mesh periodic(double rise) {
  Mesh mesh = square_and_parallelogram(rise);
  const auto all = mesh.boundaries[0].edges;
  mesh.boundaries = {{"walls", "none", {all[0], all[1], all[3], all[4]}},
                     {"right", "none", {all[2]}},
                     {"left", "none", {all[5]}}};
  mesh.pairs = {{"left", "right", {2, rise}}};
  return mesh;
}

TEST(FaceStatistics, EdgesOfPairsLieBetweenTwoCells) {
  const FaceStatistics statistics = face_statistics_of(periodic(1));
  EXPECT_NEAR(statistics.non_orthogonality, std::atan(0.5) * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(statistics.skewness, 0.5, 1e-12);  // both edges: the line passes a quarter above the middle
  const FaceStatistics steep = face_statistics_of(periodic(10));
  EXPECT_EQ(steep.non_orthogonal, 2);
  EXPECT_EQ(steep.skew, 0);  // 2.5 by a fifth of sqrt(26)
  Mesh unmatched = periodic(1);
  unmatched.pairs[0].translation = {2, 0.5};
  EXPECT_NEAR(face_statistics_of(unmatched).skewness, 1, 1e-12) << "they are outer edges";
}

/// A single cell that is its own neighbour on all sides.
TEST(FaceStatistics, OfACellBesideItself) {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 10}, {0, 1}, {1, 11}};
  mesh.owned_nodes = 4;
  mesh.quads = {{node(0), node(1), node(3), node(2)}};
  mesh.boundaries = {{"south", "none", {{node(0), node(1)}}},
                     {"east", "none", {{node(1), node(3)}}},
                     {"north", "none", {{node(3), node(2)}}},
                     {"west", "none", {{node(2), node(0)}}}};
  mesh.pairs = {{"south", "north", {0, 1}}, {"west", "east", {1, 10}}};
  const FaceStatistics statistics = face_statistics_of(mesh);
  EXPECT_NEAR(statistics.non_orthogonality, std::atan(10) * 180 / std::numbers::pi, 1e-12);
  EXPECT_EQ(statistics.non_orthogonal, 2);
}

}  // namespace
}  // namespace quadloop
