#include "io/su2/su2_restart_table.hpp"

#include <algorithm>

#include "io/text/text_scanner.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

constexpr std::array<const char*, 4> conservative{"Density", "Momentum_x", "Momentum_y", "Energy"};
constexpr std::array<const char*, 4> primitive{"density", "x_velocity", "y_velocity", "pressure"};

/// Whether these are the variables of SU2's incompressible solvers, which restart from them in this order.
bool is_incompressible(std::span<const std::string> variables) {
  constexpr std::array<const char*, 3> first{"Pressure", "Velocity_x", "Velocity_y"};
  return variables.size() >= first.size() && std::equal(first.begin(), first.end(), variables.begin());
}

/// Returns a name that is read back as a variable: no comma or quote, no number, no coordinate.
std::string column_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ',' || c == '"'; }, '_');
  double number = 0;
  if (name.empty() || parse_real(name, number)) name = "v" + name;
  std::string key = name;
  std::transform(key.begin(), key.end(), key.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return key == "x" || key == "y" || key == "z" || key == "pointid" ? name + "_" : name;
}

}  // namespace

Su2RestartTable::Su2RestartTable(std::span<const std::string> variables, double gamma) : gamma_{gamma} {
  const auto of_su2 = columns_of(variables, conservative);
  if (!of_su2 && !is_incompressible(variables)) made_from_ = columns_of(variables, primitive);
  Columns used{};
  if (of_su2 || made_from_) {
    used = of_su2 ? *of_su2 : *made_from_;
    names_.assign(conservative.begin(), conservative.end());
  }
  if (of_su2) as_they_are_.assign(used.begin(), used.end());
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (!names_.empty() && std::find(used.begin(), used.end(), k) != used.end()) continue;
    as_they_are_.push_back(k);
  }
  for (std::size_t i = of_su2 ? 4 : 0; i < as_they_are_.size(); ++i)
    names_.push_back(distinct(column_name(variables[as_they_are_[i]])));
}

/// Returns the columns of the wanted variables; empty unless each occurs exactly once.
std::optional<Su2RestartTable::Columns> Su2RestartTable::columns_of(
    std::span<const std::string> names, const std::array<const char*, 4>& wanted) {
  Columns columns{};
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::vector<std::size_t> found = variables_like(names, wanted[k]);
    if (found.size() != 1) return {};
    columns[k] = found.front();
  }
  return columns;
}

std::string Su2RestartTable::distinct(std::string name) const {
  while (std::find(names_.begin(), names_.end(), name) != names_.end()) name += "_";
  return name;
}

std::array<double, 4> Su2RestartTable::conserved(std::span<const double> row) const {
  const Columns& at = *made_from_;
  const double density = row[at[0]], u = row[at[1]], v = row[at[2]], pressure = row[at[3]];
  return {density, density * u, density * v, pressure / (gamma_ - 1) + 0.5 * density * (u * u + v * v)};
}

}  // namespace quadloop::io
