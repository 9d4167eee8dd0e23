#include "flow/euler/scheme/viscous.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"

namespace quadloop::flow::euler {

namespace {

Point mean_along(Point low, Point high, double change, Point way) {
  const Point mean = 0.5 * (low + high);
  return mean + (change - dot(mean, way)) / dot(way, way) * way;
}

/// Heat flux over the temperature gradient.
double conductivity(const FlowModel& model) {
  return model.viscosity / ((model.gas.gamma - 1) * model.prandtl);
}

}  // namespace

ViscousGradient viscous_gradient(const Gas& gas, const State& state, const Gradient& gradient) {
  const double per_density = gas.gamma / state[0], ratio = state[3] / state[0];
  const auto of_temperature = [&](const std::array<double, 4>& change) {
    return per_density * (change[3] - ratio * change[0]);
  };
  return {{gradient.x[1], gradient.y[1]},
          {gradient.x[2], gradient.y[2]},
          {of_temperature(gradient.x), of_temperature(gradient.y)}};
}

ViscousGradient gradient_between(const Gas& gas, const State& low, const State& high,
                                 const ViscousGradient& at_low, const ViscousGradient& at_high, Point way) {
  return {mean_along(at_low.x_velocity, at_high.x_velocity, high[1] - low[1], way),
          mean_along(at_low.y_velocity, at_high.y_velocity, high[2] - low[2], way),
          mean_along(at_low.temperature, at_high.temperature, temperature(gas, high) - temperature(gas, low),
                     way)};
}

Flux viscous_flux(const FlowModel& model, const State& state, const ViscousGradient& gradient, Point normal) {
  const Point &u = gradient.x_velocity, &v = gradient.y_velocity;
  const double third = (u.x + v.y) / 3, shear = u.y + v.x;
  const double x = model.viscosity * (2 * (u.x - third) * normal.x + shear * normal.y),
               y = model.viscosity * (shear * normal.x + 2 * (v.y - third) * normal.y);
  const double heat = conductivity(model) * dot(gradient.temperature, normal);
  return {0, x, y, state[1] * x + state[2] * y + heat};
}

Flux viscous_boundary_flux(const FlowModel& model, const BoundaryModel& boundary, const State& state,
                           const ViscousGradient& gradient, Point normal) {
  switch (boundary.condition) {
    case Condition::farfield:
    case Condition::inflow:
    case Condition::outflow: return viscous_flux(model, state, gradient, normal);
    case Condition::symmetry: {
      const Flux full = viscous_flux(model, state, gradient, normal);
      const double pull = full[1] * normal.x + full[2] * normal.y;
      return {0, pull * normal.x, pull * normal.y, 0};
    }
    case Condition::wall:
    case Condition::no_slip: return {};
    case Condition::none: break;
  }
  QUADLOOP_REQUIRE(false, "a boundary without edges has a face");
  return {};
}

void add_viscous_matrix(const FlowModel& model, const State& state, const State& mean, Point normal,
                        double factor, Matrix4& sum) {
  const auto& [rho, u, v, p] = state;
  const double per_density = factor * model.viscosity / rho, third = 1.0 / 3;
  const double xx = 1 + third * normal.x * normal.x, xy = third * normal.x * normal.y,
               yy = 1 + third * normal.y * normal.y;
  const double g = model.gas.gamma, square = u * u + v * v;
  const double heat = factor * conductivity(model) * g * (g - 1) / rho;
  const std::array<double, 4> x{-xx * u - xy * v, xx, xy, 0}, y{-xy * u - yy * v, xy, yy, 0},
      warmth{square - p / ((g - 1) * rho) - 0.5 * square, -u, -v, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    sum[4 + k] += per_density * x[k];
    sum[8 + k] += per_density * y[k];
    sum[12 + k] += per_density * (mean[1] * x[k] + mean[2] * y[k]) + heat * warmth[k];
  }
}

double diffusivity(const FlowModel& model, const State& state) {
  return std::max(4.0 / 3, model.gas.gamma / model.prandtl) * model.viscosity / state[0];
}

}  // namespace quadloop::flow::euler
