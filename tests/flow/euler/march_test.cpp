// What marching works with: residuals, the place named in a failure, forces of known pressures.
#include "flow/euler/march.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "flow/euler/forces.hpp"
#include "flow/euler/shortfall.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

constexpr int around = 24, outwards = 6;
constexpr double thickness = 0.4;

/// The flow of Mach 0.5 round an ellipse, on the ranks of a communicator.
struct RingRun {
  explicit RingRun(const Communicator& comm = world(), double alpha = 0)
      : whole{test::ring_mesh(around, outwards, thickness, 8)},
        mesh{scatter_mesh(comm, whole, space_filling_order(whole))},
        dual{comm, mesh},
        options{options_at(alpha)},
        model{flow_model(comm, mesh, options)},
        run{comm,
            options,
            dual,
            model,
            Residual(dual, model, options),
            IdVector<NodeId, State>(dual.nodes(), model.free_stream)} {}
  static EulerOptions options_at(double alpha) {
    EulerOptions options;
    options.mach = 0.5;
    options.alpha = alpha;
    return options;
  }
  /// Every node's pressure, copies too.
  template <class Pressure>
  void set_pressure(const Pressure& pressure) {
    for (const NodeId node : dual.ids()) states[node][3] = pressure(dual.point(node));
  }
  ForceCoefficients forces(double length = 1) const {
    return wall_forces(run.comm, dual, model, states, {}, length);
  }

  Mesh whole, mesh;
  DualMesh dual;
  EulerOptions options;
  FlowModel model;
  FlowRun run;
  IdVector<NodeId, State>& states = run.states;
};

/// Of the polygon whose corners are the body's nodes.
double body_area() {
  const Mesh mesh = test::ring_mesh(around, outwards, thickness, 8);
  double twice = 0;
  for (int i = 0; i < around; ++i)
    twice += cross(mesh.point(NodeId{i}), mesh.point(NodeId{(i + 1) % around}));
  return twice / 2;
}

TEST(WallForces, OfTheFreeStreamsPressureAreNone) {
  const ForceCoefficients none = RingRun().forces();
  EXPECT_NEAR(none.cl, 0, 1e-15);
  EXPECT_NEAR(none.cd, 0, 1e-15);
}

TEST(WallForces, OfALinearPressureAreArchimedes) {
  RingRun ring;
  const double dynamic = 0.5 * 0.25;
  ring.set_pressure([](Point p) { return 1 - 0.3 * p.y; });
  EXPECT_NEAR(ring.forces().cl, 0.3 * body_area() / dynamic, 1e-12);
  EXPECT_NEAR(ring.forces().cd, 0, 1e-12);
  ring.set_pressure([](Point p) { return 1 - 0.3 * p.x; });
  EXPECT_NEAR(ring.forces().cd, 0.3 * body_area() / dynamic, 1e-12);
  EXPECT_NEAR(ring.forces(2).cd, 0.15 * body_area() / dynamic, 1e-12) << "by the reference length";
}

TEST(WallForces, AreMeasuredAcrossAndAlongTheFreeStream) {
  RingRun level, climbing(world(), 90);
  level.set_pressure([](Point p) { return 1 - 0.3 * p.x; });
  climbing.set_pressure([](Point p) { return 1 - 0.3 * p.x; });
  EXPECT_NEAR(climbing.forces().cl, -level.forces().cd, 1e-12);
  EXPECT_NEAR(climbing.forces().cd, 0, 1e-12);
}

TEST(WallForces, AreNoneWhereTheFreeStreamRests) {
  RingRun ring;
  ring.model.free_stream[1] = ring.model.free_stream[2] = 0;
  ring.set_pressure([](Point p) { return 1 - p.x; });
  EXPECT_EQ(ring.forces().cd, 0);
}

TEST(MassResidual, IsTheRootMeanSquareOverAllRanks) {
  const RingRun ring;
  IdVector<NodeId, Flux> fluxes(ring.dual.nodes(), Flux{-3, 7, 7, 7});
  EXPECT_EQ(mass_residual(ring.run, fluxes), 3);
  for (const NodeId node : ring.dual.owned_ids())
    fluxes[node][0] = ring.dual.global(node).value() % 2 == 0 ? 4 : 0;
  EXPECT_NEAR(mass_residual(ring.run, fluxes), std::sqrt(8), 1e-14);
}

TEST(MassResidual, IsNoNumberWhereAnyIsNone) {
  const RingRun ring;
  IdVector<NodeId, Flux> fluxes(ring.dual.nodes(), Flux{1, 0, 0, 0});
  for (const NodeId node : ring.dual.owned_ids()) {
    if (ring.dual.global(node) == GlobalNodeId{5}) fluxes[node][0] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_FALSE(std::isfinite(mass_residual(ring.run, fluxes)));
}

TEST(WorstPlace, IsThatOfTheLargestFluxOrTheFirstThatIsNone) {
  RingRun ring;
  IdVector<NodeId, Flux> fluxes(ring.dual.nodes(), Flux{1, 0, 0, 0});
  const auto set = [&](std::int64_t number, double flux, double density) {
    for (const NodeId node : ring.dual.owned_ids()) {
      if (ring.dual.global(node).value() != number) continue;
      fluxes[node][0] = flux;
      ring.states[node][0] = density;
    }
  };
  set(9, -5, 0.125);
  EXPECT_NE(worst_place(ring.run, fluxes).find("density is 0.125,"), std::string::npos);
  set(40, std::numeric_limits<double>::quiet_NaN(), 0.25);
  set(30, std::numeric_limits<double>::infinity(), 0.5);
  EXPECT_NE(worst_place(ring.run, fluxes).find("density is 0.5,"), std::string::npos) << "the lower number";
}

TEST(WorstPlace, IsTheFirstWithoutGasRatherThanANeighbourThatItSpoils) {
  RingRun ring;
  const double none = std::numeric_limits<double>::quiet_NaN();
  IdVector<NodeId, Flux> fluxes(ring.dual.nodes(), Flux{1, 0, 0, 0});
  const auto at = [&ring](std::int64_t number) -> NodeId {
    for (const NodeId node : ring.dual.owned_ids()) {
      if (ring.dual.global(node).value() == number) return node;
    }
    return NodeId{};
  };
  if (at(20).valid()) fluxes[at(20)][0] = none;
  for (const auto& [number, entry, value] : {std::tuple{70, 0, -0.25}, {40, 3, 0.0}, {30, 2, none}}) {
    if (at(number).valid()) ring.states[at(number)][entry] = value;
    const std::string said = worst_place(ring.run, fluxes);
    const std::string words = entry == 0   ? "where density is -0.25,"
                              : entry == 3 ? "and pressure 0"
                                           : "velocity (0.5, nan)";
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
}

/// A run whose flow is spoilt as soon as its residual is below this, again and again.
std::optional<EulerResult> spoilt_below(double residual) {
  RingRun ring;
  ring.options.progress_every = 1;
  ring.options.iterations = 300;
  ring.options.progress = [&](const EulerProgress& now) {
    if (now.residual < residual && now.cfl > 0)
      ring.states[NodeId{0}][3] = std::numeric_limits<double>::quiet_NaN();
  };
  try {
    return march_to_steady(ring.run);
  } catch (const SolverError&) {
    return {};
  }
}

TEST(MarchToSteady, KeepsTheBestOfAFlowThatFailsNearItsEnd) {
  const std::optional<EulerResult> kept = spoilt_below(1e-3);
  ASSERT_TRUE(kept);
  EXPECT_FALSE(kept->converged);
  EXPECT_LT(kept->residual, 1e-3);
  EXPECT_LE(kept->kept_iteration, kept->iterations);
  const std::string said = shortfall(*kept, EulerOptions{});
  EXPECT_NE(said.find("the flow solver failed after"), std::string::npos) << said;
  EXPECT_NE(said.find("is kept, with a residual of"), std::string::npos) << said;
  EXPECT_FALSE(spoilt_below(0.5)) << "a flow that has no shape yet";
}

}  // namespace
}  // namespace quadloop::flow::euler
