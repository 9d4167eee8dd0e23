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
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.copies)
      .update_rows(rows.values, columns);
  return rows;
}

}  // namespace quadloop
