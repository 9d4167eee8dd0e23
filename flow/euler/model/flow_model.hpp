#pragma once

#include <optional>
#include <vector>

#include "flow/euler/model/dual_number.hpp"
#include "flow/euler/model/euler_options.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/model/gas.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow::euler {

/// Boundary condition. `none` is for a boundary without edges; in viscous flow a `wall` is `no_slip`.
enum class Condition { none, wall, no_slip, farfield, inflow, outflow, symmetry };

/// Whether the boundary counts for the forces: walls do, symmetry planes do not.
bool feels_force(Condition condition);

struct BoundaryModel {
  Condition condition = Condition::none;
  std::optional<double> pressure = {};     ///< back pressure of an outflow; empty: vacuum
  std::optional<double> temperature = {};  ///< of a wall; empty: adiabatic
};

/// The gas, the free stream and the condition of each boundary of a mesh, in the mesh's order.
struct FlowModel {
  Gas gas;
  State free_stream{};
  double viscosity = 0, prandtl = 1;  ///< as in EulerOptions
  bool is_viscous() const { return viscosity > 0; }
  std::vector<BoundaryModel> boundaries;
};

/// Throws InputError for a boundary with edges whose condition is not supported. *Collective.*
FlowModel flow_model(const Communicator& comm, const Mesh& mesh, const EulerOptions& options);

/// Returns the flux out of the domain through a boundary of length 1 with this outward unit normal, for the
/// inner state `state`.
///
///   wall, no_slip, symmetry
///             the pressure alone
///   farfield  the upwind flux against the free stream, which lets waves out: lift has an error of the order
///             of chord over far-field distance (Residual::surround adds the vortex of the lift)
///   inflow    the free stream if supersonic, else as farfield
///   outflow   the inner state if supersonic, else with the given back pressure and the density and speed of
///             the outgoing waves; without back pressure as into a vacuum, with the speed of sound (Toro
///             2009, 4.6), as subsonic outflow would leave the flow undetermined
///
/// Works with doubles, and with dual numbers for derivatives with respect to the state or the normal.
template <class Real = double, class Vector = Point>
FluxOf<Real> boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const StateOf<Real>& state,
                           const Vector& normal);

/// Adds `factor` times the derivative of this flux with respect to the inner state, for implicit steps: exact
/// at walls and symmetry planes, elsewhere first-order upwind against the outer state.
void add_boundary_matrix(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                         Point normal, double factor, Matrix4& sum);

}  // namespace quadloop::flow::euler
