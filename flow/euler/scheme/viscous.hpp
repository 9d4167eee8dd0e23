#pragma once

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::euler {

/// How velocity and temperature change along x and y. The temperature is gamma pressure / density: 1 in the
/// free stream.
struct ViscousGradient {
  Point x_velocity, y_velocity, temperature;
};

inline double temperature(const Gas& gas, const State& state) { return gas.gamma * state[3] / state[0]; }

/// From the gradients of a node's variables.
ViscousGradient viscous_gradient(const Gas& gas, const State& state, const Gradient& gradient);

/// Between two nodes, `way` apart: the mean of theirs, the part along the way replaced by the difference of
/// the states. It sees what varies from node to node, which the mean does not.
ViscousGradient gradient_between(const Gas& gas, const State& low, const State& high,
                                 const ViscousGradient& at_low, const ViscousGradient& at_high, Point way);

/// What viscosity and heat conduction carry against a unit normal through a face of length 1, so that the
/// flux along it is the physical one less this: the stress's force (Stokes: no bulk viscosity), its work on
/// the velocity of `state`, and Fourier's heat.
Flux viscous_flux(const FlowModel& model, const State& state, const ViscousGradient& gradient, Point normal);

/// The same through a boundary, the flow inside being `state`: through one that lets the flow out or in all,
/// at a plane of symmetry the stress along the normal alone, at walls nothing (their nodes' velocity is held,
/// and their heat as the wall wants it).
Flux viscous_boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                           const ViscousGradient& gradient, Point normal);

/// Adds `factor` times how that flux answers to the conserved variables at `state` where they alone vary, by
/// 1 / length along the normal: the thin-layer part. `mean` is the state on the face.
void add_viscous_matrix(const FlowModel& model, const State& state, const State& mean, Point normal,
                        double factor, Matrix4& sum);

/// The largest diffusivity of what is conserved: times face over distance it is a speed times a face.
double diffusivity(const FlowModel& model, const State& state);

}  // namespace quadloop::euler
