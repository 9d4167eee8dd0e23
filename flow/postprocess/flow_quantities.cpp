#include "flow/postprocess/flow_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::flow {

namespace {

std::optional<std::size_t> only_like(const std::vector<std::string>& names, const std::string& name) {
  const std::vector<std::size_t> found = variables_like(names, name);
  if (found.size() != 1) return {};
  return found[0];
}

/// Appends the quantities to rows of values.
void append_quantities(std::vector<std::string>& variables, std::vector<double>& values,
                       const std::vector<std::string>& names, const FreeStream& stream) {
  const FlowColumns columns(variables, "the flow");
  std::vector<std::size_t> kept;
  std::vector<std::string> all_names;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (std::ranges::find(names, variables[k]) != names.end()) continue;
    kept.push_back(k);
    all_names.push_back(variables[k]);
  }
  all_names.insert(all_names.end(), names.begin(), names.end());
  std::vector<double> all;
  for (std::size_t at = 0; at < values.size(); at += variables.size()) {
    const auto row = std::span<const double>(values).subspan(at, variables.size());
    for (const std::size_t k : kept) all.push_back(row[k]);
    for (const std::string& name : names) {
      QUADLOOP_REQUIRE(name == mach_name || name == pressure_coefficient_name, "a quantity that is known",
                       name);
      all.push_back(name == mach_name ? columns.mach(row, stream.gamma)
                                      : pressure_coefficient(columns.pressure(row), stream));
    }
  }
  variables = std::move(all_names);
  values = std::move(all);
}

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names{mach_name, pressure_coefficient_name};
  return names;
}

FlowColumns::FlowColumns(const std::vector<std::string>& names, const std::string& where)
    : x_velocity_{variable(names, "x_velocity", where)},
      y_velocity_{variable(names, "y_velocity", where)},
      pressure_{variable(names, "pressure", where)},
      density_{only_like(names, "density")},
      shear_{only_like(names, "wall_shear")} {}

double FlowColumns::mach(std::span<const double> row, double gamma) const {
  if (!density_) return 0;
  const double squared = gamma * row[pressure_] / row[*density_];
  return squared > 0 ? std::hypot(row[x_velocity_], row[y_velocity_]) / std::sqrt(squared) : 0;
}

double pressure_coefficient(double pressure, const FreeStream& stream) {
  return stream.speed > 0 ? (pressure - stream.pressure) / stream.dynamic_pressure() : 0;
}

Field with_quantities(const Field& flow, const std::vector<std::string>& names, const FreeStream& stream) {
  Field all = flow;
  if (names.empty()) return all;
  if (flow.names.empty()) {
    append_quantities(all.cells.names, all.cells.values, names, stream);
  } else {
    append_quantities(all.names, all.values, names, stream);
  }
  return all;
}

}  // namespace quadloop::flow
