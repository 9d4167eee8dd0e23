#include "mesher/mesh/field.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

std::vector<double> column_of(const std::vector<double>& rows, std::size_t width, std::size_t variable) {
  QUADLOOP_REQUIRE(variable < width, "a field has a column for each of its variables", variable, width);
  std::vector<double> column;
  column.reserve(rows.size() / width);
  for (std::size_t i = variable; i < rows.size(); i += width) column.push_back(rows[i]);
  return column;
}

std::vector<double> columns_of(const std::vector<double>& rows, std::size_t width,
                               std::span<const std::size_t> columns) {
  std::vector<double> chosen;
  if (columns.empty()) return chosen;
  chosen.reserve(rows.size() / width * columns.size());
  for (std::size_t row = 0; row < rows.size(); row += width) {
    for (const std::size_t column : columns) chosen.push_back(rows[row + column]);
  }
  return chosen;
}

/// Returns an index into the names of nodal variables, followed by those of cell variables.
std::size_t variable_of(const Field& field, const std::string& wanted, const std::string& where) {
  if (!variables_like(field.names, wanted).empty()) return variable(field.names, wanted, where);
  if (!variables_like(field.cells.names, wanted).empty())
    return field.width() + variable(field.cells.names, wanted, where);
  std::vector<std::string> all = field.names;
  all.insert(all.end(), field.cells.names.begin(), field.cells.names.end());
  return variable(all, wanted, where);  // throws, with a list of them
}

}  // namespace

std::vector<double> Field::column(std::size_t variable) const { return column_of(values, width(), variable); }

std::vector<double> CellValues::column(std::size_t variable) const {
  return column_of(values, width(), variable);
}

Field selected(const Field& field, std::span<const std::string> wanted, const std::string& where) {
  Field chosen;
  std::vector<std::size_t> at_nodes, in_cells;
  for (const std::string& name : wanted) {
    const std::size_t found = variable_of(field, name, where);
    const bool is_nodal = found < field.width();
    (is_nodal ? at_nodes : in_cells).push_back(is_nodal ? found : found - field.width());
    (is_nodal ? chosen.names : chosen.cells.names)
        .push_back(is_nodal ? field.names[found] : field.cells.names[found - field.width()]);
  }
  chosen.constants = field.constants;
  chosen.values = columns_of(field.values, field.width(), at_nodes);
  chosen.cells.values = columns_of(field.cells.values, field.cells.width(), in_cells);
  return chosen;
}

void append_columns(Field& field, std::span<const std::string> names, std::span<const double> values) {
  const std::size_t before = field.width(), more = names.size(), rows = values.size() / more;
  std::vector<double> all;
  all.reserve(rows * (before + more));
  for (std::size_t row = 0; row < rows; ++row) {
    all.insert(all.end(), field.values.begin() + row * before, field.values.begin() + (row + 1) * before);
    all.insert(all.end(), values.begin() + row * more, values.begin() + (row + 1) * more);
  }
  field.names.insert(field.names.end(), names.begin(), names.end());
  field.values = std::move(all);
}

Field with_ghosts(const Communicator& comm, const Mesh& mesh, Field field) {
  const std::size_t width = field.width();
  QUADLOOP_REQUIRE(field.values.size() >= mesh.owned_nodes * width,
                   "a field must have a row for each owned node");
  field.values.resize(mesh.points.size() * width);
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts)
      .update_rows(field.values, width);
  return field;
}

}  // namespace quadloop
