// Which grid vertices move onto the outline and where to, by hand: on the square from 0 to 4 in leaves of
// edge 1.
#include "mesher/snap/snap_corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/snap/capture_points.hpp"
#include "tests/snap/traced_leaves.hpp"

namespace quadloop {
namespace {

using test::TracedLeaves;
using Points = std::vector<Point>;

constexpr double share = 0.4;
constexpr double kept = 30, none_kept = 180;  // degrees

/// A snap as all ranks agree on it, in the geometry's lengths.
struct Moved {
  Point corner, position;  // for an edge: its middle
  int absorbed = 0;
  bool on_edge = false;
  friend auto operator<=>(const Moved&, const Moved&) = default;
};

std::ostream& operator<<(std::ostream& out, const Moved& m) {
  return out << "(" << m.corner.x << ", " << m.corner.y << ")" << (m.on_edge ? " edge" : "") << " to ("
             << m.position.x << ", " << m.position.y << ") with " << m.absorbed;
}

/// Each rank's snaps at its own leaves, put together.
std::vector<Moved> agreed(const TracedLeaves& leaves, const std::vector<Snap>& snaps) {
  std::vector<Moved> own;
  for (const Snap& s : snaps) {
    if (leaves.at_local_leaf(s.corner))
      own.push_back(
          {leaves.grid.corner(s.corner), s.position, static_cast<int>(s.absorbed.size()), s.on_edge});
  }
  std::vector<Moved> all = test::world().all_gather_values(std::span<const Moved>(own));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<Moved> snapped(const Geometry& geometry, const Box& fine = {{0, 0}, {4, 4}},
                           std::optional<MirrorAxis> mirror = {}, Point low = {}) {
  const TracedLeaves leaves(geometry, fine, low);
  const std::vector<Snap> snaps =
      choose_snaps(leaves.graph, leaves.grid, leaves.geometry, leaves.traced, share, mirror);
  for (const Snap& s : snaps) EXPECT_EQ(s.leaves_round, LeafFinder(leaves.graph).leaves_round(s.corner));
  return agreed(leaves, snaps);
}

/// Of these the one at a corner; none where there is none.
std::optional<Moved> at(const std::vector<Moved>& moved, Point corner) {
  const auto found =
      std::find_if(moved.begin(), moved.end(), [&](const Moved& m) { return m.corner == corner; });
  return found == moved.end() ? std::nullopt : std::optional(*found);
}

/// The domain above a polyline from left to right, which goes on level beyond both ends.
Geometry above(Points line, double corner = kept) {
  line.insert(line.begin(), {-1, line.front().y});
  line.push_back({5, line.back().y});
  line.push_back({5, 9});
  line.push_back({-1, 9});
  return test::loops_of({line}, corner);
}

TEST(SnapCorners, CornersTakeTheCrossingsNearThem) {
  std::vector<Moved> expected;
  for (int i = 0; i <= 4; ++i) expected.push_back({{1.0 * i, 1}, {1.0 * i, 1.125}, 1});
  EXPECT_EQ(snapped(above({{0, 1.125}})), expected);
  EXPECT_EQ(snapped(above({{0, 1.39}})).size(), 5U);
  EXPECT_TRUE(snapped(above({{0, 1.41}})).empty()) << "farther than the share of the edge";
}

TEST(SnapCorners, TheNearestPointOfTheRunIsTheTarget) {
  // Along x + y = 2.25 the corners (0, 2) to (2, 0) each see a crossing east and one north of them.
  const auto moved = snapped(test::loops_of({{{-2, 4.25}, {4.25, -2}, {9, 9}}}));
  EXPECT_EQ(at(moved, {1, 1}), (Moved{{1, 1}, {1.125, 1.125}, 2}));
  EXPECT_EQ(at(moved, {2, 0}), (Moved{{2, 0}, {2.125, 0.125}, 2}));
  EXPECT_EQ(moved.size(), 3U);
}

TEST(SnapCorners, OfTwoRunsTheNearerOneIsTaken) {
  const auto channel = [](double low, double high) {
    return test::loops_of({{{-1, low}, {5, low}, {5, high}, {-1, high}}});
  };
  EXPECT_EQ(at(snapped(channel(0.75, 1.125)), {2, 1}), (Moved{{2, 1}, {2, 1.125}, 1}));
  EXPECT_EQ(at(snapped(channel(0.875, 1.25)), {2, 1}), (Moved{{2, 1}, {2, 0.875}, 1}));
  EXPECT_TRUE(snapped(channel(0.875, 1.125)).empty()) << "equally near";
  EXPECT_EQ(at(snapped(channel(1.125, 1.25)), {2, 1}), (Moved{{2, 1}, {2, 1.125}, 1})) << "on one edge";
}

TEST(SnapCorners, NoCrossingIsPassedOver) {
  // The slope comes nearest to the corner (2, 1), but the pond crosses the edge east of it before the slope
  // does.
  const Points slope{{-1, 1.33}, {1.4, 1.33}, {2.9, 0.83}, {5, 0.83}, {5, 9}, {-1, 9}};
  Points pond;
  for (int i = 0; i < 16; ++i) {
    const double angle = std::numbers::pi * i / 8;
    pond.push_back({2.2 + 0.03 * std::cos(angle), 1 + 0.03 * std::sin(angle)});
  }
  EXPECT_TRUE(at(snapped(test::loops_of({slope}, none_kept)), {2, 1}).has_value());
  EXPECT_EQ(at(snapped(test::loops_of({slope, pond}, none_kept)), {2, 1}), std::nullopt);
}

TEST(SnapCorners, NoVertexVanishesThatStraysFromTheOutline) {
  // A bump round the corner (2, 1), which no vertex of is kept: from the corner on the outline goes on level.
  const auto bump = [](double height) {
    return above({{1.75, 1.125}, {2, 1.125 + height}, {2.25, 1.125}}, none_kept);
  };
  EXPECT_EQ(at(snapped(bump(0)), {2, 1}), (Moved{{2, 1}, {2, 1.125}, 1}));
  const auto low = at(snapped(bump(0.0625)), {2, 1});
  ASSERT_TRUE(low.has_value());
  EXPECT_LT(low->position.y, 1.1875);
  EXPECT_EQ(low->absorbed, 1);
  EXPECT_EQ(at(snapped(bump(0.25)), {2, 1}), std::nullopt) << "it takes more than one point to follow";
  const auto peak = above({{1.75, 0.5}, {2, 1.25}, {2.25, 0.5}}, none_kept);
  EXPECT_EQ(at(snapped(peak), {2, 1}), (Moved{{2, 1}, {2, 1.25}, 3}))
      << "the point that strays is the target";
}

TEST(SnapCorners, AZigzagIsOneRunHoweverOftenItCrosses) {
  constexpr double step = 1.0 / 2048, height = 0.1 * step;  // no turn is sharp
  const auto turn = [&](int k) { return Point{(k + 0.25) * step, 1 + (k % 2 == 0 ? -height : height)}; };
  Points zigzag;
  for (int k = -1000; k <= 9000; ++k) zigzag.push_back(turn(k));
  std::vector<Moved> expected;
  for (int i = 0; i <= 4; ++i) {  // each takes what is nearer to it than to the next one, and one on x = i
    const Point corner{1.0 * i, 1};
    const int last = 2048 * i - 1;  // that the outline passes before the corner
    expected.push_back(
        {corner, nearest_on_segment(corner, turn(last), turn(last + 1)), i == 0 || i == 4 ? 1025 : 2049});
  }
  EXPECT_EQ(snapped(above(zigzag, none_kept)), expected);
  EXPECT_TRUE(snapped(above(zigzag, 10)).empty()) << "more than one kept point would vanish";
}

TEST(SnapCorners, AKeptPointTakesTheCornerAndItsRunAlong) {
  const auto quarter = [](Point tip) { return test::loops_of({{tip, {9, tip.y}, {9, 9}, {tip.x, 9}}}); };
  EXPECT_EQ(at(snapped(quarter({1.125, 1.25})), {1, 1}), (Moved{{1, 1}, {1.125, 1.25}, 0}))
      << "no crossing is near";
  EXPECT_EQ(at(snapped(quarter({1.125, 0.75})), {1, 1}), (Moved{{1, 1}, {1.125, 0.75}, 1}));
  EXPECT_EQ(at(snapped(quarter({0.75, 0.875})), {1, 1}), (Moved{{1, 1}, {0.75, 0.875}, 2}));
  EXPECT_EQ(at(snapped(quarter({1.4375, 1.4375})), {1, 1}), std::nullopt) << "too far from it";
}

/// Wedges of domain that point down, each with its tip here.
Geometry wedges(const Points& tips) {
  std::vector<Points> loops;
  for (const Point tip : tips) loops.push_back({tip, {tip.x + 0.0625, 5}, {tip.x - 0.0625, 5}});
  return test::loops_of(loops);
}

TEST(CapturePoints, TheNearerOfTwoPointsHasTheCorner) {
  const auto captured = [](const Points& tips) {
    const TracedLeaves leaves(wedges(tips));
    const Captures found = capture_points(leaves.graph, leaves.grid, leaves.geometry, leaves.traced, share);
    Points own;
    for (const CornerCapture& c : found.corners) {
      if (leaves.grid.corner(c.corner) != Point{2, 2} || !leaves.at_local_leaf(c.corner)) continue;
      EXPECT_EQ(c.distance, length(leaves.geometry.point(c.vertex) - Point{2, 2}));
      own.push_back(leaves.geometry.point(c.vertex));
    }
    Points all = test::world().all_gather_values(std::span<const Point>(own));
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  };
  EXPECT_EQ(captured({{1.75, 2.125}, {2.375, 2.125}}), (Points{{1.75, 2.125}}));
  EXPECT_EQ(captured({{1.75, 2.125}, {2.1875, 2.125}}), (Points{{2.1875, 2.125}}));
  EXPECT_TRUE(captured({{1.75, 2.125}, {2.25, 2.125}}).empty()) << "two are equally near";
  EXPECT_TRUE(captured({{1.75, 2}}).empty()) << "on a lattice line: its crossing is there already";
}

TEST(CapturePoints, EdgesBendThroughKeptPointsFarFromTheirEnds) {
  EXPECT_EQ(at(snapped(wedges({{1.5, 2.25}})), {1.5, 2}), (Moved{{1.5, 2}, {1.5, 2.25}, 0, true}));
  EXPECT_EQ(at(snapped(wedges({{1.5, 1.75}})), {1.5, 2}), (Moved{{1.5, 2}, {1.5, 1.75}, 2, true}))
      << "the crossings beside it are its";
  EXPECT_TRUE(snapped(wedges({{1.5, 2.375}})).empty()) << "too far";
  EXPECT_EQ(at(snapped(wedges({{1.4375, 2.25}, {1.5625, 2.25}})), {1.5, 2}), std::nullopt) << "two claim it";
}

TEST(CapturePoints, HangingNodesMoveOntoAnOutlineThatCrossesNoEdgeBesideThem) {
  // Leaves of edge 1 in the lower left quarter, of edge 2 in the others; the domain right of x = 2.125.
  const auto right_of = [](double x) { return test::loops_of({{{x, -1}, {9, -1}, {9, 9}, {x, 9}}}); };
  const Box fine{{0, 0}, {2, 2}};
  const auto moved = snapped(right_of(2.125), fine);
  EXPECT_EQ(at(moved, {2, 1}), (Moved{{2, 1}, {2.125, 1}, 0}));
  EXPECT_EQ(at(moved, {2, 2}), (Moved{{2, 2}, {2.125, 2}, 1}));
  EXPECT_EQ(moved.size(), 4U);
  EXPECT_EQ(at(snapped(right_of(2.5), fine), {2, 1}), std::nullopt);
}

TEST(SnapCorners, LeavesKnowTheirSnapsByTheirSites) {
  const TracedLeaves leaves(test::loops_of({{{-1, -1}, {5, -1}, {5, 5}, {-1, 5}}}), {{0, 0}, {2, 2}});
  constexpr std::int64_t unit = TracedLeaves::unit;
  std::vector<Snap> snaps(3);
  snaps[0].corner = {2 * unit, unit};      // hangs on the left side of the lower right leaf
  snaps[1].corner = {2 * unit, 2 * unit};  // a corner of four leaves
  snaps[2].corner = {2 * unit, 3 * unit};  // the edge between two leaves of edge 2
  snaps[2].on_edge = snaps[2].vertical = true;
  find_leaves_round(leaves.graph, snaps);
  using Seen = std::tuple<Point, Site, std::ptrdiff_t>;  // the leaf's lower left corner, site and snap
  std::vector<Seen> expected, seen;
  using enum Site;
  const std::vector<Seen> all{{{0, 2}, south_east, 1},  {{0, 2}, on_right, 2},   {{1, 0}, north_east, 0},
                              {{1, 1}, south_east, 0},  {{1, 1}, north_east, 1}, {{2, 0}, north_west, 1},
                              {{2, 0}, left_middle, 0}, {{2, 2}, south_west, 1}, {{2, 2}, on_left, 2}};
  for (const Seen& s : all) {
    const Point corner = std::get<0>(s);
    const LeafId leaf = leaves.graph.leaf_at(static_cast<std::int64_t>(corner.x) * unit,
                                             static_cast<std::int64_t>(corner.y) * unit);
    if (leaves.graph.is_local(leaf)) expected.push_back(s);
  }
  for (const LeafSnap& s : snaps_of_leaves(leaves.graph, snaps)) {
    const Quadrant& q = leaves.graph.leaf(s.leaf);
    seen.emplace_back(leaves.grid.corner(q.x, q.y), s.site, s.snap - snaps.data());
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, expected);
}

/// The outline comes as near to (3, 3) on its right as above it. Which of the two places the corner takes
/// depends on the axis alone, as its image must take the image.
TEST(SnapCorners, OfPlacesEquallyNearAMirrorTakesTheOneNearerToItsAxis) {
  const Geometry geometry =
      test::loops_of({{{0.5, 0.5}, {3.125, 0.5}, {3.125, 3.0625}, {3.0625, 3.125}, {0.5, 3.125}}}, none_kept);
  const Box everywhere{{0, 0}, {4, 4}};
  EXPECT_EQ(at(snapped(geometry, everywhere, MirrorAxis::x), {3, 3})->position, (Point{3.125, 3}));
  EXPECT_EQ(at(snapped(geometry, everywhere, MirrorAxis::y), {3, 3})->position, (Point{3, 3.125}));
}

/// The edge at (2.47, 0), which is kept, is too far for the vertex (2, 0) between the two sides, and belongs
/// to the run of neither.
TEST(SnapCorners, NeitherSideOfASharpEdgeOnTheAxisIsTaken) {
  const Points box{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const auto wedge = [&](double edge) { return test::loops_of({box, {{edge, 0}, {-1, -0.5}, {-1, 0.5}}}); };
  const Box everywhere{{0, -2}, {4, 2}};
  const auto moved = [&](double edge) {
    return at(snapped(wedge(edge), everywhere, MirrorAxis::x, {0, -2}), {2, 0});
  };
  EXPECT_EQ(moved(2.47), std::nullopt) << "both are equally near";
  ASSERT_TRUE(moved(2.4).has_value());
  EXPECT_EQ(moved(2.4)->position, (Point{2.4, 0}));
}

}  // namespace
}  // namespace quadloop
