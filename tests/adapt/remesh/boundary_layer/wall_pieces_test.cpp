// Pieces of walls between corners, and values smoothed along them.
#include "adapt/remesh/boundary_layer/wall_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generate/generate.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// A square box around a body with a round front and tangents to a sharp edge at (1, 0), and a circle.
MeshInput bodies() {
  Boundary box{"box", 1, 30, "farfield"}, body{"body", 0.1, 30, "wall"}, circle{"circle", 0.1, 30, "wall"};
  std::vector<Point> points{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}, {1, 0}};
  constexpr double pi = 3.14159265358979, radius = 0.4;
  const double at_tangent = std::acos(radius);
  for (int k = 0; k <= 16; ++k) {
    const double angle = -at_tangent - (2 * pi - 2 * at_tangent) * k / 16;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  std::vector<std::int32_t> loops{0, 4, size32(points)};
  for (int k = 0; k < 24; ++k)
    points.push_back({2.5 + 0.5 * std::cos(pi * k / 12), 2 - 0.5 * std::sin(pi * k / 12)});
  loops.push_back(size32(points));
  std::vector<BoundaryId> of_segment(points.size(), BoundaryId{2});
  std::fill_n(of_segment.begin(), 4, BoundaryId{0});
  std::fill(of_segment.begin() + 4, of_segment.begin() + loops[2], BoundaryId{1});
  MeshInput input{{{box, body, circle}, points, loops, of_segment}, {}, {}, 0};
  input.mesh.size.min = 0.025;
  input.mesh.size.max = 1;
  return input;
}

TEST(WallPieces, EndAtCornersAndGoAroundBodiesWithoutOne) {
  const Mesh mesh = generate_mesh(world(), bodies()).result.mesh;
  const std::vector<std::string> names{"circle", "body"};
  const std::vector<WallPiece> pieces = wall_pieces(world(), mesh, names);
  ASSERT_EQ(pieces.size(), 2U);
  const WallPiece &body = pieces[pieces[0].wall == 1 ? 0 : 1], &circle = pieces[pieces[0].wall == 1 ? 1 : 0];
  EXPECT_FALSE(body.closed);
  EXPECT_EQ(body.points.front(), (Point{1, 0}));
  EXPECT_EQ(body.points.back(), (Point{1, 0}));
  EXPECT_TRUE(circle.closed);
  EXPECT_EQ(circle.edges(), circle.points.size());
  for (std::size_t k = 0; k < circle.points.size(); ++k) {
    const Point outwards = 2 * (circle.points[k] - Point{2.5, 2});
    EXPECT_GT(dot(circle.normal(k), outwards), 0.98) << "into the domain";
  }
  EXPECT_GT(body.normal(0).y * body.normal(body.points.size() - 1).y, -1);
  EXPECT_LT(body.normal(0).y, 0) << "at its ends a piece has the normal of its own edge";
  EXPECT_GT(body.normal(body.points.size() - 1).y, 0);
}

TEST(WallPieces, AreTheSameOnAnyNumberOfRanks) {
  const std::vector<std::string> names{"circle", "body"};
  const std::vector<WallPiece> pieces =
      wall_pieces(world(), generate_mesh(world(), bodies()).result.mesh, names);
  const Communicator alone(MPI_COMM_SELF);
  const std::vector<WallPiece> of_one = wall_pieces(alone, generate_mesh(alone, bodies()).result.mesh, names);
  ASSERT_EQ(pieces.size(), of_one.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) EXPECT_EQ(pieces[i].points, of_one[i].points);
}

WallPiece straight(std::size_t nodes, bool closed = false) {
  WallPiece piece{0, {}, closed};
  for (std::size_t k = 0; k < nodes; ++k) piece.points.push_back({static_cast<double>(k), 0});
  return piece;
}

TEST(WallPieces, OddValuesDoNotCountAlongThem) {
  std::vector<double> values(20, 2.0);
  for (const std::size_t odd : {0U, 7U, 8U, 19U}) {
    for (const double wrong : {0.0, 0.01, 100.0}) {
      std::vector<double> with_odd = values;
      with_odd[odd] = wrong;
      EXPECT_EQ(smoothed(straight(20), with_odd), values) << odd << " " << wrong;
      EXPECT_EQ(smoothed(straight(20, true), with_odd), values) << odd << " " << wrong;
    }
  }
}

TEST(WallPieces, StretchesWithoutValuesStayUnknown) {
  std::vector<double> values(20, 2.0);
  std::fill(values.begin() + 10, values.end(), 0.0);
  values[15] = 3;  // alone
  const std::vector<double> known = smoothed(straight(20), values);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(known[k], k < 10 ? 2 : 0) << k;
}

TEST(WallPieces, ValuesKeepTheirTrendInEitherDirection) {
  std::vector<double> values;
  for (int k = 0; k < 20; ++k) values.push_back(1 + 0.1 * k);
  const std::vector<double> same = smoothed(straight(20), values);
  for (std::size_t k = 4; k < 16; ++k) EXPECT_NEAR(same[k], values[k], 1e-14);
  values[4] = 7, values[11] = 0.2;
  std::vector<double> one = smoothed(straight(20), values);
  std::ranges::reverse(values);
  const std::vector<double> other = smoothed(straight(20), values);
  std::ranges::reverse(one);
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace quadloop::adapt
