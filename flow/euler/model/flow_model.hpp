#pragma once

#include <optional>
#include <vector>

#include "flow/euler/model/dual_number.hpp"
#include "flow/euler/model/euler_options.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/model/gas.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::euler {

/// What happens at a boundary. `none` stands for a boundary without edges; a `wall` is `no_slip` to a viscous
/// flow.
enum class Condition { none, wall, no_slip, farfield, inflow, outflow, symmetry };

/// Whether the forces count what the flow does there: a body does, a plane of symmetry does not.
bool feels_force(Condition condition);

struct BoundaryModel {
  Condition condition = Condition::none;
  std::optional<double> pressure = {};     ///< behind an outflow; none: a vacuum
  std::optional<double> temperature = {};  ///< of a wall, else adiabatic
};

/// The gas, the free stream and what happens at each boundary of a mesh, in the mesh's order.
struct FlowModel {
  Gas gas;
  State free_stream{};
  double viscosity = 0, prandtl = 1;  ///< as in EulerOptions
  bool is_viscous() const { return viscosity > 0; }
  std::vector<BoundaryModel> boundaries;
};

/// Throws InputError for a boundary with edges whose condition the solver cannot use. *Collective.*
FlowModel flow_model(const Communicator& comm, const Mesh& mesh, const EulerOptions& options);

/// What leaves the domain through a boundary of length 1 with this outward unit normal, the flow inside being
/// `state`.
///
///   wall, no_slip, symmetry
///             the pressure alone
///   farfield  the upwind flux against the free stream, which lets waves out: lift errs by the order of
///             chord over far-field distance (Residual::surround for one with the lift's vortex)
///   inflow    the free stream where it comes in faster than sound, else as farfield
///   outflow   the flow itself where it is faster than sound, else with the given pressure and the density
///             and speed that the outgoing waves then carry; where none is given as into a vacuum, with the
///             speed of sound (Toro 2009, 4.6): what is carried out slower would leave the flow undecided
///
/// For doubles, and for numbers with derivatives by the state or the normal.
template <class Real = double, class Vector = Point>
FluxOf<Real> boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const StateOf<Real>& state,
                           const Vector& normal);

/// Adds `factor` times how that flux answers to the state inside, as an implicit step takes it: at a wall or
/// a plane of symmetry its derivative, elsewhere first-order upwind against what is outside.
void add_boundary_matrix(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                         Point normal, double factor, Matrix4& sum);

}  // namespace quadloop::euler
