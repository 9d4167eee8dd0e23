// Sensors on meshes as they are built: a leaf gets the values of what lies in it, and the marks are the same
// on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapt/sensor/cells_of_leaves.hpp"
#include "adapt/sensor/indicator.hpp"
#include "adapt/sensor/recovery/hessians.hpp"
#include "adapt/sensor/thresholds.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::world;

/// A square round a circle of radius 0.5, the leaves at which are of edge 1/16.
MeshResult round_a_circle(const Communicator& comm, MeshType type) {
  Chain box, wall;
  box.name = "box";
  box.points = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  wall.name = "wall";
  for (int i = 0; i < 200; ++i) {
    const double t = -2 * std::numbers::pi * i / 200;
    wall.points.push_back({0.013 + 0.5 * std::cos(t), 0.017 + 0.5 * std::sin(t)});
  }
  AssembleOptions how;
  BoundaryRule at_wall, at_box;
  at_wall.pattern = "wall";
  at_wall.spacing = 0.0625;
  at_box.pattern = "box";
  at_box.spacing = 0.25;
  how.rules = {at_wall, at_box};
  Warnings warnings;
  MeshOptions options;
  options.type = type;
  options.size.min = 0.01;
  options.size.max = 0.5;
  return build_mesh(comm, assemble({box, wall}, how, warnings), options);
}

/// A shock at x = 0.3.
double step(std::int64_t, Point p) { return std::tanh(20 * (p.x - 0.3)); }

TEST(BuiltMesh, ALeafHasWhatLiesInIt) {
  const MeshResult result = round_a_circle(world(), MeshType::hybrid);
  const TreeAttributes& tree = result.tree.attributes;
  const double shift = 2;  // errors are not negative
  const Field place = field_of(result.mesh, "x", [&](std::int64_t, Point p) { return p.x + shift; });
  const std::vector<double> rightmost = leaf_errors(world(), result.mesh, result.tree.leaves, place);
  std::int64_t with_cells = 0;
  for (std::size_t i = 0; i < rightmost.size(); ++i) {
    const LeafRecord& leaf = result.tree.leaves[i];
    if (!has_cells(leaf)) continue;
    const double edge = std::ldexp(tree.tree_edge, -leaf.level),
                 left = tree.root_x + (leaf.tree_x + std::ldexp(leaf.x, -30)) * tree.tree_edge;
    EXPECT_GT(rightmost[i] - shift, left - 0.4 * edge);  // corners are moved by up to 0.4 of an edge
    EXPECT_LT(rightmost[i] - shift, left + edge + 0.4 * edge);
    ++with_cells;
  }
  EXPECT_GT(world().sum(with_cells), 200);
}

TEST(BuiltMesh, LeavesAtAShockAreRefined) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const MeshResult result = round_a_circle(world(), type);
    const TreeAttributes& tree = result.tree.attributes;
    const Field fields = field_of(result.mesh, "density", step);
    const auto values =
        leaf_indicator(world(), result.mesh, result.tree.leaves, fields, Indicator::difference);
    const test::RuledFlags marked = test::flags_by(DeviationRule{}, world(), result.tree.leaves, values);
    EXPECT_GT(marked.refined, 0);
    EXPECT_GT(marked.coarsened, 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const LeafRecord& leaf = result.tree.leaves[i];
      const double edge = std::ldexp(tree.tree_edge, -leaf.level);
      const double centre = tree.root_x + (leaf.tree_x + std::ldexp(leaf.x, -30)) * tree.tree_edge + edge / 2,
                   far = std::abs(centre - 0.3) - edge;
      if (marked.flags[i] == RefinementFlag::refine) {
        EXPECT_LT(far, 0.15);
      }
      if (marked.flags[i] == RefinementFlag::coarsen) {
        EXPECT_GT(far, 0);
      }
    }
  }
}

TEST(BuiltMesh, HessiansAreRightAtWallsAndBetweenLevels) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const MeshResult result = round_a_circle(world(), type);
    ScaledField field;
    for (const Point p : result.mesh.points) field.values.push_back(p.x * p.x - 3 * p.x * p.y + p.y);
    const Hessian expected = absolute({2, -3, 0});
    for (const CellHessian& found : cell_hessians(world(), result.mesh, field, ValuesAt::nodes)) {
      EXPECT_NEAR(found.mean.xx, expected.xx, 1e-4);
      EXPECT_NEAR(found.mean.xy, expected.xy, 1e-4);
      EXPECT_NEAR(found.mean.yy, expected.yy, 1e-4);
    }
  }
}

TEST(BuiltMesh, MarksAreTheSameOnAnyNumberOfRanks) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const Communicator alone(MPI_COMM_SELF);
    const MeshResult one = round_a_circle(alone, type), all = round_a_circle(world(), type);
    for (const Indicator kind : {Indicator::difference, Indicator::gradient, Indicator::hessian}) {
      const auto values_of = [&](const Communicator& comm, const MeshResult& result) {
        return leaf_indicator(comm, result.mesh, result.tree.leaves, field_of(result.mesh, "density", step),
                              kind);
      };
      const std::vector<double> of_one = values_of(alone, one), of_all = values_of(world(), all);
      EXPECT_EQ(test::joined(world(), of_all), of_one);
      const test::RuledFlags expected = test::flags_by(DeviationRule{}, alone, one.tree.leaves, of_one);
      EXPECT_EQ(
          test::joined(world(), test::flags_by(DeviationRule{}, world(), all.tree.leaves, of_all).flags),
          expected.flags);
      EXPECT_GT(expected.refined, 0);
    }
  }
}

}  // namespace
}  // namespace quadloop::adapt
