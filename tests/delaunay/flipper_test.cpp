// Edges are flipped until the triangulation is constrained Delaunay: unique under a strict order of nodes,
// whatever triangles it began with.
#include "mesher/delaunay/flipper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/delaunay/delaunay_patch.hpp"

namespace quadloop {
namespace {

using Triangle = Flipper::Triangle;
/// The list must outlive it.
Flipper::RankOf ranked(const std::vector<TieRank>& ranks) {
  return [&ranks](std::int32_t node) { return ranks[node]; };
}

using Triangles = std::vector<Triangle>;

/// Nodes of a square grid, many on one circle, or moved a little.
struct Grid {
  explicit Grid(std::int32_t cells, double noise = 0) : n{cells} {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> off(-noise, noise);
    for (std::int32_t j = 0; j <= n; ++j) {
      for (std::int32_t i = 0; i <= n; ++i) {
        const bool inner = 0 < i && i < n && 0 < j && j < n;
        points.push_back({i + (inner ? off(random) : 0), j + (inner ? off(random) : 0)});
      }
    }
    for (const Point& p : points) ranks.push_back(tie_rank({0.3 * n, 0.45 * n}, p));
  }

  /// Each square cut along a diagonal by lot.
  Triangles split(unsigned seed) const {
    std::mt19937_64 random(seed);
    Triangles triangles;
    for (std::int32_t j = 0; j < n; ++j) {
      for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
        const bool first = (random() & 1) != 0;
        triangles.push_back(first ? Triangle{a, b, c} : Triangle{a, b, d});
        triangles.push_back(first ? Triangle{a, c, d} : Triangle{b, c, d});
      }
    }
    return triangles;
  }

  Point at(std::int32_t node) const { return points[node]; }
  const TieRank& rank(std::int32_t node) const { return ranks[node]; }

  std::int32_t n;
  std::vector<Point> points;
  std::vector<TieRank> ranks;
};

Triangles sorted(Triangles triangles) {
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// No node inside any circumcircle; the nodes on one are joined to the highest of them.
void expect_delaunay(const Grid& grid, const Triangles& triangles) {
  for (const Triangle& t : triangles) {
    EXPECT_TRUE(is_positive(grid.at(t[0]), grid.at(t[1]), grid.at(t[2])));
    const TieRank& highest = std::max({grid.rank(t[0]), grid.rank(t[1]), grid.rank(t[2])});
    for (std::int32_t node = 0; node < size32(grid.points); ++node) {
      if (std::find(t.begin(), t.end(), node) != t.end()) continue;
      const int inside = in_circle(grid.at(t[0]), grid.at(t[1]), grid.at(t[2]), grid.at(node));
      EXPECT_LE(inside, 0);
      if (inside == 0) {
        EXPECT_LT(grid.rank(node), highest);
      }
    }
  }
}

TEST(Flipper, OneResultFromAnyDiagonals) {
  for (const double noise : {0.0, 0.2}) {
    const Grid grid(12, noise);
    Flipper flipper;
    Triangles first;
    for (unsigned seed = 0; seed < 5; ++seed) {
      Triangles triangles = grid.split(seed);
      flipper.flip_to_delaunay(grid.points, ranked(grid.ranks), triangles);
      expect_delaunay(grid, triangles);
      if (seed == 0) first = sorted(triangles);
      EXPECT_EQ(sorted(triangles), first);
    }
  }
}

/// Squares come row by row, and each keeps its two places.
TEST(Flipper, LooksAtEdgesOfTheFirstTrianglesAlone) {
  const Grid grid(12);
  Triangles all = grid.split(1);
  Flipper().flip_to_delaunay(grid.points, ranked(grid.ranks), all);
  const std::size_t rows = 5, first = rows * 2 * 12;
  const Triangles wrong = grid.split(1);
  ASSERT_NE(sorted(wrong), sorted(all));
  Triangles mixed = all;
  std::copy_n(wrong.begin(), first, mixed.begin());
  ASSERT_NE(sorted(mixed), sorted(all));
  Flipper().flip_first(grid.points, ranked(grid.ranks), mixed, first);
  EXPECT_EQ(sorted(mixed), sorted(all)) << "no others were wrong";
  mixed = wrong;
  Flipper().flip_first(grid.points, ranked(grid.ranks), mixed, first);
  EXPECT_TRUE(std::equal(wrong.begin() + first, wrong.end(), mixed.begin() + first));
}

TEST(Flipper, RemembersNothingOfTheLastTriangulation) {
  const Grid large(9, 0.2), small(3, 0.2);
  Flipper used, fresh;
  Triangles triangles = large.split(1), again = small.split(1), expected = again;
  used.flip_to_delaunay(large.points, ranked(large.ranks), triangles);
  used.flip_to_delaunay(small.points, ranked(small.ranks), again);
  fresh.flip_to_delaunay(small.points, ranked(small.ranks), expected);
  EXPECT_EQ(again, expected);
}

/// A quadrilateral whose longer diagonal, from the first node to the third, is not Delaunay.
const std::vector<Point> kite{{-2, 0}, {0, -1}, {2, 0}, {0, 1}};
const std::vector<TieRank> kite_ranks(4);
const Triangles kite_triangles{{0, 1, 2}, {0, 2, 3}};

TEST(Flipper, KeepsEdgesBetweenBlocks) {
  Triangles triangles = kite_triangles;
  const std::vector<std::int32_t> two{0, 1}, one{7, 7};
  Flipper flipper;
  flipper.flip_to_delaunay(kite, ranked(kite_ranks), triangles, {}, two);
  EXPECT_EQ(triangles, kite_triangles);
  flipper.flip_to_delaunay(kite, ranked(kite_ranks), triangles, {}, one);
  EXPECT_EQ(sorted(triangles), (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

/// Of four nodes on one circle the ranks choose the diagonal, unless none of them has moved.
TEST(Flipper, DiagonalsOfNodesThatHaveStayedGiveWayToNoTie) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<TieRank> ranks(4);
  ranks[1].farther = 1;
  Flipper flipper;
  for (std::size_t node = 0; node <= 4; ++node) {
    std::vector<char> moved(5, 0);
    moved[node] = 1;
    moved.resize(4);
    Triangles triangles = kite_triangles;
    flipper.flip_to_delaunay(square, ranked(ranks), triangles, {}, {}, moved);
    EXPECT_EQ(triangles == kite_triangles, node == 4) << node;
    triangles = kite_triangles;
    flipper.flip_to_delaunay(square, ranked(ranks), triangles);
    EXPECT_NE(triangles, kite_triangles) << "nothing is remembered";
  }
}

/// Under other ranks all diagonals of a grid are ties that flip, but where nodes have stayed.
TEST(Flipper, FarFromMovedNodesNothingFlips) {
  Grid grid(12, 0);
  Triangles before = grid.split(1);
  Flipper flipper;
  flipper.flip_to_delaunay(grid.points, ranked(grid.ranks), before);
  std::vector<TieRank> other = grid.ranks;
  for (std::size_t node = 0; node < other.size(); ++node)
    other[node].coarser = static_cast<std::int8_t>(node % 2);
  const std::size_t middle = grid.points.size() / 2;
  grid.points[middle] = grid.points[middle] + Point{0.31, 0.17};
  std::vector<char> moved(grid.points.size(), 0);
  moved[middle] = 1;
  Triangles with_flags = before, without = before;
  flipper.flip_to_delaunay(grid.points, ranked(other), with_flags, {}, {}, moved);
  flipper.flip_to_delaunay(grid.points, ranked(other), without);
  const auto changed = [&](const Triangles& after) {
    int count = 0;
    const Triangles known = sorted(before);
    for (const Triangle& t : sorted(after))
      count += std::binary_search(known.begin(), known.end(), t) ? 0 : 1;
    return count;
  };
  EXPECT_GT(changed(without), 50);
  EXPECT_LT(changed(with_flags), 20);
  for (const Triangle& t : with_flags) {
    EXPECT_TRUE(is_positive(grid.at(t[0]), grid.at(t[1]), grid.at(t[2])));
    for (std::int32_t node = 0; node < size32(grid.points); ++node)
      EXPECT_LE(in_circle(grid.at(t[0]), grid.at(t[1]), grid.at(t[2]), grid.at(node)), 0);
  }
}

/// So small that products of lengths vanish in double precision, though exactly it ought to be flipped.
TEST(Flipper, MakesNoTriangleThatIsNotPositive) {
  std::vector<Point> tiny;
  for (const Point& p : kite) tiny.push_back(0x1p-600 * p);
  ASSERT_GT(in_circle(tiny[0], tiny[2], tiny[3], tiny[1]), 0);
  ASSERT_FALSE(is_positive(tiny[0], tiny[1], tiny[3]));
  Triangles triangles = kite_triangles;
  Flipper flipper;
  flipper.flip_to_delaunay(tiny, ranked(kite_ranks), triangles);
  EXPECT_EQ(triangles, kite_triangles);
}

/// The same edge is seen from both sides, and has the same nodes there; the others are at the border.
TEST(Flipper, KnowsWhatIsAcross) {
  const Grid grid(5, 0.2);
  Triangles triangles = grid.split(2);
  const std::vector<char> open(triangles.size(), 1);
  Flipper flipper;
  for (const bool is_open : {false, true}) {
    flipper.flip_to_delaunay(grid.points, ranked(grid.ranks), triangles,
                             is_open ? std::span<const char>(open) : std::span<const char>());
    int outer = 0, inner = 0;
    for (Flipper::Edge e = 0; e < static_cast<Flipper::Edge>(3 * triangles.size()); ++e) {
      const auto node = [&](Flipper::Edge edge, int step) {
        return triangles[Flipper::triangle_of(edge)][Flipper::corner_of(edge, step)];
      };
      const Flipper::Edge other = flipper.across(e);
      if (other < 0) {
        EXPECT_EQ(other, is_open ? Flipper::open_border : Flipper::border);
        ++outer;
        continue;
      }
      EXPECT_EQ(flipper.across(other), e);
      EXPECT_EQ(node(e, 1), node(other, 2));
      EXPECT_EQ(node(e, 2), node(other, 1));
      ++inner;
    }
    EXPECT_EQ(outer, 4 * grid.n);
    EXPECT_EQ(outer + inner, 3 * std::ssize(triangles));
  }
}

TEST(ShouldFlip, OnOneCircleTheHighestRankGetsTheEdge) {
  const Point a{0, 0}, b{1, 1}, c{0, 1}, d{1, 0};
  for (std::size_t highest = 0; highest < 4; ++highest) {
    std::array<TieRank, 4> ranks;
    ranks[highest].farther = 1;
    EXPECT_EQ(should_flip(a, b, c, d, [&](std::size_t k) { return ranks[k]; }), highest >= 2);
  }
  EXPECT_FALSE(should_flip(a, b, c, d, [](std::size_t) { return TieRank{}; }));
}

/// Only triangles whose circles keep clear of the open side are final.
TEST(DelaunayPatch, DoubtsWhatAnOpenBorderMightUndo) {
  const Grid grid(10);
  const Triangles triangles = grid.split(4);
  std::vector<char> open(triangles.size(), 0);
  EXPECT_EQ(DelaunayPatch(grid.points, ranked(grid.ranks), triangles, open).doubtful(), open);
  std::fill(open.begin(), open.begin() + 2 * grid.n,
            1);  // the lowest row of squares, and so three sides of it
  const DelaunayPatch patch(grid.points, ranked(grid.ranks), triangles, open);
  const std::vector<char> doubts = patch.doubtful();
  for (std::size_t t = 0; t < doubts.size(); ++t) {
    double lowest = grid.n;
    for (const std::int32_t node : patch.triangles()[t]) lowest = std::min(lowest, patch.point(node).y);
    if (lowest != 1) {
      EXPECT_EQ(doubts[t] != 0, lowest == 0);
    }
  }
}

/// An edge that no other triangle has counts where both its ends may be meant.
TEST(DelaunayPatch, KnowsEdgesOfOneTriangle) {
  const Grid grid(5, 0.2);
  const DelaunayPatch patch(grid.points, ranked(grid.ranks), grid.split(3), {});
  const auto edge_of = [](const Triangle& t, std::size_t k) { return std::minmax({t[k], t[(k + 1) % 3]}); };
  std::map<std::pair<std::int32_t, std::int32_t>, int> having;
  for (const Triangle& t : patch.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) ++having[edge_of(t, k)];
  }
  const auto odd = [](std::int32_t node) { return node % 2 == 1; };
  const auto any = [](std::int32_t) { return true; };
  int single = 0, both_odd = 0;
  for (std::size_t i = 0; i < patch.triangles().size(); ++i) {
    bool has_single = false, has_odd = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = edge_of(patch.triangles()[i], k);
      const bool alone = having[{low, high}] == 1;
      has_single = has_single || alone;
      has_odd = has_odd || (alone && odd(low) && odd(high));
    }
    EXPECT_EQ(patch.has_single_edge(i, any), has_single);
    EXPECT_EQ(patch.has_single_edge(i, odd), has_odd);
    single += has_single ? 1 : 0;
    both_odd += has_odd ? 1 : 0;
  }
  EXPECT_GT(single, both_odd);
  EXPECT_GT(both_odd, 0);
}

}  // namespace
}  // namespace quadloop
