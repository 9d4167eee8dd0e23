// Flows have the same bits on any number of ranks, whatever the order in which the mesh is shared out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "flow/euler/solve_euler.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

/// Two runs, on all ranks and alone, must agree to the last bit.
void expect_same_on_all_ranks(const Mesh& whole, const MeshOrder& order, const EulerOptions& options) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh part = scatter_mesh(world(), whole, order);
  const Mesh all = scatter_mesh(self, whole, order);
  const EulerResult together = solve_euler(world(), part, options), alone = solve_euler(self, all, options);
  const std::size_t width = alone.flow.names.size();
  const auto first = alone.flow.values.begin() + static_cast<std::ptrdiff_t>(width * part.first_node);
  EXPECT_TRUE(std::equal(together.flow.values.begin(), together.flow.values.end(), first));
  EXPECT_EQ(together.iterations, alone.iterations);
  EXPECT_EQ(together.residual, alone.residual);
  EXPECT_EQ(together.cl, alone.cl);
  EXPECT_EQ(together.cd, alone.cd);
  EXPECT_EQ(together.time, alone.time);
  ASSERT_EQ(together.unsteady.has_value(), alone.unsteady.has_value());
  if (alone.unsteady) {
    EXPECT_EQ(line_of(*together.unsteady), line_of(*alone.unsteady));
  }
}

TEST(Ranks, GiveTheSameBits) {
  EulerOptions options;
  options.mach = 0.7;
  options.alpha = 5;
  options.iterations = 12;
  options.boundaries = {{"wall", "wall", {}}, {"far", "farfield", {}}};
  const Mesh grid = test::irregular_grid(9, {1, 1}, 0.2);
  const Mesh ring = test::ring_mesh(24, 8, 0.3, 5);
  const Mesh tiny = test::irregular_grid(2, {1, 1}, 0.2);  // ranks without nodes
  for (const auto time : {EulerOptions::Time::steady, EulerOptions::Time::accurate}) {
    options.time = time;
    for (const Mesh* mesh : {&grid, &ring, &tiny}) {
      expect_same_on_all_ranks(*mesh, space_filling_order(*mesh), options);
      expect_same_on_all_ranks(*mesh, test::shuffled_order(*mesh, 5), options);
    }
  }
}

TEST(Ranks, GiveTheSameBitsWithAVortexFarAway) {
  EulerOptions options;
  options.mach = 0.5;
  options.alpha = 5;
  options.iterations = 12;
  options.far_field = EulerOptions::FarField::vortex;
  const Mesh ring = test::ring_mesh(24, 8, 0.3, 5);
  for (const auto time : {EulerOptions::Time::steady, EulerOptions::Time::accurate}) {
    options.time = time;
    expect_same_on_all_ranks(ring, space_filling_order(ring), options);
    expect_same_on_all_ranks(ring, test::shuffled_order(ring, 5), options);
  }
}

TEST(Ranks, GiveTheSameBitsInThinLayers) {
  EulerOptions options;
  options.mach = 0.5;
  options.iterations = 12;
  options.boundaries = {{"wall", "wall", {}, 0.9}, {"far", "farfield", {}}};
  const Mesh grid = test::irregular_grid(9, {1, 0.01}, 0.1);
  const Mesh ring = test::ring_mesh(10, 24, 1, 0.6);
  Mesh graded = test::irregular_grid(12, {1, 1}, 0.1);  // lines end among cells of moderate shape
  for (Point& p : graded.points) p.y = p.y * p.y * p.y * p.y;
  for (const double viscosity : {0.0, 1e-3}) {
    options.viscosity = viscosity;
    for (const Mesh* mesh : std::array<const Mesh*, 3>{&grid, &ring, &graded}) {
      expect_same_on_all_ranks(*mesh, space_filling_order(*mesh), options);
      expect_same_on_all_ranks(*mesh, test::shuffled_order(*mesh, 5), options);
    }
  }
}

TEST(Ranks, GiveTheSameBitsInTime) {
  EulerOptions options;
  options.mach = 0.5;
  options.alpha = 5;
  options.time_step = 0.1;
  options.boundaries = {{"wall", "wall", {}, 0.9}, {"far", "farfield", {}}};
  const Mesh ring = test::ring_mesh(24, 8, 0.3, 5);
  const Mesh tiny = test::irregular_grid(2, {1, 1}, 0.2);  // ranks without nodes
  for (const double viscosity : {0.0, 1e-2}) {
    options.viscosity = viscosity;
    for (const Mesh* mesh : {&ring, &tiny}) {
      options.time = EulerOptions::Time::accurate;
      options.average_from = 0.5;
      options.unsteady = EulerOptions::Unsteady::stop;
      options.iterations = 100;
      expect_same_on_all_ranks(*mesh, test::shuffled_order(*mesh, 5), options);
      options.time = EulerOptions::Time::steady;
      options.unsteady = EulerOptions::Unsteady::continue_in_time;
      options.flow_throughs = 1;
      options.iterations = 3;
      expect_same_on_all_ranks(*mesh, test::shuffled_order(*mesh, 5), options);
    }
  }
}

}  // namespace
}  // namespace quadloop::flow
