#include "flow/su2/su2_history.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "flow/su2/su2_config.hpp"

namespace quadloop::flow {

namespace {

std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields;
  std::istringstream input(row);
  for (std::string field; std::getline(input, field, ',');) {
    const std::size_t first = field.find_first_not_of(" \t\r\""), last = field.find_last_not_of(" \t\r\"");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

/// A row's numbers by column name.
using Row = std::map<std::string, double>;

Row row_of(const std::vector<std::string>& names, const std::string& text) {
  Row row;
  const std::vector<std::string> fields = fields_of(text);
  if (fields.size() != names.size()) return row;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (const auto value = su2_number(fields[k])) row[names[k]] = *value;
  }
  return row;
}

std::optional<double> value_of(const Row& row, const std::string& name) {
  const auto found = row.find(name);
  return found == row.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

Su2End end_of_history(const std::string& text) {
  std::istringstream input(text);
  std::string line;
  std::getline(input, line);
  const std::vector<std::string> names = fields_of(line);
  Row first, last;
  while (std::getline(input, line)) {
    Row row = row_of(names, line);
    if (row.empty()) continue;
    if (first.empty()) first = row;
    last = std::move(row);
  }
  Su2End end{value_of(last, "CL"), value_of(last, "CD"), {}, {}, {}};
  for (const char* name : {"rms[P]", "rms[Rho]"}) {
    const auto before = value_of(first, name), now = value_of(last, name);
    if (!before || !now) continue;
    end.residual = std::pow(10.0, *now - *before);
    end.log_residual = now;
  }
  return end;
}

std::optional<bool> converged_by_log(const std::string& text) {
  if (text.find("All convergence criteria satisfied") != std::string::npos) return true;
  if (text.find("Maximum number of iterations reached") != std::string::npos) return false;
  return std::nullopt;
}

bool diverged_by_log(const std::string& text) {
  const auto has = [&](const char* words) { return text.find(words) != std::string::npos; };
  return has("SU2 has diverged") || has("linear solver diverged");
}

}  // namespace quadloop::flow
