#pragma once

#include <span>
#include <vector>

#include "adapt/loop/loop.hpp"
#include "tests/adapt/remesh/circular_shock.hpp"
#include "tests/adapt/remesh/square_input.hpp"

namespace quadloop::test {

inline const MeshInput square_in_eighths = square_input(0.125);

/// Of runs on the square with one variable, "q".
inline adapt::AdaptOptions options_of(int cycles) {
  adapt::AdaptOptions options;
  options.cycles = cycles;
  options.variables = {"q"};
  options.min = 1.0 / 256;
  return options;
}

/// A solver whose flow is the front.
inline flow::SolvedFlow solve_shock(const Communicator&, const Mesh& mesh, const Field&, int) {
  flow::SolvedFlow flow;
  flow.solution.names = {"q"};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    flow.solution.values.push_back(circular_shock(mesh.point(NodeId{i})));
  return flow;
}

/// And one whose flow is constant: it asks for no other mesh.
inline flow::SolvedFlow solve_constant(const Communicator&, const Mesh& mesh, const Field&, int) {
  flow::SolvedFlow flow;
  flow.solution = {{"q"}, std::vector<double>(mesh.owned_nodes, 3.0), {}};
  return flow;
}

/// Those of all ranks. *Collective.*
inline std::vector<Point> all_nodes(const Communicator& comm, const Mesh& mesh) {
  return comm.all_gather_values(std::span(mesh.points).first(mesh.owned_nodes));
}

}  // namespace quadloop::test
