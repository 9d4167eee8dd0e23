#include "adapt/solvers/wall_quantities.hpp"

#include <fmt/format.h>

#include <utility>

#include "flow/postprocess/boundary_forces.hpp"
#include "flow/postprocess/wall_flow.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

/// *Collective.*
void add_forces(const Communicator& comm, const Mesh& mesh, const flow::FreeStream& stream,
                flow::SolvedFlow& flow) {
  const std::vector<std::string> walls = flow::walls_of(mesh);
  flow.at_walls = flow::wall_flow(comm, mesh, flow.solution, stream, walls, "the flow");
  flow.forces = flow::boundary_forces(comm, mesh, flow.at_walls, stream, walls);
  flow.stream = stream;
  if (flow.cl || flow.cd || flow.forces.empty()) return;
  flow.cl = flow.cd = 0;
  for (const flow::BoundaryForce& force : flow.forces) {
    *flow.cl += force.cl;
    *flow.cd += force.cd;
  }
}

}  // namespace

flow::FlowSolver with_wall_quantities(flow::FlowSolver solver, flow::FreeStream stream) {
  return [solver = std::move(solver), stream](const Communicator& comm, const Mesh& mesh, const Field& start,
                                              int cycle) {
    flow::SolvedFlow flow = solver(comm, mesh, start, cycle);
    try {
      add_forces(comm, mesh, stream, flow);
    } catch (const InputError& fault) {  // a missing variable: the same on every rank
      flow.warnings.push_back(fmt::format("no forces and no values along walls: {}", fault.what()));
    }
    return flow;
  };
}

}  // namespace quadloop::adapt
