// Edges of a boundary become chains, walked from known ends.
#include "flow/postprocess/wall_walk.hpp"

#include <gtest/gtest.h>

namespace quadloop::flow {
namespace {

using Numbers = std::vector<std::vector<std::int64_t>>;

/// Edges between points of a list by their numbers.
std::vector<WallEdge> edges_of(const std::vector<Point>& points,
                               const std::vector<std::array<std::int64_t, 2>>& pairs) {
  std::vector<WallEdge> edges;
  for (const auto& [a, b] : pairs) edges.push_back({{a, points[a]}, {b, points[b]}});
  return edges;
}

Numbers numbers_of(const std::vector<WallEdge>& edges) {
  Numbers numbers;
  for (const auto& chain : walk(edges)) {
    numbers.emplace_back();
    for (const WallNode& node : chain) numbers.back().push_back(node.number);
  }
  return numbers;
}

const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Walk, OfALoopBeginsAtTheLowestOfTheNodesFarthestAlongX) {
  EXPECT_EQ(numbers_of(edges_of(square, {{3, 0}, {1, 2}, {0, 1}, {2, 3}})), (Numbers{{1, 2, 3, 0, 1}}));
  EXPECT_EQ(numbers_of(edges_of(square, {{0, 3}, {2, 1}, {1, 0}, {3, 2}})), (Numbers{{1, 0, 3, 2, 1}}));
}

TEST(Walk, OfAnOpenChainBeginsAtItsEnd) {
  EXPECT_EQ(numbers_of(edges_of(square, {{1, 2}, {2, 3}, {0, 1}})), (Numbers{{0, 1, 2, 3}}));
}

TEST(Walk, KeepsTheOrderInWhichEdgesNameTheChains) {
  std::vector<Point> points = square;
  for (const Point p : square) points.push_back(p + Point{5, 0});
  EXPECT_EQ(numbers_of(edges_of(points, {{4, 5}, {0, 1}, {5, 4}, {1, 0}})), (Numbers{{5, 4, 5}, {1, 0, 1}}));
  EXPECT_EQ(numbers_of(edges_of(points, {{4, 5}, {5, 4}, {2, 3}})), (Numbers{{5, 4, 5}, {2, 3}}));
}

TEST(Walk, PassesANodeWhereLoopsTouchOncePerLoop) {
  const std::vector<Point> points{{0, 0}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  const Numbers loops = numbers_of(edges_of(points, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}}));
  EXPECT_EQ(loops, (Numbers{{1, 2, 0, 1}, {0, 3, 4, 0}}));
}

TEST(Walk, OfNothingIsNothing) { EXPECT_TRUE(walk({}).empty()); }

}  // namespace
}  // namespace quadloop::flow
