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

namespace quadloop {

/// What the user asks of one boundary of the mesh.
struct BoundaryChoice {
  std::string name;
  BoundaryCondition condition = {};  ///< none: the mesh's own
  std::optional<double> pressure;    ///< behind an outflow, in units of the free stream's; none: the flow
                                     ///< leaves faster than sound
  std::optional<double> temperature = {};  ///< of a wall that a viscous flow sticks to, in units of the free
                                           ///< stream's; none: it lets no heat through
};

/// How far a run has come.
struct EulerProgress {
  int iteration = 0;    ///< steps done
  double residual = 0;  ///< as in EulerResult
  double cl = 0, cd = 0;
  double time = 0;  ///< of an accurate run
  double cfl = 0;   ///< of the last step
};

/// The flow, and how it is found. Free stream: density 1, speed of sound 1, so that its pressure is 1 / gamma
/// and its speed the Mach number; time in units of the geometry's length over the speed of sound.
struct EulerOptions {
  enum class Time { steady, accurate };
  enum class Limiter { venkatakrishnan, none };
  enum class Initial { freestream, vortex };
  enum class FarField { uniform, vortex };
  enum class Unsteady { stop, carry_on };

  double mach = 0.8;
  double alpha = 0;  ///< degrees
  double gamma = 1.4;
  /// The same everywhere, in units of the free stream's density, its speed of sound and the geometry's
  /// length: that is Mach number times length over Reynolds number. Above 0 the flow is laminar and sticks to
  /// walls.
  double viscosity = 0;
  double prandtl = 0.72;
  Time time = Time::steady;
  double end_time = 1;  ///< of an accurate run
  /// In time: steps are implicit and of this size. None: explicit steps, or what carrying on takes.
  std::optional<double> time_step;
  /// Of an accurate run: flow and forces are means from this time to the end.
  std::optional<double> average_from;
  /// What becomes of a steady flow that does not converge: its best state is kept, or it goes on in time for
  /// so many flow-through times (length of the walls' box over the free stream's speed); flow and forces are
  /// then means over the second half.
  Unsteady unsteady = Unsteady::stop;
  double flow_throughs = 40;
  /// Steady: of the first steps, it grows as the residual falls; accurate: no more than 0.8 is used.
  double cfl = 20;
  int iterations = 2000;    ///< at most; an accurate run that needs more ends early
  double tolerance = 1e-8;  ///< steady: on the density residual, as EulerResult::residual is relative
  Limiter limiter = Limiter::venkatakrishnan;
  Initial initial = Initial::freestream;
  /// Beyond far fields: the free stream alone, or with the vortex of the body's lift (FarField), for flows
  /// slower than sound.
  FarField far_field = FarField::uniform;
  /// The mesh is meant to be its own mirror image in this axis. Where it is, and the free stream runs along
  /// the axis, the limiter's factors that are kept are those of a flow that is its own image.
  std::optional<MirrorAxis> mirror;
  std::optional<Point> vortex_centre;  ///< none: the middle of the mesh's box
  /// Of the forces, in the geometry's units; also of the vortex and of the limiter's sense of small.
  double reference_length = 1;
  std::vector<BoundaryChoice> boundaries;
  /// What the flow is solved for: their errors are estimated where a solver with adjoints is asked
  /// (flow/adjoint).
  std::vector<Goal> goals;
  /// The adjoint solutions join the flow, and how each goal answers to the place of each node.
  bool adjoint_fields = false;
  /// Called on every rank after every `progress_every` steps and at the end.
  std::function<void(const EulerProgress&)> progress;
  int progress_every = 50;
};

/// The variables of a state, as files name them.
inline constexpr std::array<const char*, 4> euler_names{"density", "x_velocity", "y_velocity", "pressure"};

/// Beside a mean over time: the same variables at its end, from which a flow goes on in time.
inline constexpr std::array<const char*, 4> at_end_names{"density_at_end", "x_velocity_at_end",
                                                         "y_velocity_at_end", "pressure_at_end"};

/// What a viscous flow has beside them: the stress along the wall at its nodes, positive where it pulls the
/// wall the way of the free stream, in units of the free stream's density and speed of sound; 0 elsewhere.
inline constexpr const char* wall_shear_name = "wall_shear";

/// Throws InputError that names the value and what it may be.
void validate(const EulerOptions& options);

}  // namespace quadloop
