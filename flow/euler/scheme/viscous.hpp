#pragma once

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::flow::euler {

/// Gradients of velocity and temperature. The temperature is gamma pressure / density: 1 in the free stream.
struct ViscousGradient {
  Point x_velocity, y_velocity, temperature;
};

inline ViscousGradient turned(const ViscousGradient& gradient, Point direction) {
  const Point u = turned(gradient.x_velocity, direction), v = turned(gradient.y_velocity, direction);
  return {direction.x * u - direction.y * v, direction.y * u + direction.x * v,
          turned(gradient.temperature, direction)};
}

inline double temperature(const Gas& gas, const State& state) { return gas.gamma * state[3] / state[0]; }

/// Converts the gradients of a node's variables.
ViscousGradient viscous_gradient(const Gas& gas, const State& state, const Gradient& gradient);

/// Returns the gradient between two nodes, `way` apart: the mean of both, with its component along the edge
/// replaced by the difference of the states. This sees node-to-node oscillations, which the mean does not.
ViscousGradient gradient_between(const Gas& gas, const State& low, const State& high,
                                 const ViscousGradient& at_low, const ViscousGradient& at_high, Point way);

/// Returns the viscous and heat flux through a face of length 1, to be subtracted from the physical flux
/// along the normal: the force of the stress (Stokes: no bulk viscosity), its work on the velocity of
/// `state`, and Fourier's heat flux.
Flux viscous_flux(const FlowModel& model, const State& state, const ViscousGradient& gradient, Point normal);

/// Returns the viscous flux through a boundary with the inner state `state`: all of it at inflow, outflow and
/// far field, only the normal stress at a symmetry plane, nothing at walls (where velocity and heat are
/// prescribed at the nodes).
Flux viscous_boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                           const ViscousGradient& gradient, Point normal);

/// Adds `factor` times the derivative of this flux with respect to the conserved variables at `state`, for a
/// gradient of 1 / length along the normal: the thin-layer part. `mean` is the state at the face.
void add_viscous_matrix(const FlowModel& model, const State& state, const State& mean, Point normal,
                        double factor, Matrix4& sum);

/// Returns the largest diffusivity of the conserved variables: times face over distance it is a speed times a
/// face.
double diffusivity(const FlowModel& model, const State& state);

}  // namespace quadloop::flow::euler
