#include "flow/euler/model/flow_model.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "flow/euler/model/flux.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::flow::euler {

namespace {

/// Returns the solver's condition; empty if it is not supported.
Condition used_as(BoundaryCondition condition) {
  switch (condition.kind()) {
    case BoundaryCondition::wall:
    case BoundaryCondition::viscous_wall:
    case BoundaryCondition::inviscid_wall: return Condition::wall;
    case BoundaryCondition::farfield: return Condition::farfield;
    case BoundaryCondition::inflow: return Condition::inflow;
    case BoundaryCondition::outflow: return Condition::outflow;
    case BoundaryCondition::symmetry: return Condition::symmetry;
    case BoundaryCondition::interface:
    case BoundaryCondition::none: break;
  }
  return Condition::none;
}

/// Returns the condition in the case or the mesh; the last choice counts.
BoundaryCondition condition_of(const BoundaryEdges& boundary, const EulerOptions& options) {
  BoundaryCondition condition = boundary.condition;
  for (const BoundaryChoice& choice : options.boundaries) {
    if (choice.name == boundary.name && choice.condition != BoundaryCondition::none)
      condition = choice.condition;
  }
  return condition;
}

std::string fault_of_condition(const std::string& name, BoundaryCondition condition) {
  return condition == BoundaryCondition::none
             ? fmt::format("'{}' has no condition", name)
             : fmt::format("'{}' has the condition '{}'", name, condition.word());
}

/// Throws InputError that names all boundaries with a missing or unsupported condition, and the supported
/// ones.
void require_conditions(const std::vector<const BoundaryEdges*>& boundaries, const EulerOptions& options) {
  std::vector<std::string> faults, tables;
  for (const BoundaryEdges* boundary : boundaries) {
    const BoundaryCondition condition = condition_of(*boundary, options);
    if (used_as(condition) != Condition::none) continue;
    faults.push_back(fault_of_condition(boundary->name, condition));
    tables.push_back(fmt::format("[boundary.{}]", boundary->name));
  }
  if (faults.empty()) return;
  std::vector<std::string> usable;
  for (const auto& [word, condition] : values_of_bc()) {
    if (used_as(condition) != Condition::none) usable.emplace_back(word);
  }
  const std::string last = usable.back();
  usable.pop_back();
  throw InputError(fmt::format("the flow solver cannot use these boundaries: {}; in {} set bc to {} or {}",
                               fmt::join(faults, ", "), fmt::join(tables, ", "), fmt::join(usable, ", "),
                               last));
}

BoundaryModel boundary_model(const BoundaryEdges& boundary, const EulerOptions& options) {
  std::optional<double> pressure, temperature;
  for (const BoundaryChoice& choice : options.boundaries) {
    if (choice.name != boundary.name) continue;
    if (choice.pressure) pressure = *choice.pressure / options.gamma;
    temperature = choice.temperature;
  }
  Condition condition = used_as(condition_of(boundary, options));
  if (condition == Condition::wall && options.viscosity > 0) condition = Condition::no_slip;
  return {condition, pressure, temperature};
}

template <class Real>
StateOf<Real> free_stream_as(const FlowModel& model) {
  StateOf<Real> state;
  std::ranges::copy(model.free_stream, state.begin());
  return state;
}

template <class Real, class Vector>
FluxOf<Real> farfield_flux(const FlowModel& model, const StateOf<Real>& state, const Vector& normal) {
  return roe_flux(model.gas, state, free_stream_as<Real>(model), normal);
}

template <class Real, class Vector>
FluxOf<Real> inflow_flux(const FlowModel& model, const StateOf<Real>& state, const Vector& normal) {
  const auto along = model.free_stream[1] * normal.x + model.free_stream[2] * normal.y;
  return along <= -1 ? physical_flux(model.gas, free_stream_as<Real>(model), normal)
                     : farfield_flux(model, state, normal);
}

/// Relative to the speed of sound: limit for strong backflow, where hardly any gas leaves.
constexpr double slowest_choked = 0.1;

/// State at the sonic point of an expansion into vacuum. The wave that runs into the gas keeps entropy and
/// speed + 2 sound / (gamma - 1).
template <class Real, class Vector>
StateOf<Real> choked(const Gas& gas, const StateOf<Real>& state, const Vector& normal) {
  using std::pow;
  const auto& [rho, u, v, p] = state;
  const double g = gas.gamma - 1;
  const Real along = u * normal.x + v * normal.y, sound = gas.sound_speed(state);
  const Real left = std::max<Real>((g * along / sound + 2) / (gas.gamma + 1), slowest_choked);
  const Real faster = left * sound - along, thinner = pow(left, 2 / g);
  return {rho * thinner, u + faster * normal.x, v + faster * normal.y, p * thinner * (left * left)};
}

template <class Real, class Vector>
FluxOf<Real> outflow_flux(const FlowModel& model, const BoundaryModel& boundary, const StateOf<Real>& state,
                          const Vector& normal) {
  const auto& [rho, u, v, p] = state;
  const Real sound = model.gas.sound_speed(state);
  if (u * normal.x + v * normal.y >= sound) return physical_flux(model.gas, state, normal);
  if (!boundary.pressure) return physical_flux(model.gas, choked(model.gas, state, normal), normal);
  const Real lost = p - *boundary.pressure, faster = lost / (rho * sound);
  const Real density = std::max<Real>(rho - lost / (sound * sound), 0.1 * rho);
  return physical_flux<Real>(
      model.gas, {density, u + faster * normal.x, v + faster * normal.y, *boundary.pressure}, normal);
}

/// Derivative of the wall flux, which depends on the pressure only.
void add_wall_matrix(const Gas& gas, const State& state, Point normal, double factor, Matrix4& sum) {
  const auto& [rho, u, v, p] = state;
  const double g = gas.gamma - 1;
  const std::array<double, 4> pressure{0.5 * g * (u * u + v * v), -g * u, -g * v, g};
  for (std::size_t k = 0; k < 4; ++k) {
    sum[4 + k] += factor * normal.x * pressure[k];
    sum[8 + k] += factor * normal.y * pressure[k];
  }
}

/// Upwind derivative between the inner state and an outer one.
void add_open_matrix(const Gas& gas, const State& state, const State& outside, Point normal, double factor,
                     Matrix4& sum) {
  add_flux_matrix(gas, state, normal, 0.5 * factor, sum);
  add_upwind_matrix(gas, state, outside, normal, 0.5 * factor, sum);
}

constexpr const char* no_face = "a boundary without edges has a face";

}  // namespace

bool feels_force(Condition condition) {
  switch (condition) {
    case Condition::wall:
    case Condition::no_slip: return true;
    case Condition::farfield:
    case Condition::inflow:
    case Condition::outflow:
    case Condition::symmetry: return false;
    case Condition::none: break;
  }
  QUADLOOP_REQUIRE(false, no_face);
  return false;
}

FlowModel flow_model(const Communicator& comm, const Mesh& mesh, const EulerOptions& options) {
  FlowModel model;
  model.gas.gamma = options.gamma;
  if (options.mach > 0) model.gas.least_mach = std::min(options.mach, 1.0);
  model.viscosity = options.viscosity;
  model.prandtl = options.prandtl;
  model.free_stream = model.gas.free_stream(options.mach, options.alpha);
  std::vector<const BoundaryEdges*> present;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const bool has_edges = comm.any(!boundary.edges.empty());
    if (has_edges) present.push_back(&boundary);
    model.boundaries.push_back(has_edges ? boundary_model(boundary, options) : BoundaryModel{});
  }
  require_conditions(present, options);
  return model;
}

template <class Real, class Vector>
FluxOf<Real> boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const StateOf<Real>& state,
                           const Vector& normal) {
  switch (boundary.condition) {
    case Condition::wall:
    case Condition::no_slip:
    case Condition::symmetry: return {0, state[3] * normal.x, state[3] * normal.y, 0};
    case Condition::farfield: return farfield_flux(model, state, normal);
    case Condition::inflow: return inflow_flux(model, state, normal);
    case Condition::outflow: return outflow_flux(model, boundary, state, normal);
    case Condition::none: break;
  }
  QUADLOOP_REQUIRE(false, no_face);
  return {};
}

template Flux boundary_flux(const FlowModel&, const BoundaryModel&, const State&, const Point&);
template FluxOf<DualNumber<4>> boundary_flux(const FlowModel&, const BoundaryModel&,
                                             const StateOf<DualNumber<4>>&, const Point&);
template FluxOf<DualNumber<4>> boundary_flux(const FlowModel&, const BoundaryModel&,
                                             const StateOf<DualNumber<4>>&, const VectorOf<DualNumber<4>>&);

void add_boundary_matrix(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                         Point normal, double factor, Matrix4& sum) {
  switch (boundary.condition) {
    case Condition::wall:
    case Condition::no_slip:
    case Condition::symmetry: return add_wall_matrix(model.gas, state, normal, factor, sum);
    case Condition::farfield:
    case Condition::inflow: return add_open_matrix(model.gas, state, model.free_stream, normal, factor, sum);
    case Condition::outflow: return add_open_matrix(model.gas, state, state, normal, factor, sum);
    case Condition::none: break;
  }
  QUADLOOP_REQUIRE(false, no_face);
}

}  // namespace quadloop::flow::euler
