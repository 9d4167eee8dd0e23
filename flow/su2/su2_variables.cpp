#include "flow/su2/su2_variables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesher/mesh/variable_names.hpp"

namespace quadloop::flow {

namespace {

using Four = std::array<std::size_t, 4>;

constexpr std::array<const char*, 4> conservative{"Density", "Momentum_x", "Momentum_y", "Energy"};
constexpr std::array<const char*, 5> added{"x_velocity", "y_velocity", "pressure", "mach", "total_pressure"};

std::optional<Four> conservative_columns(const std::vector<std::string>& names) {
  Four columns{};
  for (std::size_t k = 0; k < conservative.size(); ++k) {
    const std::vector<std::size_t> found = variables_like(names, conservative[k]);
    if (found.size() != 1) return std::nullopt;
    columns[k] = found.front();
  }
  return columns;
}

/// In the order of `added`.
std::array<double, 5> primitive(std::span<const double> row, const Four& at, double gamma) {
  const double density = row[at[0]], u = row[at[1]] / density, v = row[at[2]] / density;
  const double pressure = (gamma - 1) * (row[at[3]] - 0.5 * density * (u * u + v * v));
  const double squared_speed_of_sound = gamma * pressure / density;
  const double mach = squared_speed_of_sound > 0 ? std::sqrt((u * u + v * v) / squared_speed_of_sound) : 0;
  const double total_pressure = pressure * std::pow(1 + (gamma - 1) / 2 * mach * mach, gamma / (gamma - 1));
  return {u, v, pressure, mach, total_pressure};
}

std::span<const double> row_of(const Field& flow, std::size_t row) {
  return std::span(flow.values).subspan(row * flow.width(), flow.width());
}

}  // namespace

Field with_primitive_variables(Field flow, double gamma) {
  const auto columns = conservative_columns(flow.names);
  if (!columns) return flow;
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < added.size(); ++k) {
    if (variables_like(flow.names, added[k]).empty()) missing.push_back(k);
  }
  Field more{flow.names, {}, flow.constants};
  for (const std::size_t k : missing) more.names.emplace_back(added[k]);
  const std::size_t rows = flow.width() == 0 ? 0 : flow.values.size() / flow.width();
  more.values.reserve(rows * more.width());
  for (std::size_t i = 0; i < rows; ++i) {
    const std::span<const double> row = row_of(flow, i);
    more.values.insert(more.values.end(), row.begin(), row.end());
    const std::array<double, 5> values = primitive(row, *columns, gamma);
    for (const std::size_t k : missing) more.values.push_back(values[k]);
  }
  return more;
}

Field without_primitive_variables(const Field& flow) {
  if (!conservative_columns(flow.names)) return flow;
  std::vector<std::size_t> kept;
  Field less{{}, {}, flow.constants};
  for (std::size_t k = 0; k < flow.width(); ++k) {
    if (std::ranges::find(added, flow.names[k]) != added.end()) continue;
    kept.push_back(k);
    less.names.push_back(flow.names[k]);
  }
  const std::size_t rows = flow.width() == 0 ? 0 : flow.values.size() / flow.width();
  for (std::size_t i = 0; i < rows; ++i) {
    for (const std::size_t k : kept) less.values.push_back(row_of(flow, i)[k]);
  }
  return less;
}

}  // namespace quadloop::flow
