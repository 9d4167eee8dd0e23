// Nodes counted without a mesh are those of the mesh.
#include "mesher/build/count_nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A star of so many points in a square, its corners kept.
Geometry star(int points) {
  std::vector<Point> all{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  for (int i = 0; i < points; ++i) {
    const double angle = -2 * std::numbers::pi * (i / static_cast<double>(points) + 0.017);
    all.push_back((i % 2 == 0 ? 1.0 : 0.4) * Point{std::cos(angle), std::sin(angle)});
  }
  const auto end = size32(all);
  std::vector<BoundaryId> of_segment(all.size(), BoundaryId{1});
  std::fill_n(of_segment.begin(), 4, BoundaryId{0});
  return {{{"far", 0, 30, "farfield"}, {"star", 0.05, 30, "wall"}}, all, {0, 4, end}, of_segment};
}

/// Leaves of these levels, each in a place of its own, each with a split demanded of it.
std::vector<SplitDemand> some_demands() {
  std::vector<SplitDemand> demands;
  for (int i = 0; i < 40; ++i) {
    const int level = 3 + i % 4;
    const std::int64_t size = std::int64_t{1} << (Quadrant::unit_level - level),
                       count = std::int64_t{1} << level;
    demands.push_back({{(7 * i % count) * size, (11 * i % count) * size, level}, 1U << level});
  }
  return demands;
}

TEST(CountNodes, AreThoseOfTheMesh) {
  const Geometry geometry = star(10);
  for (const auto& [type, snap] :
       {std::pair{MeshType::hybrid, 0.4}, {MeshType::hybrid, 0.001}, {MeshType::delaunay, 0.4}}) {
    MeshOptions options;
    options.size.min = 0.03;
    options.size.max = 0.5;
    options.type = type;
    options.snap = snap;
    const auto own = world().is_root() ? some_demands() : std::vector<SplitDemand>{};
    for (const DemandedSplits& demanded : {DemandedSplits{}, DemandedSplits(world(), own)}) {
      const MeshResult made = build_mesh(world(), geometry, options, demanded);
      EXPECT_GT(made.report.cut_leaves, 50);
      EXPECT_EQ(count_nodes(world(), geometry, options, demanded), made.tree.attributes.nodes) << snap;
    }
  }
}

TEST(CountNodes, RefusesMoreCellsThanAreAllowed) {
  MeshOptions options;
  options.size.min = options.size.max = 0.02;
  options.limit.cells = 1000;
  EXPECT_THROW(count_nodes(world(), star(10), options), TooManyCells);
}

}  // namespace
}  // namespace quadloop
