#include "adapt/transfer/node_rows.hpp"

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

NodeRows rows_with_copies(const Communicator& comm, const Mesh& mesh, std::span<const double> owned,
                          int width) {
  const auto columns = static_cast<std::size_t>(width);
  QUADLOOP_REQUIRE(width >= 0 && owned.size() == static_cast<std::size_t>(mesh.owned_nodes) * columns,
                   "values must hold a row for each owned node");
  NodeRows rows{width, {owned.begin(), owned.end()}};
  rows.values.resize(mesh.points.size() * columns);
  if (comm.size() == 1) return rows;
  const NodeExchange exchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.copies);
  std::vector<double> column(mesh.points.size());
  for (std::size_t k = 0; k < columns; ++k) {
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = rows.values[i * columns + k];
    exchange.update(column);
    for (std::size_t i = 0; i < column.size(); ++i) rows.values[i * columns + k] = column[i];
  }
  return rows;
}

}  // namespace quadloop
