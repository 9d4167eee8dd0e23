// Islands that overlap, share edges or lie in each other become one; names stay with their segments.
#include "mesher/geometry/assemble/united_islands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/geometry/outlines.hpp"
#include "tests/support/growth.hpp"

namespace quadloop {
namespace {

using test::closed;
using test::loop_area;
using test::refusal;
using test::reversed;
using test::square;

Chain rectangle(const std::string& name, Point low, Point high) {
  Chain chain = closed(name, {low, {high.x, low.y}, high, {low.x, high.y}});
  chain.directed = false;
  chain.source = name;
  return chain;
}

Geometry united(std::vector<Chain> chains, Warnings* told = nullptr, double join = 1e-9) {
  AssembleOptions options;
  options.unite_islands = true;
  options.join = join;
  Warnings warnings;
  Geometry geometry = assemble(std::move(chains), options, warnings);
  if (told != nullptr) *told = warnings;
  return geometry;
}

double area_of(const Geometry& geometry) {
  double area = 0;
  for (std::int32_t l = 0; l < geometry.loop_count(); ++l) area += loop_area(geometry, l);
  return area;
}

/// Lengths of the edges of one name.
double length_of(const Geometry& geometry, const std::string& name) {
  double sum = 0;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (geometry.boundary(geometry.boundary_of(s)).name == name)
      sum += length(geometry.point(geometry.next(s)) - geometry.point(s));
  }
  return sum;
}

const Chain sea = rectangle("sea", {-50, -50}, {100, 100});
constexpr double sea_area = 150 * 150;

TEST(UnitedIslands, HousesThatShareAWallBecomeOne) {
  Warnings warnings;
  const Geometry g =
      united({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", {10, 0}, {20, 10})}, &warnings);
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 200);
  EXPECT_DOUBLE_EQ(length_of(g, "a"), 30);
  EXPECT_DOUBLE_EQ(length_of(g, "b"), 30);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 loops that overlap or touch became 1"), std::string::npos) << warnings[0];
}

TEST(UnitedIslands, APartOfAWallMayBeShared) {
  const Geometry g = united({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", {10, 3}, {20, 8})});
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_EQ(g.size(), 4 + 8);
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 150);
  EXPECT_DOUBLE_EQ(length_of(g, "a"), 35);
  EXPECT_DOUBLE_EQ(length_of(g, "b"), 25);
}

TEST(UnitedIslands, OverlapsCountOnce) {
  const Geometry g = united({sea, rectangle("a", {40, 0}, {50, 10}), rectangle("b", {45, 5}, {55, 15})});
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 175);
  EXPECT_DOUBLE_EQ(length_of(g, "a"), 30);
  EXPECT_DOUBLE_EQ(length_of(g, "b"), 30);
}

TEST(UnitedIslands, AnIslandInsideAnotherIsDropped) {
  for (const Point low : {Point{2, 2}, Point{0, 2}, Point{0, 0}}) {
    Warnings warnings;
    const Geometry g =
        united({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", low, {5, 5})}, &warnings);
    EXPECT_EQ(g.loop_count(), 2) << low.x << ' ' << low.y;
    EXPECT_EQ(g.size(), low.x == 0 && low.y == 0 ? 8 : 8) << low.x << ' ' << low.y;
    EXPECT_DOUBLE_EQ(area_of(g), sea_area - 100);
    EXPECT_EQ(g.boundaries().size(), 2u);
    EXPECT_NE(warnings.back().find("'b' has no edge left"), std::string::npos) << warnings.back();
  }
}

TEST(UnitedIslands, OfEqualIslandsTheFirstGivesTheName) {
  Chain twin = rectangle("b", {0, 0}, {10, 10});
  std::ranges::rotate(twin.points, twin.points.begin() + 1);
  const Geometry g = united({sea, rectangle("a", {0, 0}, {10, 10}), reversed(twin)});
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 100);
  EXPECT_DOUBLE_EQ(length_of(g, "a"), 40);
}

TEST(UnitedIslands, ARingOfAPolygonStaysAHole) {
  Chain court = rectangle("a", {2, 2}, {8, 8});
  court.source = "a";
  const Geometry g = united({sea, rectangle("a", {0, 0}, {10, 10}), court, rectangle("b", {10, 0}, {20, 10}),
                             rectangle("shed", {4, 4}, {5, 5})});
  EXPECT_EQ(g.loop_count(), 4);
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 200 + 36 - 1);
}

TEST(UnitedIslands, ALakeThatItsFileDirectsSoStays) {
  const Chain lake = square("lake", {0, 0}, 1), island = reversed(square("island", {0, 0}, 2)),
              other = reversed(square("other", {3, 0}, 2)), open_sea = square("sea", {0, 0}, 9);
  const Geometry g = united({open_sea, island, other, lake});
  EXPECT_EQ(g.loop_count(), 3);
  // The other island covers nothing of the lake, which ends where it begins.
  EXPECT_DOUBLE_EQ(area_of(g), 18 * 18 - (16 + 16 - 4) + 4);
}

TEST(UnitedIslands, ARingOfHousesHasACourt) {
  const Geometry g = united({sea, rectangle("south", {0, 0}, {30, 10}), rectangle("north", {0, 20}, {30, 30}),
                             rectangle("west", {0, 10}, {10, 20}), rectangle("east", {20, 10}, {30, 20}),
                             rectangle("well", {14, 14}, {15, 15})});
  EXPECT_EQ(g.loop_count(), 4) << "the sea, the ring, its court and the well in it";
  EXPECT_DOUBLE_EQ(area_of(g), sea_area - 800 - 1);
}

TEST(UnitedIslands, OfIslandsAcrossTheOuterBoundaryThePartInsideCounts) {
  const Geometry across = united({sea, rectangle("pier", {90, 0}, {120, 10})});
  EXPECT_EQ(across.loop_count(), 1);
  EXPECT_DOUBLE_EQ(area_of(across), sea_area - 100);
  EXPECT_DOUBLE_EQ(length_of(across, "pier"), 30);
  EXPECT_DOUBLE_EQ(length_of(across, "sea"), 590);
  const Geometry flush = united({rectangle("pier", {90, 0}, {100, 10}), sea});
  EXPECT_DOUBLE_EQ(area_of(flush), sea_area - 100);
  EXPECT_DOUBLE_EQ(length_of(flush, "pier"), 30);
}

TEST(UnitedIslands, WallsThatDifferByRoundingAreShared) {
  for (const double gap : {1e-13, -1e-13}) {
    const Geometry g =
        united({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", {10 + gap, 3}, {20, 8})});
    EXPECT_EQ(g.loop_count(), 2) << gap;
    EXPECT_EQ(g.size(), 12) << gap;
  }
  const Geometry wide =
      united({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", {10.01, 3}, {20, 8})}, nullptr, 1e-4);
  EXPECT_EQ(wide.loop_count(), 2) << "geometry.join says what is near";
}

TEST(UnitedIslands, LoopsThatMeetNoOtherStayAsTheyAre) {
  const std::vector<Chain> chains{square("sea", {0, 0}, 9), reversed(square("island", {0, 0}, 2)),
                                  square("lake", {0, 0}, 1)};
  Warnings warnings;
  const Geometry with = united(chains, &warnings);
  const Geometry without = assemble(chains, {}, warnings);
  EXPECT_EQ(with.digest(), without.digest());
}

TEST(UnitedIslands, RefusesALoopThatCrossesItself) {
  const std::string message = refusal([&] {
    united({sea, closed("bow", {{0, 0}, {4, 4}, {4, 0}, {0, 4}}), rectangle("a", {0, 0}, {10, 10})});
  });
  EXPECT_NE(message.find("'bow'"), std::string::npos) << message;
  EXPECT_EQ(message.find("geometry.overlap"), std::string::npos) << message;
}

TEST(UnitedIslands, IsTheRemedyThatTheRefusalNames) {
  Warnings warnings;
  const std::string message = refusal([&] {
    assemble({sea, rectangle("a", {0, 0}, {10, 10}), rectangle("b", {10, 0}, {20, 10})}, {}, warnings);
  });
  EXPECT_NE(message.find("set geometry.overlap = \"union\""), std::string::npos) << message;
}

/// Whether an island covers the point; exact, as no vertex has the point's height.
bool covers(const Chain& island, Point p) {
  bool inside = false;
  for (std::size_t i = 0; i < island.points.size(); ++i) {
    const Point a = island.points[i], b = island.points[(i + 1) % island.points.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    inside ^= (orientation(a, b, p) > 0) == (b.y > a.y);
  }
  return inside;
}

TEST(UnitedIslands, RandomIslandsCoverWhatTheyCoverEach) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1000003) / 1000003;
  };
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Chain> chains{sea};
    for (int i = 0; i < 12; ++i) {
      const Point centre{number(0, 40), number(0, 40)};
      Chain island = closed("i" + std::to_string(i), {});
      island.directed = false;
      island.source = island.name;
      const int corners = 3 + static_cast<int>(random() % 5);
      const double turn = number(0, 6.28), size = number(1, 12);
      for (int k = 0; k < corners; ++k) {
        const double angle = turn + 6.283185307 * k / corners;
        island.points.push_back(centre + size * Point{std::cos(angle), std::sin(angle)});
      }
      chains.push_back(island);
    }
    const Geometry g = united(chains);
    for (int k = 0; k < 200; ++k) {
      const Point p{number(-10, 50), number(-10, 50)};
      const bool wanted = std::none_of(chains.begin() + 1, chains.end(),
                                       [&](const Chain& island) { return covers(island, p); });
      bool found = false;
      for (std::int32_t s = 0; s < g.size(); ++s) {
        const Point a = g.point(s), b = g.point(g.next(s));
        if ((a.y > p.y) != (b.y > p.y)) found ^= (orientation(a, b, p) > 0) == (b.y > a.y);
      }
      EXPECT_EQ(found, wanted) << trial << ": " << p.x << ' ' << p.y;
    }
  }
}

TEST(UnitedIslands, APointThatTouchesAnEdgeIsCommon) {
  const Chain house = rectangle("house", {10, 10}, {20, 20});
  for (const Chain& wedge :
       {closed("wedge", {{20, 15}, {30, 10}, {30, 20}}), closed("wedge", {{17, 20}, {19, 30}, {15, 30}}),
        closed("wedge", {{-50, 3}, {-40, 8}, {-40, -2}})}) {
    Warnings warnings;
    const Geometry g = united({sea, house, wedge}, &warnings);
    EXPECT_EQ(g.loop_count(), 3);
    EXPECT_DOUBLE_EQ(area_of(g), sea_area - 100 - std::abs(area_of(united({wedge}))));
    int common = 0;
    for (std::int32_t s = 0; s < g.size(); ++s) common += g.point(s) == wedge.points.front() ? 1 : 0;
    EXPECT_EQ(common, 2) << wedge.points.front().x;
  }
}

TEST(UnitedIslands, TimeGrowsWithTheIslandsOfOneGroup) {
  test::expect_linear("islands that overlap in a row", 250, [](int count) {
    std::vector<Chain> chains{rectangle("sea", {-9, -9}, {count + 9., 10})};
    for (int i = 0; i < count; ++i) chains.push_back(rectangle("h", {i * 0.9, 0}, {i * 0.9 + 1, 1}));
    for (Chain& chain : chains) chain.source = "file";  // each may be a hole in each other
    EXPECT_EQ(united(chains).loop_count(), 2);
  });
}

TEST(UnitedIslands, ATownOnAGridIsUnitedWhole) {
  std::vector<Chain> chains{rectangle("sea", {-9, -9}, {49, 49})};
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j)
      chains.push_back(rectangle("h", {i * 2.0, j * 2.0}, {i * 2.0 + 2, j * 2.0 + 2}));
  }
  const Geometry g = united(chains);
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_DOUBLE_EQ(area_of(g), 58 * 58 - 1600);
}

}  // namespace
}  // namespace quadloop
