#include "adapt/morph/outline_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop::adapt {
namespace {

Geometry outline(const std::vector<Chain>& chains) {
  Warnings warnings;
  AssembleOptions options;
  options.domain_is_known = true;
  return assemble(chains, options, warnings);
}

Chain loop(const std::string& name, const std::vector<Point>& points) {
  return {name, false, points, "test"};
}

const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
/// A square whose lower side has a point more, and is longer.
const std::vector<Point> house{{0, 0}, {1, -0.1}, {2, 0}, {2, 1}, {0, 1}};

TEST(OutlineMap, SharesOfTheWayBetweenCorners) {
  const Geometry from = outline({loop("body", square)}), to = outline({loop("body", house)});
  const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
  EXPECT_EQ(map.image(0, 0), (Point{0, 0}));
  EXPECT_EQ(map.image(0, 1), (Point{2, 0})) << "the bend of 11 degrees is no corner";
  EXPECT_NEAR(map.image(0, 0.5).x, 1, 1e-14);
  EXPECT_NEAR(map.image(0, 0.5).y, -0.1, 1e-14);
  EXPECT_NEAR(map.image(0, 2.5).x, 1, 1e-14);
  EXPECT_EQ(map.image(0, 2.5).y, 1);
}

TEST(OutlineMap, ByPointsWhereThereAreAsMany) {
  std::vector<Point> moved = house;
  moved[1] = {0.5, -0.1};
  const Geometry from = outline({loop("body", house)}), to = outline({loop("body", moved)});
  const OutlineMap by_points(from, to, true, {"to.geom", "the mesh"}),
      by_shares(from, to, false, {"to.geom", "the mesh"});
  EXPECT_TRUE(by_points.shares(0, 0).has_value());
  const double bend = length(house[1] - house[0]);
  EXPECT_EQ(by_points.image(0, bend), moved[1]);
  EXPECT_NE(by_shares.image(0, bend), moved[1]);
  EXPECT_FALSE(OutlineMap(outline({loop("body", square)}), to, true, {"to.geom", "the mesh"})
                   .shares(0, 0)
                   .has_value());
}

TEST(OutlineMap, ByPointsWhereverTheLoopsBegin) {
  std::vector<Point> later = house;
  std::ranges::rotate(later, later.begin() + 2);
  const Geometry from = outline({loop("body", house)}), to = outline({loop("body", later)});
  const OutlineMap map(from, to, true, {"to.geom", "the mesh"});
  EXPECT_TRUE(map.shares(0, 0).has_value());
  const double bend = length(house[1] - house[0]);
  EXPECT_EQ(map.image(0, 0), house[0]);
  EXPECT_EQ(map.image(0, bend), house[1]);
}

/// A side with points at these places between its ends, on a square.
std::vector<Point> with_points(const std::vector<double>& on_lower_side) {
  std::vector<Point> points{{0, 0}};
  for (const double x : on_lower_side) points.push_back({x, 0});
  points.insert(points.end(), {{1, 0}, {1, 1}, {0, 1}});
  return points;
}

TEST(OutlineMap, VerticesOnTheNewOutlineStay) {
  std::vector<Point> bent = with_points({0.5, 0.7});
  bent[2] = {0.7, -0.05};
  const Geometry from = outline({loop("body", with_points({0.2, 0.4, 0.5, 0.7}))}),
                 to = outline({loop("body", bent)});
  const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
  for (const double x : {0.2, 0.4, 0.5}) {
    EXPECT_NEAR(map.image(0, x).x, x, 1e-15);
    EXPECT_EQ(map.image(0, x).y, 0);
  }
  EXPECT_LT(map.image(0, 0.7).y, -0.045);
}

TEST(OutlineMap, VerticesOfASideThatSlidesAlongItselfDoNotStay) {
  const Geometry from = outline({loop("body", with_points({0.1, 0.2, 0.5, 0.9}))}),
                 to = outline({loop("body", {{0.15, 0}, {1.15, 0}, {1.15, 1}, {0.15, 1}})});
  const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
  for (const double x : {0.0, 0.1, 0.2, 0.5, 0.9}) EXPECT_NEAR(map.image(0, x).x, x + 0.15, 1e-15);
}

TEST(OutlineMap, OfTheSameOutlineIsTheIdentityAlsoWhereCornersAreBlunter) {
  std::vector<Point> fine, coarse;  // every second point: what turns by 24 degrees turns by 48
  for (int k = 0; k < 15; ++k) {
    const double angle = 24 * k * 0.017453292519943295;
    fine.push_back({std::cos(angle), std::sin(angle)});
  }
  fine.push_back({1, -0.2});
  coarse = fine;
  coarse.insert(coarse.begin() + 3, 0.5 * (fine[2] + fine[3]));
  const Geometry from = outline({loop("body", coarse)}), to = outline({loop("body", fine)});
  const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
  const smoother::OutlinePath path(from);
  for (std::int32_t v = 0; v < from.size(); ++v)
    EXPECT_NEAR(length(map.image(0, path.arc_of(v)) - from.point(v)), 0, 1e-14) << v;
}

TEST(OutlineMap, OfTheSameOutlineIsTheIdentityWhereTheMeshLostACorner) {
  const std::vector<Point> tip{{0, 0}, {4, 0}, {4.3, 0.5}, {4, 1}, {0, 1}},
      cut_off{{0, 0}, {4, 0}, {4, 1}, {0, 1}};
  std::vector<Point> far_tip = tip;
  far_tip[2] = {4.6, 0.5};
  const Geometry from = outline({loop("body", {{0, 0}, {4, 0}, {4.24, 0.4}, {4.24, 0.6}, {4, 1}, {0, 1}})}),
                 to = outline({loop("body", tip)});
  const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
  const smoother::OutlinePath path(from);
  for (std::int32_t v = 0; v < from.size(); ++v)
    EXPECT_NEAR(length(map.image(0, path.arc_of(v)) - from.point(v)), 0, 1e-14) << v;
  EXPECT_THROW(OutlineMap(outline({loop("body", cut_off)}), outline({loop("body", far_tip)}), false,
                          {"to.geom", "the mesh"}),
               InputError)
      << "a corner farther away is not one that the mesh lost";
}

TEST(OutlineMap, LoopsThatTheNewOutlineLacksStay) {
  const std::vector<Point> frame{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const Geometry from = outline({loop("far", frame), loop("body", square)}),
                 to = outline({loop("body", square)});
  const OutlineMap map(from, walked_as(from, to), false, {"to.geom", "the mesh"});
  EXPECT_FALSE(map.maps(0));
  EXPECT_TRUE(map.maps(1));
}

TEST(OutlineMap, AnOutlineAloneIsWalkedAsInTheMesh) {
  const std::vector<Point> frame{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const Geometry whole = outline({loop("far", frame), loop("body", square)}),
                 alone = outline({loop("body", square)});
  const Geometry turned = walked_as(whole, alone);
  EXPECT_EQ(alone.point(1), (Point{1, 0}));
  EXPECT_EQ(turned.point(1), (Point{0, 1})) << "clockwise, the domain outside";
}

TEST(OutlineMap, RefusesLoopsAndCornersWithoutACounterpart) {
  const std::vector<Point> beside{{5, 0}, {6, 0}, {6, 1}, {5, 1}}, triangle{{0, 0}, {1, 0}, {0, 1}};
  const Geometry one = outline({loop("body", square)}),
                 two = outline({loop("body", square), loop("body", beside)});
  const auto said = [](const Geometry& from, const Geometry& to) -> std::string {
    try {
      const OutlineMap map(from, to, false, {"to.geom", "the mesh"});
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(said(one, two).find("more loops of 'body'"), std::string::npos);
  EXPECT_NE(said(two, one).find("near (5.5, 0.5)"), std::string::npos);
  EXPECT_NE(
      said(outline({loop("body", triangle)}), one).find("has 4 feature points and that of the mesh has 3"),
      std::string::npos);
}

}  // namespace
}  // namespace quadloop::adapt
