// The linear system of an implicit step, and its colours.
#include "flow/euler/implicit/implicit_system.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/euler/implicit/colouring.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

/// The free stream of Mach 0.5 round an ellipse, on the ranks of a communicator.
struct Ring {
  explicit Ring(const Communicator& on = world())
      : comm{on},
        whole{test::ring_mesh(24, 6, 0.4, 8)},
        mesh{scatter_mesh(comm, whole, space_filling_order(whole))},
        dual{comm, mesh},
        options{at_half_the_speed_of_sound()},
        model{flow_model(comm, mesh, options)},
        states(dual.nodes(), model.free_stream) {}

  static EulerOptions at_half_the_speed_of_sound() {
    EulerOptions options;
    options.mach = 0.5;
    return options;
  }

  const Communicator& comm;
  Mesh whole, mesh;
  DualMesh dual;
  EulerOptions options;
  FlowModel model;
  IdVector<NodeId, State> states;
};

TEST(ColourEdges, NoEdgeJoinsTwoOfOneColour) {
  const Ring ring;
  const Colouring colours = colour_dual_nodes(world(), ring.dual);
  for (const DualEdge& edge : ring.dual.edges()) {
    EXPECT_NE(colours.colour_of[edge.low], colours.colour_of[edge.high]);
    EXPECT_GE(colours.colour_of[edge.low], 0);
  }
  EXPECT_LE(colours.count, 5);
}

IdVector<NodeId, Flux> made_up_residual(const DualMesh& mesh) {
  IdVector<NodeId, Flux> residual(mesh.nodes());
  for (const NodeId node : mesh.ids()) {
    for (int k = 0; k < 4; ++k) residual[node][k] = 0.01 * test::scattered(11, mesh.global(node).value(), k);
  }
  return residual;
}

IdVector<NodeId, Change> relaxed(const Ring& ring, double cfl, int sweeps, double scale = 1) {
  ImplicitSystem system(ring.comm, ring.dual, ring.model);
  system.assemble(ring.states, cfl, IdVector<NodeId, double>(ring.dual.owned_nodes(), 1));
  IdVector<NodeId, Flux> residual = made_up_residual(ring.dual);
  for (Flux& flux : residual) {
    for (double& part : flux) part *= scale;
  }
  IdVector<NodeId, Change> change(ring.dual.nodes());
  system.relax(residual, sweeps, change);
  change.resize(ring.dual.owned_nodes());
  return change;
}

TEST(ImplicitSystem, HasTheSameBitsOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Ring together, alone{self};
  const auto part = relaxed(together, 20, 5), whole = relaxed(alone, 20, 5);
  for (const NodeId i : part.ids())
    EXPECT_EQ(part[i], whole[NodeId{static_cast<std::int32_t>(together.mesh.global(i).value())}]);
}

TEST(ImplicitSystem, IsLinear) {
  const Ring ring;
  const auto once = relaxed(ring, 20, 5), twice = relaxed(ring, 20, 5, 2);
  for (const NodeId i : once.ids()) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(twice[i][k], 2 * once[i][k]);
  }
  for (const Change& change : relaxed(ring, 20, 3, 0)) EXPECT_EQ(change, Change{});
}

/// Of a tiny time step the change goes against the residual, and every sweep finds it.
TEST(ImplicitSystem, ASmallStepIsAnExplicitOne) {
  const Ring ring;
  const auto once = relaxed(ring, 1e-6, 1), often = relaxed(ring, 1e-6, 8);
  const auto residual = made_up_residual(ring.dual);
  for (const NodeId i : once.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(once[i][k], often[i][k], 1e-4F * std::abs(often[i][k]) + 1e-12F);
      EXPECT_LE(often[i][k] * residual[i][k], 0);
    }
  }
}

TEST(ImplicitSystem, SweepsConverge) {
  const Ring ring;
  const auto distance = [](const IdVector<NodeId, Change>& a, const IdVector<NodeId, Change>& b) {
    double largest = 0;
    for (const NodeId i : a.ids()) {
      for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, std::abs(1.0 * a[i][k] - b[i][k]));
    }
    return world().maximum(largest);
  };
  const auto solved = relaxed(ring, 5, 200);
  EXPECT_LT(distance(relaxed(ring, 5, 20), solved), 0.1 * distance(relaxed(ring, 5, 2), solved));
  EXPECT_LT(distance(relaxed(ring, 5, 100), solved), 1e-6);
}

}  // namespace
}  // namespace quadloop::flow::euler
