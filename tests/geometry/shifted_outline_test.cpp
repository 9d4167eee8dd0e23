// The outline moved into the domain by less than any number: what it meets has no special cases left, and
// turns and mirrors along.
#include "mesher/geometry/shifted_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace quadloop {
namespace {

Geometry loop_of(std::vector<Point> points) {
  const auto count = size32(points);
  return {{{"outline"}}, std::move(points), {0, count}, std::vector<BoundaryId>(count, BoundaryId{0})};
}

Box box_at(double x, double y, double edge) { return {{x, y}, {x + edge, y + edge}}; }

/// A star-shaped outline on whole numbers, so that vertices and segments lie on grid lines and corners.
std::vector<Point> whole_star(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  std::set<std::pair<double, Point>> by_angle;
  std::set<double> angles;
  for (int i = 0; i < 12; ++i) {
    const Point p{1.0 * coordinate(random), 1.0 * coordinate(random)};
    const double angle = std::atan2(p.y, p.x);
    if (p != Point{} && angles.insert(angle).second) by_angle.insert({angle, p});
  }
  std::vector<Point> points;
  for (const auto& [angle, p] : by_angle) points.push_back(p);
  return points;
}

TEST(ShiftedOutline, MovesIntoTheDomain) {
  const Geometry square = loop_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}}),
                 hole = loop_of({{0, 0}, {0, 2}, {2, 2}, {2, 0}});
  const ShiftedOutline inwards(square), outwards(hole);
  EXPECT_TRUE(inwards.beyond_x(0, 0) && inwards.beyond_y(0, 0));
  EXPECT_FALSE(inwards.beyond_x(2, 2) || inwards.beyond_y(2, 2));
  EXPECT_FALSE(outwards.beyond_x(0, 0) || outwards.beyond_y(0, 0));
  EXPECT_TRUE(outwards.beyond_x(2, 2) && outwards.beyond_y(2, 2));
}

TEST(ShiftedOutline, ASegmentOnALatticeLineBelongsToTheDomainsSide) {
  const Geometry square = loop_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const ShiftedOutline outline(square);
  EXPECT_TRUE(outline.meets(0, box_at(0, 0, 1)) && outline.meets(0, box_at(1, 0, 1)));
  EXPECT_FALSE(outline.meets(0, box_at(0, -1, 1))) << "the leaf outside of it";
  EXPECT_FALSE(outline.meets(0, box_at(-1, 0, 1)) || outline.meets(0, box_at(2, 0, 1)))
      << "leaves at its ends";
  EXPECT_FALSE(outline.meets(0, box_at(0, 1, 1)));
}

TEST(ShiftedOutline, APointOfASegmentIsNotToItsLeft) {
  const Geometry triangle = loop_of({{0, 0}, {3, 1}, {0, 4}});
  const ShiftedOutline outline(triangle);
  EXPECT_FALSE(outline.has_left(0, {0, 0}) || outline.has_left(0, {6, 2}) || outline.has_left(0, {-3, -1}));
  EXPECT_TRUE(outline.has_left(0, {3, std::nextafter(1.0, 2)}));
  EXPECT_FALSE(outline.has_left(0, {3, std::nextafter(1.0, 0)}));
}

TEST(ShiftedOutline, WhatMeetsABoxMeetsAQuarterOfIt) {
  int meetings = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto points = whole_star(seed);
    if (points.size() < 3) continue;
    const Geometry geometry = loop_of(points);
    const ShiftedOutline outline(geometry);
    for (std::int32_t s = 0; s < geometry.size(); ++s) {
      for (int x = -4; x < 4; x += 2) {
        for (int y = -4; y < 4; y += 2) {
          int quarters = 0;
          for (const Point corner : {Point{0, 0}, Point{1, 0}, Point{0, 1}, Point{1, 1}})
            quarters += outline.meets(s, box_at(x + corner.x, y + corner.y, 1)) ? 1 : 0;
          EXPECT_EQ(outline.meets(s, box_at(x, y, 2)), quarters > 0) << "seed " << seed << " segment " << s;
          meetings += quarters > 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(meetings, 1000);
}

TEST(ShiftedOutline, AVertexAtAPeakOnALineIsOnBothSidesOfIt) {
  const Geometry diamond = loop_of({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}),
                 square = loop_of({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const ShiftedOutline peaks(diamond), corners(square);
  EXPECT_TRUE(peaks.is_in(box_at(0, 0, 2), 1) && peaks.is_in(box_at(0, -2, 2), 1));
  EXPECT_TRUE(peaks.is_in(box_at(0, 0, 2), 2) && peaks.is_in(box_at(-2, 0, 2), 2));
  EXPECT_FALSE(peaks.is_in(box_at(1, 0, 2), 1) || peaks.is_in(box_at(0, 1, 2), 2)) << "outside the domain";
  EXPECT_TRUE(corners.is_in(box_at(-1, -1, 1), 0));
  EXPECT_FALSE(corners.is_in(box_at(-2, -1, 1), 0) || corners.is_in(box_at(-1, -2, 1), 0));
}

/// A square of 8 with a line from (2, 4) to the end, as the loop that runs round it.
Geometry line_in_square(Point end) {
  std::vector<Point> points{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {2, 4}, end};
  return {{{"outline"}},
          std::move(points),
          {0, 4, 6},
          std::vector<BoundaryId>(6, BoundaryId{0}),
          {},
          {{}, {}, {0, 0, 0, 0, 0, 1}}};
}

TEST(ShiftedOutline, IsClosedRoundAnInnerLine) {
  for (const Point end : {Point{5, 4}, Point{2, 7}, Point{5, 7}, Point{1, 3}, Point{0.5, 6}}) {
    const Geometry geometry = line_in_square(end);
    ASSERT_TRUE(geometry.is_tip(4) && geometry.is_tip(5));
    const ShiftedOutline outline(geometry);
    const Point start{2, 4}, along = end - start;
    for (int i = 0; i <= 16; ++i) {
      for (int j = 0; j <= 16; ++j) {
        const Point p{0.5 * i, 0.5 * j};
        if (i == 0 || j == 0 || i == 16 || j == 16) continue;
        int winding = 0;
        for (std::int32_t s = 0; s < geometry.size(); ++s) winding += outline.winding_at(s, p);
        const bool on_line = cross(along, p - start) == 0 && dot(p - start, p - end) <= 0;
        EXPECT_EQ(winding, on_line ? 0 : 1) << p.x << " " << p.y << " line to " << end.x << " " << end.y;
      }
    }
  }
}

TEST(ShiftedOutline, TurnsAndMirrorsWithTheOutline) {
  const auto mirrored = [](Point p) { return Point{-p.x, p.y}; };
  const auto turned = [](Point p) { return Point{-p.y, p.x}; };
  int meetings = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto points = whole_star(seed);
    if (points.size() < 3) continue;
    std::vector<Point> mirror, turn;
    for (const Point p : points) {
      mirror.push_back(mirrored(p));
      turn.push_back(turned(p));
    }
    std::reverse(mirror.begin(), mirror.end());  // the domain stays to the left
    const Geometry given = loop_of(points), by_mirror = loop_of(mirror), by_turn = loop_of(turn);
    const ShiftedOutline outline(given), mirrored_outline(by_mirror), turned_outline(by_turn);
    for (int x = -5; x < 5; ++x) {
      for (int y = -5; y < 5; ++y) {
        bool any = false,
             any_mirrored = false;  // which of two segments passes through a peak on a line may change
        for (std::int32_t s = 0; s < given.size(); ++s) {
          const bool meets = outline.meets(s, box_at(x, y, 1));
          EXPECT_EQ(turned_outline.meets(s, box_at(-y - 1, x, 1)), meets)
              << "seed " << seed << " segment " << s;
          any = any || meets;
          any_mirrored = any_mirrored || mirrored_outline.meets(s, box_at(-x - 1, y, 1));
        }
        EXPECT_EQ(any, any_mirrored) << "seed " << seed << " leaf " << x << " " << y;
        meetings += any ? 1 : 0;
      }
    }
  }
  EXPECT_GT(meetings, 1000);
}

TEST(CrossingHeight, IsRoundedOnceAndTheSameFromBothEnds) {
  EXPECT_EQ(crossing_height({0, 0}, {3, 1}, 1), 1.0 / 3);
  EXPECT_EQ(crossing_height({0, 0}, {3, 1}, 2), 2.0 / 3);
  EXPECT_EQ(crossing_height({0, 7}, {0, 9}, 0), 7);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Point a{number(random) - 1, number(random)}, b{number(random) + 1, number(random)};
    const double x = a.x + (b.x - a.x) * (i % 3 == 0 ? 0.5 : 0.25);
    const double height = crossing_height(a, b, x);
    EXPECT_EQ(crossing_height(b, a, x), height);
    EXPECT_EQ(crossing_height({-a.x, a.y}, {-b.x, b.y}, -x), height);
    EXPECT_EQ(crossing_height({a.x, -a.y}, {b.x, -b.y}, x), -height);
    EXPECT_EQ(crossing_height(a, b, a.x), a.y);
    EXPECT_EQ(crossing_height(a, b, b.x), b.y);
  }
}

}  // namespace
}  // namespace quadloop
