// The cells of a fan: they fill it, conform, are no sharper than need be, and mirror images have mirrored
// ones.
#include "mesher/layers/fan_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace quadloop {
namespace {

/// Rays from 0 to -`degrees`, clockwise.
std::vector<Point> rays_over(double degrees, int rays) {
  std::vector<Point> directions;
  for (int k = 0; k < rays; ++k) {
    const double angle = -std::acos(-1.0) / 180 * degrees * k / (rays - 1);
    directions.push_back({std::cos(angle), std::sin(angle)});
  }
  return directions;
}

/// A fan with the places of its nodes; rows grow by a fifth.
struct Fan {
  Fan(std::vector<Point> directions, int rows) : rays{std::move(directions)}, rings{rows}, made{rays, rows} {
    for (std::int32_t ray = 0; ray + 1 < size32(rays); ++ray) {
      const auto cells_here = made.cells_after(ray);
      cells.insert(cells.end(), cells_here.begin(), cells_here.end());
    }
  }
  double radius(int ring) const { return std::pow(1.2, ring) - 1; }
  Point place(FanRows::Corner c) const { return radius(c.ring) * rays[c.ray]; }
  double area(const FanRows::Cell& cell) const {
    double twice = 0;
    for (std::size_t k = 0; k < cell.size(); ++k)
      twice += cross(place(cell[k]), place(cell[(k + 1) % cell.size()]));
    return twice / 2;
  }
  /// Of the polygon between the outermost nodes of all rays.
  double area() const {
    double sum = 0;
    for (std::size_t k = 1; k < rays.size(); ++k) sum += cross(rays[k], rays[k - 1]) / 2;
    return radius(rings) * radius(rings) * sum;
  }
  std::vector<Point> rays;
  int rings;
  FanRows made;
  std::vector<FanRows::Cell> cells;
};

/// Corners as pairs; at the edge all rays are one.
using Node = std::pair<std::int32_t, int>;
Node node_of(FanRows::Corner c) { return c.ring == 0 ? Node{0, 0} : Node{c.ray, c.ring}; }

void expect_proper(const Fan& fan) {
  std::map<std::array<Node, 2>, int> uses;
  double sum = 0;
  for (const FanRows::Cell& cell : fan.cells) {
    ASSERT_TRUE(cell.size() == 3 || cell.size() == 4);
    sum += fan.area(cell);
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const auto next = cell[(k + 1) % cell.size()], after = cell[(k + 2) % cell.size()];
      ++uses[{node_of(cell[k]), node_of(next)}];
      EXPECT_GT(cross(fan.place(next) - fan.place(cell[k]), fan.place(after) - fan.place(next)), 0);
      if (cell[k].ring > 0) {
        EXPECT_GE(cell[k].ring, fan.made.lowest_ring(cell[k].ray)) << "there is no node";
      }
    }
  }
  EXPECT_NEAR(sum, fan.area(), 1e-9 * fan.area());
  const std::int32_t last = size32(fan.rays) - 1;
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    const auto [a, b] = edge;
    const bool outermost = a.second == fan.rings && b.second == fan.rings,
               side = (a.first == 0 || a.second == 0) && (b.first == 0 || b.second == 0),
               other_side = (a.first == last || a.second == 0) && (b.first == last || b.second == 0);
    if (!outermost && !side && !other_side) {
      EXPECT_TRUE(uses.contains({b, a})) << a.first << ' ' << a.second;
    }
  }
}

TEST(FanRows, FillTheFanAndConform) {
  for (const double degrees : {60., 120., 150., 178.}) {
    for (int rays = 2; rays <= 24; ++rays) {
      for (const int rows : {1, 2, 3, 4, 7, 10, 30}) {
        SCOPED_TRACE(testing::Message()
                     << rays << " rays over " << degrees << " degrees, " << rows << " rows");
        expect_proper(Fan(rays_over(degrees, rays), rows));
      }
    }
  }
}

TEST(FanRows, RaysThatAreWideApartDoNotMerge) {
  const Fan fan(rays_over(150, 6), 30);
  for (std::int32_t ray = 0; ray < 6; ++ray) EXPECT_EQ(fan.made.lowest_ring(ray), 1);
  EXPECT_EQ(fan.cells.size(), 5U * 30);
  EXPECT_EQ(std::ranges::count(fan.cells, 3U, &FanRows::Cell::size), 5) << "triangles at the edge alone";
}

TEST(FanRows, SharpSectorsMergeInPairsEveryThreeRows) {
  const Fan fan(rays_over(160, 9), 30);  // 20 degrees, then 40
  for (std::int32_t ray = 0; ray < 9; ++ray)
    EXPECT_EQ(fan.made.lowest_ring(ray), ray % 2 == 1 ? 28 : 1) << ray;
  const Fan twice(rays_over(160, 17), 30);  // 10, 20, 40
  for (std::int32_t ray = 0; ray < 17; ++ray)
    EXPECT_EQ(twice.made.lowest_ring(ray), ray % 2 == 1 ? 28 : ray % 4 == 2 ? 25 : 1) << ray;
}

TEST(FanRows, OfAnOddNumberOfSectorsThreeMergeInTheMiddle) {
  const auto lowest = [](double degrees, int rays) {
    const Fan fan(rays_over(degrees, rays), 10);
    std::vector<int> rings;
    for (std::int32_t ray = 0; ray < rays; ++ray) rings.push_back(fan.made.lowest_ring(ray));
    return rings;
  };
  EXPECT_EQ(lowest(45, 4), (std::vector<int>{1, 8, 8, 1}));
  EXPECT_EQ(lowest(75, 6), (std::vector<int>{1, 1, 8, 8, 1, 1})) << "15, 45 and 15 degrees";
  EXPECT_EQ(lowest(105, 8), (std::vector<int>{1, 8, 1, 8, 8, 1, 8, 1})) << "30, 45 and 30 degrees";
}

TEST(FanRows, TheFirstAndLastRayReachDownToTheEdge) {
  for (int rays = 2; rays <= 24; ++rays) {
    const Fan fan(rays_over(165, rays), 30);
    EXPECT_EQ(fan.made.lowest_ring(0), 1);
    EXPECT_EQ(fan.made.lowest_ring(rays - 1), 1);
  }
}

TEST(FanRows, MirrorImagesHaveMirroredCells) {
  for (int rays = 2; rays <= 24; ++rays) {
    std::vector<Point> uneven = rays_over(165, rays);
    for (std::size_t k = 1; k + 1 < uneven.size(); k += 3)
      uneven[k] = (1 / length(uneven[k] + 0.3 * uneven[k - 1])) * (uneven[k] + 0.3 * uneven[k - 1]);
    std::vector<Point> image(uneven.rbegin(), uneven.rend());
    for (Point& p : image) p.y = -p.y;
    const Fan one(uneven, 30), other(image, 30);
    const auto nodes = [&](const Fan& fan, bool turned) {
      std::multiset<std::set<Node>> cells;
      for (const FanRows::Cell& cell : fan.cells) {
        std::set<Node> corners;
        for (const FanRows::Corner c : cell)
          corners.insert(node_of(turned ? FanRows::Corner{rays - 1 - c.ray, c.ring} : c));
        cells.insert(corners);
      }
      return cells;
    };
    expect_proper(one);
    EXPECT_EQ(nodes(one, false), nodes(other, true)) << rays;
  }
}

}  // namespace
}  // namespace quadloop
