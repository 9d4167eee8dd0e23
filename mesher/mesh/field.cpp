#include "mesher/mesh/field.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

std::vector<double> Field::column(std::size_t variable) const {
  QUADLOOP_REQUIRE(variable < width(), "a field has a column for each of its variables");
  std::vector<double> column;
  column.reserve(values.size() / width());
  for (std::size_t i = variable; i < values.size(); i += width()) column.push_back(values[i]);
  return column;
}

Field selected(const Field& field, std::span<const std::string> wanted, const std::string& where) {
  Field chosen;
  std::vector<std::size_t> columns;
  for (const std::string& name : wanted) {
    columns.push_back(variable(field.names, name, where));
    chosen.names.push_back(field.names[columns.back()]);
  }
  chosen.constants = field.constants;
  chosen.values.reserve(field.values.size() / std::max(field.width(), std::size_t{1}) * wanted.size());
  for (std::size_t row = 0; row < field.values.size(); row += field.width()) {
    for (const std::size_t column : columns) chosen.values.push_back(field.values[row + column]);
  }
  return chosen;
}

Field with_copies(const Communicator& comm, const Mesh& mesh, Field field) {
  const std::size_t width = field.width();
  QUADLOOP_REQUIRE(field.values.size() >= mesh.owned_nodes * width,
                   "a field must have a row for each owned node");
  field.values.resize(mesh.points.size() * width);
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.copies)
      .update_rows(field.values, width);
  return field;
}

}  // namespace quadloop
