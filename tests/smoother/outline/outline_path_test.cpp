// Places on an outline, ways and chords between them, also across the first vertex of a loop.
#include "smoother/outline/outline_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/smoother/rounding.hpp"

namespace quadloop::smoother {
namespace {

using test::rounding;

const double slope_length = std::sqrt(4.04);  // of the two lower segments of the box

/// A box, its lower side bent a little at vertex 0, round a square hole:
///
///     3-----------2      6--7
///     |           |      |  |
///     4---__0__---1      5--8
///
Geometry box_with_hole() {
  std::vector<Boundary> boundaries(2);
  boundaries[0].name = "box";
  boundaries[1].name = "hole";
  const std::vector<Point> points{{2, -0.2}, {4, 0}, {4, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}};
  std::vector<BoundaryId> of_segment(5, BoundaryId{0});
  of_segment.resize(9, BoundaryId{1});
  return {boundaries, points, {0, 5, 9}, of_segment};
}

class OnABoxWithAHole : public testing::Test {
 protected:
  OutlinePlace box(Point p) const { return path.locate(p, "box"); }
  OutlinePath::Chord chord(Point a, Point b) const { return {box(a), box(b), a, b}; }
  double deviation(Point a, Point b) const { return path.deviation(box(a), a, box(b), b); }
  using Segments = std::vector<std::int32_t>;
  Segments between(Point a, Point b) const { return path.segments_between(box(a), box(b)); }

  const Geometry geometry = box_with_hole();
  const OutlinePath path{geometry};
  const double box_length = 2 * slope_length + 10;
  const Point before{1, -0.1}, after{3, -0.1};  // of vertex 0
};

void expect_place(OutlinePlace place, std::int32_t loop, double arc) {
  EXPECT_EQ(place.loop, loop);
  EXPECT_NEAR(place.arc, arc, rounding);
}

TEST_F(OnABoxWithAHole, LocatesPointsOfABoundary) {
  expect_place(box(after), 0, slope_length / 2);
  expect_place(box(before), 0, box_length - slope_length / 2);
  expect_place(box({4, 1}), 0, slope_length + 1);
  expect_place(path.locate({1, 1.25}, "hole"), 1, 0.25);
  expect_place(path.locate({1.5, 1}, "hole"), 1, 3.5);
}

TEST_F(OnABoxWithAHole, LocatesNothingElsewhere) {
  EXPECT_FALSE(path.locate({4, 1}, "hole").valid());
  EXPECT_FALSE(path.locate({1, 1.25}, "box").valid());
  EXPECT_FALSE(path.locate({4, 1}, "shore").valid());
  EXPECT_FALSE(path.locate({3, 1.5}, "box").valid());
}

TEST_F(OnABoxWithAHole, LocatesToItsTolerance) {
  constexpr double tolerance = 4 * OutlinePath::on_outline;  // the outline is 4 wide
  expect_place(box({4 + 0.9 * tolerance, 1}), 0, slope_length + 1);
  EXPECT_FALSE(box({4 + 1.1 * tolerance, 1}).valid());
}

TEST_F(OnABoxWithAHole, TellsKeptVertices) {
  EXPECT_TRUE(box({4, 0}).kept);
  EXPECT_TRUE(box({4, 1e-10}).kept);
  EXPECT_TRUE(box({4, 1e-6}).valid());
  EXPECT_FALSE(box({4, 1e-6}).kept);
  EXPECT_FALSE(box({2, -0.2}).kept);  // no corner
  expect_place(path.locate({4, 0}, "box"), 0, slope_length);
  expect_place(path.locate({2, -0.2}, "box"), 0, 0);  // no corner
}

TEST_F(OnABoxWithAHole, FindsThePointAtAnArc) {
  const auto expect_point = [&](double arc, Point expected) {
    EXPECT_LT(length(path.point_at(path.place_at(0, arc)) - expected), rounding) << arc;
  };
  expect_point(0, {2, -0.2});
  expect_point(slope_length + 1.5, {4, 1.5});
  expect_point(slope_length + 3, {4, 3});
  expect_point(-slope_length / 2, before);
  expect_point(box_length + slope_length / 2, after);
  expect_point(box_length, {2, -0.2});
  EXPECT_EQ(path.point_at(path.place_at(1, 3.5)), (Point{1.5, 1}));
}

TEST_F(OnABoxWithAHole, ComesBackToEachPlace) {
  constexpr int steps = 500;
  for (int k = 0; k < steps; ++k) {
    const OutlinePlace place = path.place_at(0, box_length * (k + 0.5) / steps);
    expect_place(box(path.point_at(place)), 0, place.arc);
  }
}

TEST_F(OnABoxWithAHole, MovesToTheSegmentThatHoldsTheArc) {
  for (int k = 0; k < 40; ++k) {
    const OutlinePlace from = path.place_at(0, box_length * k / 40);
    for (const double share : {-0.9, -0.2, -0.01, 0.0, 0.01, 0.2, 0.9}) {
      const OutlinePlace to = path.moved(from, share * box_length);
      const OutlinePlace expected = path.place_at(0, from.arc + share * box_length);
      EXPECT_EQ(to.arc, expected.arc);
      EXPECT_EQ(to.segment, expected.segment) << from.arc << " moved by " << share * box_length;
    }
  }
}

TEST_F(OnABoxWithAHole, SeveralStepsFromAPlaceEndWhereEachAloneDoes) {
  const std::vector<double> steps{0, 1e-3, 0.3, 1.1, 2.5, 7, -1e-3, -0.3, -1.1, -2.5, -7};
  for (int k = 0; k < 40; ++k) {
    const OutlinePlace from = path.place_at(0, box_length * k / 40);
    std::vector<Point> points(steps.size());
    path.points_at(from, steps, points);
    for (std::size_t i = 0; i < steps.size(); ++i)
      EXPECT_EQ(points[i], path.point_at(path.moved(from, steps[i]))) << from.arc << " " << steps[i];
  }
}

TEST_F(OnABoxWithAHole, WalksWithTheDomainToTheLeft) {
  EXPECT_NEAR(path.way(box(before), box(after)), slope_length, rounding);
  EXPECT_NEAR(path.way(box(after), box(before)), box_length - slope_length, rounding);
  EXPECT_NEAR(path.way(box({4, 1}), box({3, 3})), 3, rounding);
  EXPECT_EQ(path.way(box(after), box(after)), 0);
  // The domain lies to the left of the hole too, which is walked clockwise.
  EXPECT_NEAR(path.way(path.locate({1, 1.5}, "hole"), path.locate({1.5, 2}, "hole")), 1, rounding);
}

TEST_F(OnABoxWithAHole, StraysFromChordsByItsVertices) {
  EXPECT_NEAR(deviation(before, after), 0.1, rounding);                  // vertex 0
  EXPECT_NEAR(deviation(after, {4, 1}), 1 / std::sqrt(2.21), rounding);  // the corner at (4, 0)
  EXPECT_NEAR(deviation({4, 1}, {3, 3}), 2 / std::sqrt(5.0), rounding);  // that at (4, 3)
  EXPECT_NEAR(deviation({4, 1}, {1, 3}), 3 * 2 / std::sqrt(13.0), rounding);
}

TEST_F(OnABoxWithAHole, DoesNotStrayWithinASegmentNorFromAVertex) {
  EXPECT_EQ(deviation(after, {4, 0}), 0);
  EXPECT_EQ(deviation({4, 0.5}, {4, 2}), 0);
  EXPECT_NEAR(deviation({2, -0.2}, after), 0, rounding);
  EXPECT_NEAR(deviation(before, {2, -0.2}), 0, rounding);
}

TEST_F(OnABoxWithAHole, FindsWhatAChordMeetsElsewhere) {
  const auto sorted = [](Segments all) {
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(path.met_elsewhere(chord(before, after)), Segments{});
  EXPECT_EQ(path.met_elsewhere(chord({4, 0.5}, {4, 2})), Segments{});
  EXPECT_EQ(path.met_elsewhere(chord({4, 0}, {4, 3})), Segments{});
  EXPECT_EQ(path.met_elsewhere(chord(after, {0, 1})), Segments{});                     // below the hole
  EXPECT_EQ(sorted(path.met_elsewhere(chord({4, 1.5}, {0, 1.5}))), (Segments{5, 7}));  // through it
  EXPECT_EQ(sorted(path.met_elsewhere(chord({4, 2}, {0, 2}))), (Segments{5, 6, 7}));   // along its upper side
  EXPECT_EQ(sorted(path.met_elsewhere(chord({3, 3}, {0, 0}))),
            (Segments{5, 6, 7, 8}));  // through two of its corners
}

TEST_F(OnABoxWithAHole, AnswersAlikeFromMoreSegmentsThanItNeeds) {
  const Segments all{0, 1, 2, 3, 4, 5, 6, 7, 8};
  for (const Point end : {Point{4, 1.5}, Point{4, 2}, Point{3, 3}, after}) {
    const OutlinePath::Chord across = chord(end, {0, 1.5});
    EXPECT_EQ(path.met_elsewhere(across).size(), path.met_elsewhere(across, all).size());
    EXPECT_EQ(path.sweeps_over(across, {2, 3}), path.sweeps_over(across, {2, 3}, all));
    EXPECT_EQ(box(end).segment, path.locate(end, "box", all).segment);
    EXPECT_EQ(box(end).arc, path.locate(end, "box", all).arc);
  }
}

TEST_F(OnABoxWithAHole, FindsTheSegmentsNearABox) {
  const auto near = [&](Box box) {
    Segments all = path.segments_near(box);
    std::sort(all.begin(), all.end());
    return all;
  };
  constexpr double tolerance = 4 * OutlinePath::on_outline;
  EXPECT_EQ(near({{0.5, 1.2}, {1, 1.8}}), (Segments{5}));
  EXPECT_EQ(near({{0.5, 1.2}, {1 - 0.9 * tolerance, 1.8}}), (Segments{5}));
  EXPECT_EQ(near({{0.5, 1.2}, {1 - 1.1 * tolerance, 1.8}}), Segments{});
}

TEST_F(OnABoxWithAHole, FindsPartsOfTheSameLoopThatAChordMeets) {
  // A chord off the outline: it stands for the way over vertex 0, and reaches beyond the upper side.
  const OutlinePath::Chord astray{box(before), box(after), {1, -0.1}, {3, 3.5}};
  const auto found = path.met_elsewhere(astray);
  EXPECT_NE(std::find(found.begin(), found.end(), 2), found.end());
  EXPECT_EQ(std::find(found.begin(), found.end(), 4), found.end());
}

TEST_F(OnABoxWithAHole, SweepsOverVerticesOfOtherParts) {
  const OutlinePath::Chord through = chord({4, 1.5}, {0, 1.5});
  EXPECT_TRUE(path.sweeps_over(through, {0, 3}));       // both upper corners of the hole
  EXPECT_TRUE(path.sweeps_over(through, {4, 3}));       // the right one alone
  EXPECT_FALSE(path.sweeps_over(through, {0.5, 1.6}));  // its sides, but no corner
  EXPECT_TRUE(path.sweeps_over(chord({4, 2}, {0, 2}), {2, 2.5})) << "corners on the triangle's edge";
  EXPECT_FALSE(path.sweeps_over(chord({4, 2.5}, {0, 2.5}), {2, 2.1}));
  EXPECT_FALSE(path.sweeps_over(chord(before, after), {2, -0.3})) << "its own part";
  EXPECT_TRUE(path.sweeps_over(chord({4, 0.5}, {4, 2}), {1, -1})) << "vertex 0";
}

TEST_F(OnABoxWithAHole, NamesTheSegmentsBetweenTwoPlaces) {
  EXPECT_EQ(between(before, after), (Segments{4, 0}));
  EXPECT_EQ(between(after, {4, 1}), (Segments{0, 1}));
  EXPECT_EQ(between(after, before), (Segments{0, 1, 2, 3, 4}));
  EXPECT_EQ(between({4, 1}, {4, 2}), (Segments{1}));
}

TEST_F(OnABoxWithAHole, NamesAllSegmentsOfAWayRoundToTheSameOne) {
  EXPECT_EQ(between({4, 2}, {4, 1}), (Segments{1, 2, 3, 4, 0, 1}));
}

TEST(OutlinePath, GivesUpOnWaysOfTooManyVertices) {
  std::vector<Point> points;
  for (int k = 0; k < 4000; ++k)
    points.push_back({std::cos(2 * std::numbers::pi * k / 4000), std::sin(2 * std::numbers::pi * k / 4000)});
  std::vector<Boundary> boundaries(1);
  boundaries[0].name = "circle";
  const Geometry circle(boundaries, points, {0, 4000}, std::vector<BoundaryId>(4000, BoundaryId{0}));
  const OutlinePath path(circle);
  const auto place = [&](int k) { return path.locate(points[k], "circle"); };
  EXPECT_EQ(path.deviation(place(0), points[0], place(2000), points[2000]),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(path.segments_between(place(0), place(2000)).empty());
  EXPECT_NEAR(path.deviation(place(3900), points[3900], place(100), points[100]),
              1 - std::cos(2 * std::numbers::pi * 100 / 4000), 1e-9);
  EXPECT_EQ(path.segments_between(place(3900), place(100)).size(), 201U);
}

}  // namespace
}  // namespace quadloop::smoother
