// The rules that every tree keeps, checked leaf against leaf on one rank's copy of all leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

#include "mesher/forest/refine_forest.hpp"
#include "mesher/sizes/gradation.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "tests/sizes/diamond_sizes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

Geometry circle_in_square(double spacing, double second_spacing = 0) {
  std::vector<Point> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  for (int i = 0; i < 64; ++i) {
    const double angle = -2 * std::numbers::pi * i / 64;
    points.push_back({0.3 + 0.2 * std::cos(angle), -0.1 + 0.2 * std::sin(angle)});
    boundary.push_back(BoundaryId{1});
  }
  return {
      {{"frame", second_spacing, 30, "none"}, {"circle", spacing, 30, "wall"}}, points, {0, 4, 68}, boundary};
}

struct Tree {
  Tree(const Geometry& geometry, const SizeOptions& options, const std::vector<SplitDemand>& demands = {})
      : outline{geometry},
        grid{choose_root(geometry, options)},
        demanded{test::world(), demands},
        sizes{outline, grid, options, [](const Quadrant&, std::span<const std::int32_t>) { return false; },
              demanded},
        graph{refine_forest(test::world(), sizes)} {
    std::vector<Quadrant> local;
    for (const LeafId leaf : graph.local()) local.push_back(graph.leaf(leaf));
    leaves = test::world().all_gather_values(std::span<const Quadrant>(local));
  }
  /// Whether no part of it is in the domain.
  bool is_outside(const Quadrant& q) {
    SizeCursor cursor(sizes);
    return cursor.segments_in(q).empty() && !inside.contains(grid.box_of(q).centre());
  }
  ShiftedOutline outline;
  Interior inside{outline};
  TreeGrid grid;
  DemandedSplits demanded;
  SizeTree sizes;
  LeafGraph graph;
  std::vector<Quadrant> leaves;  // of all ranks
};

SizeOptions options_with(double min, double max, double gradation) {
  SizeOptions options;
  options.min = min;
  options.max = max;
  options.gradation = gradation;
  return options;
}

/// The nodes of a size tree that a rank has asked for which alone asks about all quadrants.
std::int64_t nodes_of_all(SizeTree sizes) {
  Gradation gradation(sizes);
  const std::function<void(const Quadrant&)> look_below = [&](const Quadrant& q) {
    if (q.level > 0 && !gradation.must_split(q)) return;
    for (const Corner quarter : corners_along_curve) look_below(q.child(quarter));
  };
  look_below({});
  return sizes.size();
}

TEST(RefineForest, RanksShareAnOutlineInOneQuarterOfTheRoot) {
  const test::DiamondSizes domain({{0.5, 0.5}, 0.3}, 0.0005, 0.00025, 0.0078125);
  SizeTree sizes = domain.tree();
  SizeTree estimated = domain.tree();
  refine_forest(test::world(), sizes, estimate_leaves(estimated));
  const auto most = static_cast<double>(test::world().maximum(std::int64_t{sizes.size()}));
  EXPECT_LT(most / static_cast<double>(nodes_of_all(domain.tree())), 1.0 / test::world().size() + 0.38);
}

TEST(TreeRules, LeavesTileTheRoot) {
  const Geometry geometry = circle_in_square(0.02);
  Tree tree(geometry, options_with(0.01, 0.25, 1.5));
  double area = 0;
  for (const Quadrant& q : tree.leaves) area += std::ldexp(1.0, -2 * q.level);
  EXPECT_EQ(area, 1.0);
}

TEST(TreeRules, SpacingIsKeptWhereTheGeometryIs) {
  const Geometry geometry = circle_in_square(0.02);
  Tree tree(geometry, options_with(0.001, 0.25, 1.5));
  SizeCursor cursor(tree.sizes);
  for (const Quadrant& q : tree.leaves) {
    const double size = tree.grid.edge(q.level);
    EXPECT_LE(size, 0.25);
    EXPECT_GE(size, 0.001);
    const auto segments = cursor.segments_in(q);
    const bool holds_circle =
        std::any_of(segments.begin(), segments.end(), [](std::int32_t s) { return s >= 4; });
    if (holds_circle) {
      EXPECT_LE(size, 0.02);
    }
  }
}

class TreeRulesAt : public testing::TestWithParam<double> {};

TEST_P(TreeRulesAt, NoLeafIsTooLargeForAWantedOne) {
  const Geometry geometry = circle_in_square(0.02);
  Tree tree(geometry, options_with(0.01, 0.5, GetParam()));
  const double slope = (GetParam() - 1) / 2;
  int target_leaves = 0;
  SizeCursor cursor(tree.sizes);
  for (const Quadrant& w : tree.leaves) {
    if (cursor.target_level(w) != w.level) continue;  // smaller than requested, so it requests nothing
    ++target_leaves;
    for (const Quadrant& q : tree.leaves) {
      if (tree.is_outside(q)) continue;
      EXPECT_LE(static_cast<double>(q.size()),
                static_cast<double>(w.size()) + slope * static_cast<double>(chebyshev_gap(q, w)) + 1);
    }
  }
  EXPECT_GT(target_leaves, 10);
}

TEST_P(TreeRulesAt, TouchingLeavesDifferByOneLevelAtMost) {
  const Geometry even = circle_in_square(0.02), uneven = circle_in_square(0.05, 0.06);
  for (const Geometry* geometry : {&even, &uneven}) {
    Tree tree(*geometry, options_with(0.01, 0.5, GetParam()));
    int other_levels = 0;
    for (const Quadrant& a : tree.leaves) {
      for (const Quadrant& b : tree.leaves) {
        if (chebyshev_gap(a, b) == 0) {
          EXPECT_LE(std::abs(a.level - b.level), 1);
          other_levels += a.level != b.level ? 1 : 0;
        }
      }
    }
    EXPECT_GT(test::world().sum(other_levels), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Gradations, TreeRulesAt, testing::Values(1.25, 1.5, 2.0));

/// Whether the leaf r lies on side s of q (0 the bottom, counter-clockwise) and is finer.
bool finer_on_side(const Quadrant& q, const Quadrant& r, int s) {
  if (r.level <= q.level) return false;
  const bool beside_x = r.x < q.x + q.size() && q.x < r.x + r.size(),
             beside_y = r.y < q.y + q.size() && q.y < r.y + r.size();
  switch (s) {
    case 0: return beside_x && r.y + r.size() == q.y;
    case 1: return beside_y && r.x == q.x + q.size();
    case 2: return beside_x && r.y == q.y + q.size();
    default: return beside_y && r.x + r.size() == q.x;
  }
}

bool is_squeezed(const Quadrant& q, const std::vector<Quadrant>& leaves) {
  std::array<bool, 4> finer{};
  for (const Quadrant& r : leaves) {
    for (int s = 0; s < 4; ++s) finer[s] |= finer_on_side(q, r, s);
  }
  return (finer[0] && finer[2]) || (finer[1] && finer[3]);
}

void split_by_size(const Quadrant& q, Tree& tree, Gradation& gradation, std::vector<Quadrant>& leaves) {
  if (q.level >= 1 && (tree.is_outside(q) || !gradation.must_split(q))) {
    leaves.push_back(q);
    return;
  }
  for (const Corner quarter : corners_along_curve) split_by_size(q.child(quarter), tree, gradation, leaves);
}

/// Whether it touches one more than a level finer.
bool is_too_large(const Quadrant& q, const std::vector<Quadrant>& leaves) {
  return std::any_of(leaves.begin(), leaves.end(),
                     [&](const Quadrant& r) { return r.level > q.level + 1 && chebyshev_gap(q, r) == 0; });
}

void split_while(const std::function<bool(const Quadrant&, const std::vector<Quadrant>&)>& must_split,
                 std::vector<Quadrant>& leaves) {
  for (std::size_t i = 0, kept = 0; kept < leaves.size(); i = (i + 1) % leaves.size(), ++kept) {
    const Quadrant q = leaves[i];
    if (!must_split(q, leaves)) continue;
    leaves[i] = q.child(corners_along_curve[0]);
    for (std::size_t k = 1; k < 4; ++k) leaves.push_back(q.child(corners_along_curve[k]));
    kept = 0;
  }
}

using Places = std::vector<std::array<std::int64_t, 3>>;
Places sorted_places(const std::vector<Quadrant>& leaves) {
  Places places;
  for (const Quadrant& q : leaves) places.push_back({q.x, q.y, q.level});
  std::sort(places.begin(), places.end());
  return places;
}

/// What sizes and gradation ask for in the domain, then leaves that touch much finer ones or lie between
/// finer ones split, one after another, until there is none.
std::vector<Quadrant> smallest_tree(Tree& tree) {
  std::vector<Quadrant> leaves;
  Gradation gradation(tree.sizes);
  for (int ty = 0; ty < tree.grid.trees_y(); ++ty) {
    for (int tx = 0; tx < tree.grid.trees_x(); ++tx)
      split_by_size({std::int64_t{tx} << Quadrant::unit_level, std::int64_t{ty} << Quadrant::unit_level, 0},
                    tree, gradation, leaves);
  }
  split_while(is_too_large, leaves);
  split_while(is_squeezed, leaves);
  return leaves;
}

/// The leaves of the wanted tree, of which those of the tree are parts.
std::vector<Quadrant> target_leaves(Tree& tree) {
  SizeCursor cursor(tree.sizes);
  std::vector<Quadrant> wanted;
  for (const Quadrant& q : tree.leaves) {
    const int level = cursor.target_level(q);
    const std::int64_t mask = ~((std::int64_t{1} << (Quadrant::unit_level - level)) - 1);
    wanted.push_back({q.x & mask, q.y & mask, level});
  }
  return wanted;
}

/// Whether sizes or gradation forbid a leaf here: a wanted one lies in it, or is too small and too near.
bool is_forbidden(const Quadrant& q, const std::vector<Quadrant>& wanted, double slope) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const Quadrant& w) {
    const bool too_near =
        static_cast<double>(q.size() - w.size()) > slope * static_cast<double>(chebyshev_gap(q, w));
    return (q.contains(w) && w.level > q.level) || too_near;
  });
}

/// Nothing is split but what sizes and gradation ask for, and leaves between two finer ones, in the end and
/// one after another.
TEST_P(TreeRulesAt, TheTreeIsTheSmallest) {
  const Geometry even = circle_in_square(0.02), uneven = circle_in_square(0.05, 0.06);
  int squeezed = 0;
  for (const Geometry* geometry : {&even, &uneven}) {
    Tree tree(*geometry, options_with(0.01, 0.5, GetParam()));
    EXPECT_EQ(sorted_places(tree.leaves), sorted_places(smallest_tree(tree)));
    const std::vector<Quadrant> wanted = target_leaves(tree);
    Gradation gradation(tree.sizes);
    for (const Quadrant& q : tree.leaves) {
      const Quadrant parent{q.x & ~(q.size() * 2 - 1), q.y & ~(q.size() * 2 - 1), q.level - 1};
      if (q.level <= 1 || q.x != parent.x || q.y != parent.y) continue;
      if (tree.is_outside(parent)) continue;
      const bool forbidden = is_forbidden(parent, wanted, (GetParam() - 1) / 2);
      EXPECT_EQ(forbidden, gradation.must_split(parent));
      if (forbidden) continue;
      ++squeezed;
      EXPECT_TRUE(is_squeezed(parent, tree.leaves))
          << parent.x << ", " << parent.y << ", level " << parent.level;
    }
  }
  EXPECT_EQ(squeezed, GetParam() == 1.25 ? 0 : GetParam() == 1.5 ? 9 : 1);
}

/// Sides on grid lines, and others through grid vertices, with a corner of the outline on some.
TEST_P(TreeRulesAt, TheTreeIsTheSmallestWhereTheOutlineRunsAlongLatticeLines) {
  const test::Diamond diamond{{0, 0}, 0.5};
  const Geometry geometry =
      test::diamond_in_square(diamond, {"frame", 0.125, 30, "none"}, {"wall", 0.015625, 30, "wall"});
  SizeOptions options = options_with(0.01, 0.5, GetParam());
  options.root = {{-2, -2}, 4};
  Tree tree(geometry, options);
  EXPECT_EQ(sorted_places(tree.leaves), sorted_places(smallest_tree(tree)));
  std::array<int, 10> outside{};  // by level
  for (const Quadrant& q : tree.leaves) outside[q.level] += tree.is_outside(q) ? 1 : 0;
  EXPECT_GT(outside[1] + outside[2] + outside[3], 0);
  EXPECT_GT(outside[7], 0);
}

TEST(TreeRules, LeavesThatSplittingSqueezesAreSplitToo) {
  // Slanting lines of small leaves a few large ones apart: what is split between two squeezes the next.
  SizeOptions options = options_with(0.02, 0.5, 2.0);
  for (int k = 0; k < 4; ++k) {
    const double x = -0.9 + 0.41 * k;
    options.sources.push_back({SizeSource::Line{{x, -0.8}, {x + 0.3, 0.9}}, 0.03 + 0.02 * k, {}});
  }
  const Geometry geometry = circle_in_square(0.5, 0.5);
  Tree tree(geometry, options);
  EXPECT_EQ(sorted_places(tree.leaves), sorted_places(smallest_tree(tree)));
}

TEST(TreeRules, RanksShareTheWorkOfCutting) {
  const Geometry geometry = circle_in_square(0.02);
  Tree tree(geometry, options_with(0.005, 0.25, 1.25));  // none of its leaves is squeezed
  SizeCursor cursor(tree.sizes);
  std::int64_t own = 0;
  for (const LeafId leaf : tree.graph.local())
    own += cursor.segments_in(tree.graph.leaf(leaf)).empty() ? weight_uncut : weight_cut;
  const std::int64_t ranks = test::world().size(), all = test::world().sum(own);
  const double even = 1.02 * static_cast<double>(all);
  EXPECT_LE(static_cast<double>(own * ranks), std::max(even, static_cast<double>(all + ranks * weight_cut)))
      << "a fiftieth more than others, or a leaf";
}

TEST(TreeRules, NoLeafLiesBetweenFinerOnes) {
  const Geometry geometry = circle_in_square(0.05, 0.06);
  Tree tree(geometry, options_with(0.02, 0.5, 2.0));
  for (const LeafId leaf : tree.graph.local()) {
    EXPECT_FALSE(tree.graph.around(leaf).finer.has_opposites());
  }
}

TEST(TreeRules, SourcesRefineWithoutGeometry) {
  const Geometry geometry = circle_in_square(0.1);
  SizeOptions options = options_with(0.005, 0.5, 1.5);
  Box box;
  box.include(Point{-0.9, -0.9});
  box.include(Point{-0.7, -0.8});
  options.sources = {{box, 0.01},
                     {SizeSource::Disc{{-0.5, 0.5}, 0.1}, 0.02},
                     {SizeSource::Line{{0.5, 0.6}, {0.9, 0.9}}, 0.02}};
  Tree tree(geometry, options);
  const auto size_at = [&](Point p) {
    for (const Quadrant& q : tree.leaves) {
      if (tree.grid.box_of(q).contains(p)) return tree.grid.edge(q.level);
    }
    return 0.0;
  };
  EXPECT_LE(size_at({-0.8, -0.85}), 0.01);
  EXPECT_LE(size_at({-0.5, 0.5}), 0.02);
  EXPECT_LE(size_at({0.7, 0.75}), 0.02);
  EXPECT_GT(size_at({-0.9, 0.9}), 0.02);
}

TEST(TreeRules, DemandsRefineBelowTheCasesSmallestLeaf) {
  const Geometry geometry = circle_in_square(0.1);
  const SizeOptions options = options_with(0.05, 0.5, 1.5);
  Tree before(geometry, options);
  const auto by_level = [&](const Quadrant& q) { return before.is_outside(q) ? 100 : q.level; };
  const auto coarsest = std::ranges::min_element(before.leaves, {}, by_level);
  using enum Corner;
  const Quadrant deep =
      coarsest->child(north_east).child(south_west).child(north_east).child(north_east).child(south_west);
  const std::vector<SplitDemand> demands{{deep, 1U << deep.level}};
  Tree after(geometry, options, test::world().is_root() ? demands : std::vector<SplitDemand>{});
  EXPECT_LT(after.grid.edge(deep.level + 1), 0.05);
  int split = 0;
  for (const Quadrant& q : after.leaves) {
    EXPECT_FALSE(q.contains(deep));
    if (deep.contains(q)) split += q.level == deep.level + 1 ? 1 : 0;
    for (const Quadrant& r : after.leaves) {
      if (chebyshev_gap(q, r) == 0) {
        EXPECT_LE(std::abs(q.level - r.level), 1);
      }
    }
  }
  EXPECT_EQ(split, 4);
  for (const Quadrant& q : before.leaves) {
    const bool kept = std::any_of(after.leaves.begin(), after.leaves.end(),
                                  [&](const Quadrant& r) { return q.contains(r); });
    EXPECT_TRUE(kept) << "the new tree is a refinement of the old one";
  }
}

TEST(TreeRules, GapsAreResolvedButCornersAreNot) {
  // Two bars 0.02 apart, which their own spacing of 0.2 would not resolve.
  const std::vector<Point> points{{-1, -1},      {1, -1},       {1, 1},       {-1, 1},
                                  {-0.5, 0.01},  {-0.5, 0.21},  {0.5, 0.21},  {0.5, 0.01},
                                  {-0.5, -0.21}, {-0.5, -0.01}, {0.5, -0.01}, {0.5, -0.21}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  boundary.resize(12, BoundaryId{1});
  const Geometry geometry({{"frame", 0.5, 30, "none"}, {"bars", 0.2, 30, "wall"}}, points, {0, 4, 8, 12},
                          boundary);
  SizeOptions options = options_with(0.001, 0.5, 1.5);
  const Tree coarse(geometry, options);
  options.gap = 2;
  const Tree fine(geometry, options);
  int finest_coarse = 0, finest_fine = 0, at_frame_corner = 0;
  for (const Quadrant& q : coarse.leaves) finest_coarse = std::max(finest_coarse, q.level);
  for (const Quadrant& q : fine.leaves) {
    finest_fine = std::max(finest_fine, q.level);
    if (fine.grid.box_of(q).contains({-1, -1})) at_frame_corner = q.level;
  }
  EXPECT_GT(fine.grid.edge(finest_coarse), 0.05);
  EXPECT_LE(fine.grid.edge(finest_fine), 0.01);
  EXPECT_GT(fine.grid.edge(finest_fine), 0.004);
  EXPECT_GE(fine.grid.edge(at_frame_corner), 0.1)
      << "the two sides of a corner are no gap; gradation from the bars allows 0.125 there";
}

/// A kite whose tip at the origin, on grid lines, turns by 150 degrees or so; its two boundaries merely
/// meet in the bend at its widest point below.
Geometry kite_in_square(double corner_degrees) {
  const std::vector<Point> points{{-1, -1},      {1, -1},        {1, 1},        {-1, 1},     {0, 0},
                                  {-0.5, -0.13}, {-0.77, -0.18}, {-0.77, 0.13}, {-0.5, 0.13}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  boundary.resize(9, BoundaryId{1});
  boundary[4] = BoundaryId{2};
  return {
      {{"frame", 0.5, 30, "none"}, {"kite", 0.5, corner_degrees, "wall", 0.01}, {"below", 0.5, 140, "wall"}},
      points,
      {0, 4, 9},
      boundary};
}

/// The edges of the largest and of the smallest leaf that touch a point.
std::pair<double, double> edges_at(const Tree& tree, Point p) {
  std::pair<double, double> edges{0, 10};
  for (const Quadrant& q : tree.leaves) {
    if (!tree.grid.box_of(q).contains(p)) continue;
    edges = {std::max(edges.first, tree.grid.edge(q.level)), std::min(edges.second, tree.grid.edge(q.level))};
  }
  return edges;
}

TEST(TreeRules, SharpCornersRefineAllLeavesThatTouchThem) {
  const Geometry geometry = kite_in_square(120);
  Tree tree(geometry, options_with(0.001, 0.5, 1.5));
  EXPECT_LE(edges_at(tree, {0, 0}).first, 0.01)
      << "the tip lies where four leaves meet: mirror images must agree";
  EXPECT_GT(edges_at(tree, {0, 0}).second, 0.004);
  EXPECT_GT(edges_at(tree, {-0.5, -0.13}).second, 0.05)
      << "two boundaries meet there, but the outline hardly turns";
  EXPECT_GT(edges_at(tree, {-0.77, 0.13}).second, 0.05) << "it turns by less than 'corner'";
  EXPECT_GT(edges_at(tree, {1, 1}).second, 0.05) << "the frame asks for nothing at its corners";
  const Geometry with_all_corners = kite_in_square(30);
  EXPECT_LE(edges_at(Tree(with_all_corners, options_with(0.001, 0.5, 1.5)), {-0.77, 0.13}).first, 0.01);
  EXPECT_GT(edges_at(Tree(with_all_corners, options_with(0.04, 0.5, 1.5)), {0, 0}).second, 0.04)
      << "min bounds it";
}

TEST(TreeRules, CornerSpacingCountsInTheDigestOnlyWhereItIsSet) {
  Geometry with = kite_in_square(120);
  std::vector<Boundary> boundaries(with.boundaries().begin(), with.boundaries().end());
  const auto digest_with = [&](double corner_spacing) {
    boundaries[1].corner_spacing = corner_spacing;
    std::vector<BoundaryId> boundary;
    for (std::int32_t v = 0; v < with.size(); ++v) boundary.push_back(with.boundary_of(v));
    return Geometry(boundaries, {with.points().begin(), with.points().end()}, {0, 4, 9}, boundary).digest();
  };
  EXPECT_EQ(digest_with(0.01), with.digest());
  EXPECT_NE(digest_with(0.02), with.digest());
  EXPECT_NE(digest_with(0), with.digest());
}

}  // namespace
}  // namespace quadloop
