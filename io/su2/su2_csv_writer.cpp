#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "io/su2/su2_csv_file.hpp"
#include "io/text/text_output.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

using Columns = std::array<std::size_t, 4>;

constexpr std::array<const char*, 4> conservative{"Density", "Momentum_x", "Momentum_y", "Energy"};
constexpr std::array<const char*, 4> primitive{"density", "x_velocity", "y_velocity", "pressure"};

/// Where each of the wanted variables stands; nothing unless all are there, each once.
std::optional<Columns> columns_of(std::span<const std::string> names,
                                  const std::array<const char*, 4>& wanted) {
  Columns columns{};
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::vector<std::size_t> found = variables_like(names, wanted[k]);
    if (found.size() != 1) return {};
    columns[k] = found.front();
  }
  return columns;
}

/// A name that is read back as that of a variable: no comma or quote, no number, no coordinate.
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

/// Which columns a solution makes: SU2's four conservative variables in front where it has them or what they
/// follow from, then all others as they are.
struct CsvTable {
  /// Density, velocity and pressure, of which the first four columns are computed.
  std::optional<Columns> made_from;
  std::vector<std::size_t> as_they_are;
  std::vector<std::string> names;

  explicit CsvTable(std::span<const std::string> variables) {
    const auto of_su2 = columns_of(variables, conservative);
    if (!of_su2) made_from = columns_of(variables, primitive);
    Columns used{};
    if (of_su2 || made_from) {
      used = of_su2 ? *of_su2 : *made_from;
      names.assign(conservative.begin(), conservative.end());
    }
    if (of_su2) as_they_are.assign(used.begin(), used.end());
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (!names.empty() && std::find(used.begin(), used.end(), k) != used.end()) continue;
      as_they_are.push_back(k);
    }
    for (std::size_t i = of_su2 ? 4 : 0; i < as_they_are.size(); ++i)
      names.push_back(distinct(column_name(variables[as_they_are[i]])));
  }

 private:
  std::string distinct(std::string name) const {
    while (std::find(names.begin(), names.end(), name) != names.end()) name += "_";
    return name;
  }
};

std::array<double, 4> conserved(const double* row, const Columns& at, double gamma) {
  const double density = row[at[0]], u = row[at[1]], v = row[at[2]], pressure = row[at[3]];
  return {density, density * u, density * v, pressure / (gamma - 1) + 0.5 * density * (u * u + v * v)};
}

}  // namespace

void write_su2_csv(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma) {
  const CsvTable table(solution.names);
  std::string header = R"("PointID","x","y")";
  for (const std::string& name : table.names) header.append(",\"").append(name).append("\"");
  TextOutput file(outputs, path);
  file.write(header + "\n");
  const std::size_t width = solution.names.size();
  file.write_rows(mesh.owned_nodes, 3 + table.names.size(), [&](TextRows& text, std::int64_t i) {
    const double* row = solution.values.data() + i * width;
    text.put(mesh.first_node + i, ',');
    text.put(mesh.points[i].x, ',');
    text.put(mesh.points[i].y, table.names.empty() ? '\n' : ',');
    std::size_t left = table.names.size();
    const auto put = [&](double value) { text.put(value, --left == 0 ? '\n' : ','); };
    if (table.made_from) {
      for (const double value : conserved(row, *table.made_from, gamma)) put(value);
    }
    for (const std::size_t column : table.as_they_are) put(row[column]);
  });
  file.close();
}

}  // namespace quadloop
