// Goals, their errors and adjoints have the same bits on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>

#include "flow/adjoint/estimate_goals.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

TEST(EstimateGoals, HaveTheSameBitsOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh whole = test::ring_mesh(24, 12, 0.3, 10);
  EulerOptions options;
  options.mach = 0.4;
  options.alpha = 2;
  options.goals = {{Goal::Quantity::lift}, {Goal::Quantity::drag}};
  options.iterations = 30;  // need not have converged
  options.adjoint_fields = true;
  const Mesh part = scatter_mesh(world(), whole, space_filling_order(whole));
  const Mesh all = scatter_mesh(self, whole, space_filling_order(whole));
  const EulerResult together = solve_euler(world(), part, options, {}, estimate_goals(options)),
                    alone = solve_euler(self, all, options, {}, estimate_goals(options));
  ASSERT_EQ(together.flow.names, alone.flow.names);
  const std::size_t width = alone.flow.width();
  EXPECT_EQ(width, 4 + 2 * 6 + 1);
  const auto first = alone.flow.values.begin() + static_cast<std::ptrdiff_t>(width * part.first_node);
  EXPECT_TRUE(std::equal(together.flow.values.begin(), together.flow.values.end(), first));
  for (std::size_t k = 0; k < alone.goals.size(); ++k) {
    EXPECT_EQ(together.goals[k].corrected, alone.goals[k].corrected);
    EXPECT_EQ(together.goals[k].error, alone.goals[k].error);
    EXPECT_EQ(together.goals[k].by_alpha, alone.goals[k].by_alpha);
    EXPECT_EQ(together.goals[k].iterations, alone.goals[k].iterations);
  }
}

}  // namespace
}  // namespace quadloop::flow
