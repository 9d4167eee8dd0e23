// Units of lengths, stars of nodes, figures of shapes, nodes that slide along boundaries.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "smoother/binary_unit.hpp"
#include "smoother/node_stars.hpp"
#include "smoother/shape_histogram.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A triangle of this size, each node on a rank of its own as far as there are ranks.
Mesh sized(double size) {
  Mesh mesh;
  for (const Point p : {Point{0, 0}, Point{size, 0}, Point{0, size / 2}}) mesh.points.push_back(p);
  mesh.owned_nodes = 3;
  return scatter_mesh(world(), mesh, own_order(mesh));
}

TEST(BinaryUnit, IsOneForAllOrdinaryMeshes) {
  for (const double size : {1e-50, 1e-3, 1.0, 1e50})
    EXPECT_TRUE(BinaryUnit(world(), sized(size)).is_one()) << size;
  EXPECT_TRUE(BinaryUnit(world(), {}).is_one()) << "of no nodes";
  EXPECT_TRUE(BinaryUnit(world(), sized(0)).is_one());
}

TEST(BinaryUnit, BringsLengthsNearOneAndBackWithoutLosingABit) {
  for (const double size : {3e-120, 7e-300, 5e99, 1.7e308}) {
    const BinaryUnit unit(world(), sized(size));
    EXPECT_FALSE(unit.is_one());
    const Point p{size / 3, -size / 7};
    EXPECT_GT(std::abs(unit.into(p).x), 0.05);
    EXPECT_LT(std::abs(unit.into(p).x), 4);
    EXPECT_EQ(unit.out_of(unit.into(p)), p);
  }
}

TEST(BinaryUnit, TakesTheOutlineAlong) {
  const double size = 0x1p-400;
  const BinaryUnit unit(world(), sized(size));
  const Geometry geometry{{{"wall", 0.25 * size, 30, "wall"}},
                          {{0, 0}, {size, 0}, {0, size}},
                          {0, 3},
                          std::vector<BoundaryId>(3, BoundaryId{0})};
  const Geometry scaled = unit.into(geometry);
  EXPECT_EQ(scaled.spacing_of(0), unit.into({0.25 * size, 0}).x);
  EXPECT_EQ(scaled.point(1), unit.into({size, 0}));
  EXPECT_EQ(scaled.boundary(BoundaryId{0}).name, "wall");
}

Mesh jittered_grid() {
  const test::Grid grid{7, {1, 1}, true};
  Mesh mesh = grid.mesh();
  jitter(grid, 0.2, 11, mesh);
  return mesh;
}

struct Stars {
  Stars(const Communicator& comm, const Mesh& whole, const std::vector<CellTarget>& of_whole = {})
      : part{scatter_mesh(comm, whole, space_filling_order(whole))},
        halo(comm, part),
        stars(halo, all_owned(), of_whole.empty() ? of_whole : targets(comm)) {}
  std::vector<NodeId> all_owned() const {
    const auto owned = ids_below(NodeId{part.owned_nodes});
    return {owned.begin(), owned.end()};
  }
  /// One for all cells.
  std::vector<CellTarget> targets(const Communicator& comm) const {
    const std::vector<CellTarget> own(part.triangles.size() + part.quads.size(), CellTarget{{2, 0}, {0, 1}});
    return halo.spread(comm, own);
  }
  Star star(std::size_t i) const {
    Star result;
    stars.gather(i, result);
    return result;
  }
  Mesh part;
  HaloMesh halo;
  NodeStars stars;
};

TEST(NodeStars, HaveACornerOfEachTriangleAndThreeOfEachQuad) {
  const Stars all(world(), jittered_grid());
  std::vector<std::size_t> expected(all.part.owned_nodes, 0);
  all.halo.for_each_cell([&](const auto& cell) {
    for (const NodeId node : cell) {
      if (node.value() < all.part.owned_nodes) expected[node.value()] += cell.size() == 3 ? 1 : 3;
    }
  });
  for (std::size_t i = 0; i < all.stars.size(); ++i) EXPECT_EQ(all.star(i).corners().size(), expected[i]);
}

TEST(NodeStars, NeighboursShareACell) {
  const Stars all(world(), jittered_grid());
  std::vector<std::set<NodeId>> expected(all.part.owned_nodes);
  all.halo.for_each_cell([&](const auto& cell) {
    for (const NodeId node : cell) {
      for (const NodeId other : cell) {
        if (node.value() < all.part.owned_nodes && other != node) expected[node.value()].insert(other);
      }
    }
  });
  for (std::size_t i = 0; i < all.stars.size(); ++i) {
    std::set<NodeId> found;
    all.stars.for_each_neighbour(i, [&](NodeId other) { found.insert(other); });
    EXPECT_EQ(found, expected[i]);
  }
}

TEST(NodeStars, CostTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const std::vector<CellTarget> stretched(1, CellTarget{{2, 0}, {0, 1}});
  for (const auto& targets : {std::vector<CellTarget>{}, stretched}) {
    const Stars together(world(), jittered_grid(), targets), alone(self, jittered_grid(), targets);
    for (std::size_t i = 0; i < together.stars.size(); ++i) {
      const NodeId own = together.stars.nodes()[i];
      const std::size_t number = together.part.global(own).value();
      const Point p = together.part.point(own);
      EXPECT_EQ(together.star(i).worst_cost(p), alone.star(number).worst_cost(p));
      EXPECT_EQ(together.star(i).cost(p, Objective::power).objective[0],
                alone.star(number).cost(p, Objective::power).objective[0]);
    }
  }
}

TEST(NodeStars, OfIdealCellsCostNothing) {
  Mesh whole;  // two unit squares
  for (const double y : {0.0, 1.0}) {
    for (const double x : {0.0, 1.0, 2.0}) whole.points.push_back({x, y});
  }
  whole.owned_nodes = 6;
  const auto n = [](std::int32_t number) { return NodeId{number}; };
  whole.quads = {{n(0), n(1), n(4), n(3)}, {n(1), n(2), n(5), n(4)}};
  const Stars all(world(), whole);
  for (std::size_t i = 0; i < all.stars.size(); ++i)
    EXPECT_NEAR(all.star(i).worst_cost(all.part.point(NodeId{all.stars.nodes()[i]})), 0, 1e-15);
}

TEST(Histogram, LimitsBelongAbove) {
  Histogram h{"values", {1, 2}, {0, 0, 0}};
  for (const double value : {-5.0, 0.999, 1.0, 1.5, 2.0, 1e300, std::numeric_limits<double>::infinity()})
    h.add(value);
  EXPECT_EQ(h.counts, (std::vector<std::int64_t>{2, 2, 3}));
}

const Histogram& named(const std::vector<Histogram>& histograms, const std::string& name) {
  for (const Histogram& h : histograms) {
    if (h.name == name) return h;
  }
  throw std::out_of_range(name);
}

/// In which bin of the histogram all values lie; -1 where there are several.
std::int64_t only_bin(const Histogram& h) {
  std::int64_t bin = -1;
  for (std::size_t i = 0; i < h.counts.size(); ++i) {
    if (h.counts[i] == 0) continue;
    if (bin >= 0) return -1;
    bin = static_cast<std::int64_t>(i);
  }
  return bin;
}

TEST(ShapeHistograms, OfSquares) {
  Mesh whole;
  for (const Point p : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}}) whole.points.push_back(p);
  whole.owned_nodes = 4;
  whole.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  const auto histograms = shape_histograms(world(), scatter_mesh(world(), whole, own_order(whole)));
  const Histogram& angles = named(histograms, "angle");
  EXPECT_EQ(only_bin(angles),
            std::upper_bound(angles.limits.begin(), angles.limits.end(), 90.0) - angles.limits.begin());
  EXPECT_EQ(only_bin(named(histograms, "aspect ratio")), 0);
  EXPECT_EQ(only_bin(named(histograms, "skewness")), 0);
  EXPECT_EQ(only_bin(named(histograms, "condition number")), 0);
}

TEST(ShapeHistograms, OfAnInvertedCellEndInTheLastBins) {
  Mesh whole;
  for (const Point p : {Point{0, 0}, Point{0, 1}, Point{1, 0}}) whole.points.push_back(p);
  whole.owned_nodes = 3;
  whole.triangles = {{NodeId{0}, NodeId{1}, NodeId{2}}};
  const auto histograms = shape_histograms(world(), scatter_mesh(world(), whole, own_order(whole)));
  EXPECT_EQ(only_bin(named(histograms, "angle")), 0) << "negative";
  EXPECT_EQ(named(histograms, "condition number").counts.back(), 1);
  EXPECT_EQ(named(histograms, "skewness").counts.back(), 1);
}

TEST(ShapeHistograms, CountEveryCellOfAllRanksOnce) {
  const Mesh whole = jittered_grid();
  const Communicator self(MPI_COMM_SELF);
  const auto together = shape_histograms(world(), scatter_mesh(world(), whole, space_filling_order(whole)));
  const auto alone = shape_histograms(self, whole);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < together.size(); ++i) EXPECT_EQ(together[i].counts, alone[i].counts);
}

}  // namespace
}  // namespace quadloop
