#include "flow/euler/scheme/flow_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "flow/euler/scheme/flux.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::euler {

namespace {

Condition condition_of(const std::string& name, const std::string& word) {
  if (word == "wall" || word == "symmetry") return Condition::wall;
  if (word == "farfield") return Condition::farfield;
  if (word == "inflow") return Condition::inflow;
  if (word == "outflow") return Condition::outflow;
  throw InputError(
      fmt::format("boundary '{0}' has {1}, which the flow solver cannot use; set [boundary.{0}] bc to wall, "
                  "farfield, inflow, outflow or symmetry",
                  name, word.empty() || word == "none" ? "no condition" : "the condition '" + word + "'"));
}

BoundaryModel boundary_model(const BoundaryEdges& boundary, const EulerOptions& options) {
  std::string word = boundary.condition;
  std::optional<double> pressure;
  for (const BoundaryChoice& choice : options.boundaries) {
    if (choice.name != boundary.name) continue;
    if (!choice.condition.empty()) word = choice.condition;
    if (choice.pressure) pressure = *choice.pressure / options.gamma;
  }
  return {condition_of(boundary.name, word), pressure, word == "wall"};
}

Flux farfield_flux(const FlowModel& model, const State& state, Point normal) {
  return roe_flux(model.gas, state, model.free_stream, normal);
}

Flux inflow_flux(const FlowModel& model, const State& state, Point normal) {
  const double along = model.free_stream[1] * normal.x + model.free_stream[2] * normal.y;
  return along <= -1 ? physical_flux(model.gas, model.free_stream, normal)
                     : farfield_flux(model, state, normal);
}

Flux outflow_flux(const FlowModel& model, const BoundaryModel& boundary, const State& state, Point normal) {
  const auto& [rho, u, v, p] = state;
  const double sound = model.gas.sound_speed(state);
  if (!boundary.pressure || u * normal.x + v * normal.y >= sound)
    return physical_flux(model.gas, state, normal);
  const double lost = p - *boundary.pressure, faster = lost / (rho * sound);
  const double density = std::max(rho - lost / (sound * sound), 0.1 * rho);
  return physical_flux(model.gas, {density, u + faster * normal.x, v + faster * normal.y, *boundary.pressure},
                       normal);
}

}  // namespace

FlowModel flow_model(const Communicator& comm, const Mesh& mesh, const EulerOptions& options) {
  FlowModel model{{options.gamma}, {}, {}};
  model.free_stream = model.gas.free_stream(options.mach, options.alpha);
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const bool present = comm.any(!boundary.edges.empty());
    model.boundaries.push_back(present ? boundary_model(boundary, options) : BoundaryModel{});
  }
  return model;
}

Flux boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const State& state, Point normal) {
  switch (boundary.condition) {
    case Condition::farfield: return farfield_flux(model, state, normal);
    case Condition::inflow: return inflow_flux(model, state, normal);
    case Condition::outflow: return outflow_flux(model, boundary, state, normal);
    default: return {0, state[3] * normal.x, state[3] * normal.y, 0};
  }
}

}  // namespace quadloop::euler
