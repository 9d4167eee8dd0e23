// The parts of a transfer alone: the split of quads, pieces of the plane, interpolation, the nearest edge,
// and messages in rounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/locate/locate_points.hpp"
#include "adapt/transfer/locate/point_cells.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::scattered;
using test::world;

constexpr std::array<NodeId, 4> quad{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}};

Mesh with_points(const std::vector<Point>& points) {
  Mesh mesh;
  mesh.points = points;
  mesh.owned_nodes = size32(points);
  return mesh;
}

/// The two nodes that both halves have.
std::array<std::int32_t, 2> diagonal_of(const Mesh& mesh, Point centre) {
  const auto halves = parts_of(mesh.points, centre, quad).nodes;
  std::vector<std::int32_t> both;
  for (const NodeId node : halves[0]) {
    if (std::find(halves[1].begin(), halves[1].end(), node) != halves[1].end()) both.push_back(node.value());
  }
  EXPECT_EQ(both.size(), 2U);
  std::sort(both.begin(), both.end());
  return {both.at(0), both.at(1)};
}

TEST(SplitQuad, GoesThroughTheCornerFarthestFromTheCentre) {
  const Mesh mesh = with_points({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  EXPECT_EQ(diagonal_of(mesh, {0, 0}), (std::array{0, 2}));
  EXPECT_EQ(diagonal_of(mesh, {3, 0}), (std::array{1, 3}));
}

TEST(SplitQuad, OfARectangleTheFarthestCornerRanksHighest) {
  const std::array<Point, 4> corners{{{1, 1}, {4, 1}, {4, 2}, {1, 2}}};
  ASSERT_TRUE(is_rectangle(corners));
  EXPECT_FALSE(is_rectangle({corners[1], corners[2], corners[3], corners[0]}));
  for (const double x : {-9.0, 1.0, 2.0, 2.5, 3.0, 7.0}) {  // in the middle two are as far, and all four
    for (const double y : {-8.0, 1.0, 1.25, 1.5, 1.75, 30.0}) {
      const auto rank_of = [&](Point p) { return tie_rank({x, y}, p); };
      const auto highest = std::ranges::max_element(corners, {}, rank_of) - corners.begin();
      EXPECT_EQ(farthest_corner({x, y}, corners), highest) << x << " " << y;
    }
  }
}

TEST(SplitQuad, MirrorImagesAreSplitAlike) {
  for (int number = 0; number < 50; ++number) {
    const auto r = [&](int k) { return 0.2 * scattered(21, number, k); };
    const Mesh mesh =
        with_points({{1 + r(0), 1 + r(1)}, {2 + r(2), 1 + r(3)}, {2 + r(4), 2 + r(5)}, {1 + r(6), 2 + r(7)}});
    Mesh mirrored = mesh;  // turned round, so that it is counter-clockwise again: node k becomes 3 - k
    for (std::size_t k = 0; k < 4; ++k) mirrored.points[k] = {mesh.points[3 - k].x, -mesh.points[3 - k].y};
    const auto [a, b] = diagonal_of(mesh, {0, 0});
    EXPECT_EQ(diagonal_of(mirrored, {0, 0}), (std::array{3 - b, 3 - a}));
  }
}

TEST(SplitQuad, AvoidsADiagonalOutside) {
  for (std::size_t dent = 0; dent < 4; ++dent) {  // one corner pushed in, past the middle
    std::vector<Point> points{{1, 1}, {2, 1}, {2, 2}, {1, 2}};
    points[dent] = 0.5 * (Point{1.5, 1.5} + points[(dent + 2) % 4]);
    const Mesh mesh = with_points(points);
    for (const Point centre : {Point{0, 0}, Point{3, 0}, Point{3, 3}, Point{0, 3}}) {
      for (const auto& half : parts_of(mesh.points, centre, quad).nodes) {
        EXPECT_GT(orientation(mesh.point(half[0]), mesh.point(half[1]), mesh.point(half[2])), 0);
      }
    }
  }
}

TEST(CellTriangles, NumbersRunOverAllRanks) {
  const test::Grid grid{7, {1, 1}, true};
  const Mesh whole = grid.mesh();
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  std::vector<std::int64_t> numbers;
  double area = 0;
  for (const CellTriangle& triangle : cell_triangles(world(), mesh, {0, 0})) {
    numbers.push_back(triangle.number);
    const auto& [a, b, c] = triangle.nodes;
    EXPECT_GT(orientation(mesh.point(a), mesh.point(b), mesh.point(c)), 0);
    area += cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)) / 2;
  }
  double total = 0;
  for (const double part : world().all_gather(area)) total += part;
  EXPECT_NEAR(total, 1, 1e-14);
  numbers = world().all_gather_values(std::span<const std::int64_t>(numbers));
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
  EXPECT_EQ(numbers.size(), 2U * 7U * 7U);
}

TEST(CellTriangles, TurnsWhatRunsClockwiseAndLeavesOutWhatIsFlat) {
  Mesh mesh = with_points({{0, 0}, {1, 0}, {0, 1}, {2, 0}});
  mesh.triangles = {{NodeId{0}, NodeId{2}, NodeId{1}},
                    {NodeId{0}, NodeId{1}, NodeId{3}},
                    {NodeId{0}, NodeId{1}, NodeId{2}}};
  const Communicator alone(MPI_COMM_SELF);
  const auto triangles = cell_triangles(alone, mesh, {0, 0});
  ASSERT_EQ(triangles.size(), 2U);
  EXPECT_EQ(triangles[0].nodes, (std::array{NodeId{0}, NodeId{1}, NodeId{2}}));
  EXPECT_EQ(triangles[1].number, 4);
}

/// Points that come ever closer to a corner, as leaves do at a wall.
std::vector<Point> graded_points(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto number = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double size = std::ldexp(1.0, -(i % 20)), x = number(), y = number();
    points.push_back({size * x, size * y});
  }
  return points;
}

TEST(PointCells, MeetEveryBoxThatHoldsAPoint) {
  const std::vector<Point> everywhere = graded_points(6000, 40 + static_cast<std::uint64_t>(world().rank()));
  std::vector<Point> own;
  std::copy_if(everywhere.begin(), everywhere.end(), std::back_inserter(own),
               [](Point p) { return p.x > 0; });
  const CurveGrid grid(world(), everywhere);
  const PointCells cells(world(), grid, own);
  const std::vector<Point> all = world().all_gather_values(std::span<const Point>(own));
  int apart = 0;
  for (const Point centre : graded_points(4000, 3)) {
    const Point half{0.01 * std::abs(centre.x), 0.005 * std::abs(centre.y)};
    const Box box{centre - half, centre + half};
    const bool holds = std::any_of(all.begin(), all.end(), [&box](Point p) { return box.contains(p); });
    EXPECT_TRUE(cells.meet(box) || !holds);
    if (box.high.x < -0.1) {
      EXPECT_FALSE(cells.meet(box));
      ++apart;
    }
  }
  EXPECT_GT(apart, 100);
  for (const Point p : all) {  // boxes of one to a few coarse squares, with the point in a corner
    for (const double side : {0.0, 2e-4, 1e-3, 3e-3}) {
      EXPECT_TRUE(cells.meet({p, p + Point{side, side}}));
      EXPECT_TRUE(cells.meet({p - Point{side, side}, p}));
    }
  }
}

TEST(PointCells, OfARowEachBoxIsVisitedThatMeetsThem) {
  const std::vector<Point> everywhere = graded_points(3000, 50);
  const CurveGrid grid(world(), everywhere);
  const PointCells cells(world(), grid, std::span(everywhere).first(40));
  std::vector<Box> boxes;  // half of the rows begin at points of the cells; the last row of 32 is not full
  for (int i = 0; i < 1000; ++i) {
    const int row = i / 50;
    const Point begin = row % 2 == 0 ? everywhere[row] : Point{scattered(33, row, 0), scattered(33, row, 1)};
    const Point low = begin + Point{0.002 * (i % 50), 0};
    boxes.push_back({low, low + Point{0.002, 0.01 * (i % 3)}});
  }
  std::vector<std::size_t> met, visited;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (cells.meet(boxes[i])) met.push_back(i);
  }
  cells.for_each_met(
      boxes.size(), [&](std::size_t i) { return boxes[i]; }, [&](std::size_t i) { visited.push_back(i); });
  EXPECT_EQ(visited, met);
  EXPECT_GE(met.size(), 10U);
  EXPECT_LT(met.size(), 900U);
}

TEST(PointCells, OfNoPointsMeetNothing) {
  const std::vector<Point> points{{0, 0}, {1, 1}};
  const CurveGrid grid(world(), points);
  EXPECT_FALSE(PointCells(world(), grid, {}).meet({{0, 0}, {1, 1}}));
  EXPECT_TRUE(
      PointCells(world(), grid, std::span(points).first(world().rank() == 0 ? 1 : 0)).meet({{0, 0}, {1, 1}}));
}

TEST(CurvePartition, ABoxMeetsThePiecesOfItsPoints) {
  const std::vector<Point> points = graded_points(2000, 100 + static_cast<std::uint64_t>(world().rank()));
  const CurvePartition shares(world(), points, {});
  std::vector<int> ranks;
  for (int i = 0; i < 100; ++i) {
    const double size = std::ldexp(1.0, -(i % 12));
    const Point low{1.2 * scattered(31, i, 0), 1.2 * scattered(31, i, 1)};
    const Box box{low, low + Point{size * (1 + scattered(31, i, 2)), size * (1 + scattered(31, i, 3))}};
    shares.ranks_meeting(box, ranks);
    EXPECT_TRUE(std::is_sorted(ranks.begin(), ranks.end()));
    EXPECT_EQ(std::adjacent_find(ranks.begin(), ranks.end()), ranks.end());
    for (int k = 0; k < 40; ++k) {
      const Point p{box.low.x + box.width() * (k % 8) / 7, box.low.y + box.height() * (k / 8) / 4};
      const Point within{std::min(p.x, box.high.x), std::min(p.y, box.high.y)};
      EXPECT_TRUE(std::binary_search(ranks.begin(), ranks.end(), shares.rank_of(within)));
    }
  }
}

TEST(CurvePartition, SharesAreEven) {
  const std::vector<Point> points = graded_points(2000, 200 + static_cast<std::uint64_t>(world().rank()));
  const CurvePartition shares(world(), points, {});
  std::vector<std::int64_t> counts(world().size(), 0);
  for (const Point p : points) ++counts[shares.rank_of(p)];
  for (std::int64_t& count : counts) count = world().sum(count);
  for (const std::int64_t count : counts) EXPECT_NEAR(static_cast<double>(count), 2000, 400);
}

TEST(CurvePartition, TakesABoxWithoutExtentOrWithoutPoints) {
  const std::vector<Point> same(5, Point{3, 4}), none;
  std::vector<int> ranks;
  for (const auto& points : {same, none}) {
    const CurvePartition shares(world(), points, {});
    shares.ranks_meeting({{0, 0}, {9, 9}}, ranks);
    EXPECT_TRUE(std::binary_search(ranks.begin(), ranks.end(), shares.rank_of({3, 4})));
  }
}

/// A fan of triangles round the origin, under numbers that do not follow its order.
TEST(LocatePoints, OfSeveralTrianglesTheLowestNumberWins) {
  TrianglePiece piece;
  piece.points = IdVector<NodeId, Point>(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const std::array<std::int64_t, 4> numbers{5, 1LL << 40, 2, 7};
  for (std::int32_t k = 0; k < 4; ++k)
    piece.triangles.push_back({{NodeId{0}, NodeId{1 + k}, NodeId{1 + (k + 1) % 4}}, numbers[k]});
  const double next = std::nextafter(0.5, 1);
  const std::vector<Point> points{{0, 0},       {0.5, 0},   {0, 0.5},    {-0.5, 0}, {0, -0.5},
                                  {0.25, 0.25}, {0.5, 0.5}, {next, 0.5}, {-2, 0},   {-1, 0}};
  EXPECT_EQ(locate_points(piece, points), (std::vector<std::int32_t>{2, 0, 0, 2, 2, 0, 0, -1, -1, 2}));
  EXPECT_TRUE(locate_points(piece, {}).empty());
  EXPECT_EQ(locate_points({}, std::vector<Point>{{0, 0}}), std::vector<std::int32_t>{-1});
}

TEST(LocatePoints, ManyPointsAtOnePlaceAndInBigFansEnd) {
  TrianglePiece piece;
  constexpr std::int32_t blades = 60;
  piece.points.push_back({0, 0});
  for (std::int32_t k = 0; k < blades; ++k)
    piece.points.push_back({std::cos(6.28 * k / blades), std::sin(6.28 * k / blades)});
  for (std::int32_t k = 0; k + 1 < blades; ++k)
    piece.triangles.push_back({{NodeId{0}, NodeId{1 + k}, NodeId{2 + k}}, blades - k});
  const std::vector<Point> points(100, Point{0, 0});
  EXPECT_EQ(locate_points(piece, points), std::vector<std::int32_t>(100, blades - 2));
}

TEST(LinearValues, CornersKeepTheirBitsAndNothingGoesBeyond) {
  const std::array<Point, 3> corners{{{0, 0}, {1, 1e-9}, {0.3, 1}}};
  const std::array<std::array<double, 2>, 3> rows{{{-0.0, 1e300}, {0.1, -1e300}, {1.0 / 3, 7}}};
  std::array<double, 2> values{};
  for (std::size_t k = 0; k < 3; ++k) {
    interpolate_in_triangle(corners, {rows[0], rows[1], rows[2]}, corners[k], values);
    EXPECT_EQ(values, rows[k]);
    EXPECT_EQ(std::signbit(values[0]), std::signbit(rows[k][0]));
  }
  for (const Point p : {Point{-1, -1}, Point{5, 5}, Point{0.5, -3}, Point{0.4, 0.3}}) {  // also from outside
    interpolate_in_triangle(corners, {rows[0], rows[1], rows[2]}, p, values);
    EXPECT_GE(values[0], 0);
    EXPECT_LE(values[0], 1.0 / 3);
    EXPECT_LE(std::abs(values[1]), 1e300);
  }
}

TEST(LinearValues, AFlatTriangleIsItsSides) {
  const std::array<Point, 3> corners{{{0, 0}, {1, 0}, {2, 0}}};
  const std::array<double, 1> a{1}, b{2}, c{5};
  std::array<double, 1> value{};
  interpolate_in_triangle(corners, {a, b, c}, {0.5, 0.1}, value);
  EXPECT_EQ(value[0], 1.5);
  interpolate_in_triangle(corners, {a, b, c}, {1.5, 0}, value);
  EXPECT_EQ(value[0], 3.5);
}

}  // namespace
}  // namespace quadloop::adapt
