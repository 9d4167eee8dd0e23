#include "tests/flow/euler/vortex_error.hpp"

#include <cmath>

#include "flow/euler/vortex.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

double vortex_error(std::int32_t n, flow::EulerOptions::Limiter limiter, bool quads) {
  Mesh whole = irregular_grid(n, {10, 10}, 0.15, quads);
  relabel(whole, [](Point) { return "farfield"; });
  const Mesh mesh = scatter_mesh(world(), whole, space_filling_order(whole));
  flow::EulerOptions options;
  options.mach = 0.5;
  options.alpha = 30;
  options.time = flow::EulerOptions::Time::accurate;
  options.end_time = 2;
  options.limiter = limiter;
  options.initial = flow::EulerOptions::Initial::vortex;
  options.vortex_centre = Point{4.6, 4.7};
  const flow::EulerResult result = flow::solve_euler(world(), mesh, options);
  const flow::euler::Gas gas;
  const flow::euler::Vortex exact{gas, gas.free_stream(options.mach, options.alpha), *options.vortex_centre,
                                  1};
  std::vector<double> squares;
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const double error = result.flow.values[4 * node] - exact.state(mesh.point(NodeId{node}), result.time)[0];
    squares.push_back(error * error);
  }
  return std::sqrt(reproducible_sum(world(), squares) / ((n + 1) * (n + 1)));
}

}  // namespace quadloop::test
