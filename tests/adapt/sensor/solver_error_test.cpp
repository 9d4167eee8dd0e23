// A solver's own error, shared out among cells.
#include "adapt/sensor/solver_error.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::part_of;
using test::world;

TEST(SolverErrors, AtNodesAreSharedOutAndNothingIsLost) {
  const Mesh mesh = part_of({6, {1, 2}, true});
  const Field field =
      field_of(mesh, "e", [](std::int64_t node, Point) { return 1.0 + static_cast<double>(node % 5); });
  std::vector<double> given(field.values.begin(), field.values.begin() + mesh.owned_nodes);
  const InterpolationError error = solver_error(world(), mesh, field);
  ASSERT_EQ(error.mean.size(), mesh.triangles.size() + mesh.quads.size());
  std::vector<double> found;
  for (std::size_t i = 0; i < error.mean.size(); ++i) {
    found.push_back(error.mean[i] * error.areas[i]);
    EXPECT_DOUBLE_EQ(error.bends[i] * error.areas[i], error.mean[i]);
  }
  EXPECT_NEAR(reproducible_sum(world(), found), reproducible_sum(world(), given), 1e-12);
  EXPECT_NEAR(norm_of(world(), error, 1), reproducible_sum(world(), given), 1e-12);
}

TEST(SolverErrors, InCellsStayThere) {
  const Mesh mesh = part_of({4, {1, 1}, true});
  Field field;
  field.cells.names = {"e"};
  field.cells.values.resize(mesh.triangles.size() + mesh.quads.size(), 3.0);
  const InterpolationError error = solver_error(world(), mesh, field);
  for (std::size_t i = 0; i < error.mean.size(); ++i) EXPECT_DOUBLE_EQ(error.mean[i] * error.areas[i], 3);
}

TEST(SolverErrors, MayNotBeNegative) {
  const Mesh mesh = part_of({4, {1, 1}, true});
  const Field field = field_of(mesh, "e", [](std::int64_t node, Point) { return node == 7 ? -1.0 : 1.0; });
  EXPECT_THROW(solver_error(world(), mesh, field), InputError);
}

}  // namespace
}  // namespace quadloop::adapt
