#include "flow/quantities/flow_quantities.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

std::optional<std::size_t> only_like(const Field& flow, const std::string& name) {
  const std::vector<std::size_t> found = variables_like(flow.names, name);
  if (found.size() != 1) return {};
  return found[0];
}

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names{mach_name, pressure_coefficient_name};
  return names;
}

FlowColumns::FlowColumns(const Field& flow, const std::string& where)
    : x_velocity_{variable(flow.names, "x_velocity", where)},
      y_velocity_{variable(flow.names, "y_velocity", where)},
      pressure_{variable(flow.names, "pressure", where)},
      density_{only_like(flow, "density")},
      shear_{only_like(flow, "wall_shear")} {}

double FlowColumns::mach(const Field& flow, NodeId node, double gamma) const {
  if (!density_) return 0;
  const auto row = flow.row(node);
  return std::hypot(row[x_velocity_], row[y_velocity_]) / std::sqrt(gamma * row[pressure_] / row[*density_]);
}

double pressure_coefficient(double pressure, const FreeStream& stream) {
  return stream.speed > 0 ? (pressure - stream.pressure) / stream.dynamic_pressure() : 0;
}

Field with_quantities(const Field& flow, const std::vector<std::string>& names, const FreeStream& stream) {
  if (names.empty()) return flow;
  const FlowColumns columns(flow, "the flow");
  std::vector<std::size_t> kept;
  Field all;
  for (std::size_t k = 0; k < flow.width(); ++k) {
    if (std::ranges::find(names, flow.names[k]) != names.end()) continue;
    kept.push_back(k);
    all.names.push_back(flow.names[k]);
  }
  all.names.insert(all.names.end(), names.begin(), names.end());
  all.constants = flow.constants;
  const auto rows = static_cast<std::int32_t>(flow.values.size() / flow.width());
  for (std::int32_t i = 0; i < rows; ++i) {
    const NodeId node{i};
    for (const std::size_t k : kept) all.values.push_back(flow.row(node)[k]);
    for (const std::string& name : names) {
      QUADLOOP_REQUIRE(name == mach_name || name == pressure_coefficient_name, "a quantity that is known");
      all.values.push_back(name == mach_name ? columns.mach(flow, node, stream.gamma)
                                             : pressure_coefficient(columns.pressure(flow, node), stream));
    }
  }
  return all;
}

}  // namespace quadloop
