#include "flow/euler/in_time/time_scheme.hpp"

#include "flow/euler/in_time/backward_difference.hpp"
#include "flow/euler/in_time/runge_kutta.hpp"

namespace quadloop::flow::euler {

std::unique_ptr<TimeScheme> time_scheme(FlowRun& run, std::optional<double> step, double cfl) {
  if (step) return std::make_unique<BackwardDifference>(run, *step);
  return std::make_unique<RungeKutta>(run, cfl);
}

}  // namespace quadloop::flow::euler
