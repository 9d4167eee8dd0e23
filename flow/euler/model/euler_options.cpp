#include "flow/euler/model/euler_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop::flow {

namespace {

void require_option(bool good, const char* name, double value, const char* wanted) {
  if (good && std::isfinite(value)) return;
  throw InputError(fmt::format("the flow solver's {} is {}, but must be {}{}", name, value,
                               std::isfinite(value) ? "" : "finite, ", wanted));
}

}  // namespace

void validate(const EulerOptions& options) {
  require_option(options.mach >= 0, "mach", options.mach, "0 or more");
  require_option(true, "alpha", options.alpha, "a number of degrees");
  require_option(options.gamma > 1, "gamma", options.gamma, "above 1");
  require_option(options.viscosity >= 0, "viscosity", options.viscosity, "0 or more");
  require_option(options.prandtl > 0, "prandtl", options.prandtl, "above 0");
  require_option(options.end_time >= 0, "end_time", options.end_time, "0 or more");
  if (options.time_step) require_option(*options.time_step > 0, "time_step", *options.time_step, "above 0");
  if (options.average_from) {
    require_option(*options.average_from >= 0 && *options.average_from < options.end_time, "average_from",
                   *options.average_from, "0 or more and below end_time");
  }
  require_option(options.flow_throughs > 0, "flow_throughs", options.flow_throughs, "above 0");
  if (options.unsteady == EulerOptions::Unsteady::continue_in_time)
    require_option(options.mach > 0, "mach", options.mach, "above 0 for a flow that is continued in time");
  require_option(options.cfl > 0, "cfl", options.cfl, "above 0");
  require_option(options.iterations >= 0, "iterations", options.iterations, "0 or more");
  require_option(options.tolerance >= 0, "tolerance", options.tolerance, "0 or more");
  require_option(options.reference_length > 0, "reference_length", options.reference_length, "above 0");
  require_option(options.progress_every > 0, "progress_every", options.progress_every, "above 0");
  for (const BoundaryChoice& choice : options.boundaries) {
    if (choice.pressure)
      require_option(*choice.pressure > 0, ("pressure at '" + choice.name + "'").c_str(), *choice.pressure,
                     "above 0");
    if (choice.temperature)
      require_option(*choice.temperature > 0, ("wall_temperature at '" + choice.name + "'").c_str(),
                     *choice.temperature, "above 0");
  }
}

}  // namespace quadloop::flow
