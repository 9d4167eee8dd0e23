#pragma once

#include <vector>

#include "flow/adjoint/goal_functional.hpp"
#include "flow/euler/scheme/flow_run.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// States that nothing has solved for, on a mesh over all ranks, and what a residual needs.
struct AdjointRun {
  AdjointRun(const Communicator& comm, const Mesh& whole, flow::EulerOptions with, double strength = 0.2)
      : mesh{scatter_mesh(comm, whole, space_filling_order(whole))},
        dual{comm, mesh},
        options{std::move(with)},
        model{flow::euler::flow_model(comm, mesh, options)},
        run{comm,
            options,
            dual,
            model,
            flow::euler::Residual(dual, model, options),
            IdVector<NodeId, flow::euler::State>(dual.nodes(), model.free_stream)} {
    for (const BoundaryEdges& boundary : mesh.boundaries) names.push_back(boundary.name);
    for (const NodeId node : dual.ids()) {
      const std::int64_t number = dual.global(node).value();
      for (int k = 0; k < 4; ++k) states[node][k] *= 1 + strength * scattered(7, number, k);
    }
  }

  /// Values for all nodes that their numbers alone decide.
  IdVector<NodeId, flow::euler::State> made_up(std::uint64_t seed) const {
    IdVector<NodeId, flow::euler::State> rows(dual.nodes());
    for (const NodeId node : rows.ids()) {
      for (int k = 0; k < 4; ++k) rows[node][k] = scattered(seed, dual.global(node).value(), k);
    }
    return rows;
  }

  std::vector<std::string> names;
  Mesh mesh;
  flow::euler::DualMesh dual;
  flow::EulerOptions options;
  flow::euler::FlowModel model;
  flow::euler::FlowRun run;
  flow::euler::Residual& residual = run.residual;
  IdVector<NodeId, flow::euler::State>& states = run.states;
};

}  // namespace quadloop::test
