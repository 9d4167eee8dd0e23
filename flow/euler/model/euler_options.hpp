#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flow/euler/model/goal.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::flow {

/// User options of one boundary of the mesh.
struct BoundaryChoice {
  std::string name;
  BoundaryCondition condition = {};  ///< none: that of the mesh
  /// Back pressure of an outflow, in units of the free-stream pressure; empty: supersonic outflow (choked
  /// where subsonic).
  std::optional<double> pressure;
  /// Temperature of a no-slip wall, in units of the free-stream temperature; empty: adiabatic.
  std::optional<double> temperature = {};
};

/// Progress of a run.
struct EulerProgress {
  int iteration = 0;    ///< number of steps
  double residual = 0;  ///< as in EulerResult
  double cl = 0, cd = 0;
  double time = 0;  ///< of an unsteady run
  double cfl = 0;   ///< of the last step
};

/// Flow conditions and solution method. Units: free-stream density 1 and speed of sound 1, so the free-stream
/// pressure is 1 / gamma and the speed is the Mach number; time is in geometry length over speed of sound.
struct EulerOptions {
  enum class Time { steady, accurate };
  enum class Limiter { venkatakrishnan, none };
  enum class Initial { freestream, vortex };
  enum class FarField { uniform, vortex };
  enum class Unsteady { stop, continue_in_time };

  double mach = 0.8;
  double alpha = 0;  ///< degrees
  double gamma = 1.4;
  /// Constant dynamic viscosity, in units of free-stream density, speed of sound and geometry length: Mach
  /// number times length over Reynolds number. Above 0 the flow is laminar with no-slip walls.
  double viscosity = 0;
  double prandtl = 0.72;
  Time time = Time::steady;
  double end_time = 1;  ///< of an unsteady run
  /// Unsteady: implicit steps of this size. Empty: explicit steps, or steps chosen by the unsteady
  /// continuation.
  std::optional<double> time_step;
  /// Unsteady: flow and forces are averaged from this time to the end.
  std::optional<double> average_from;
  /// For a steady run that does not converge: keep the best state, or continue in time for `flow_throughs`
  /// flow-through times (length of the walls' bounding box over free-stream speed); flow and forces are then
  /// averages over the second half.
  Unsteady unsteady = Unsteady::stop;
  double flow_throughs = 40;
  /// Steady: CFL number of the first steps, increasing as the residual falls; unsteady: limited to 0.8.
  double cfl = 20;
  int iterations = 2000;    ///< maximum number; an unsteady run that needs more ends early
  double tolerance = 1e-8;  ///< steady: on the density residual, relative as EulerResult::residual
  Limiter limiter = Limiter::venkatakrishnan;
  Initial initial = Initial::freestream;
  /// Flow beyond far-field boundaries: free stream, or with the point vortex of the lift (FarField), for
  /// subsonic flow.
  FarField far_field = FarField::uniform;
  /// The mesh is meant to be mirror-symmetric in this axis. If it is, and the free stream is parallel to the
  /// axis, the limiter is frozen with the factors of a symmetric flow.
  std::optional<MirrorAxis> mirror;
  std::optional<Point> vortex_centre;  ///< empty: centre of the mesh's bounding box
  /// For the forces, in the geometry's units; also for the vortex and the limiter's smoothness scale.
  double reference_length = 1;
  std::vector<BoundaryChoice> boundaries;
  /// Output functionals; their errors are estimated by solvers with adjoints (flow/adjoint).
  std::vector<Goal> goals;
  /// Adds to the solution the adjoints, and the derivative of each output functional with respect to the
  /// position of each node.
  bool adjoint_fields = false;
  /// Called on every rank after every `progress_every` steps and at the end.
  std::function<void(const EulerProgress&)> progress;
  int progress_every = 50;
};

/// Names of the variables of a state in files.
inline constexpr std::array<const char*, 4> euler_names{"density", "x_velocity", "y_velocity", "pressure"};

/// Names of the final values that are stored with a time average, from which an unsteady run continues.
inline constexpr std::array<const char*, 4> at_end_names{"density_at_end", "x_velocity_at_end",
                                                         "y_velocity_at_end", "pressure_at_end"};

/// Additional variable of a viscous flow: wall shear stress at wall nodes, positive in the free-stream
/// direction, in units of free-stream density and speed of sound; 0 elsewhere.
inline constexpr const char* wall_shear_name = "wall_shear";

/// Throws InputError that names the value and its valid range.
void validate(const EulerOptions& options);

}  // namespace quadloop::flow
