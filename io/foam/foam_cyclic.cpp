#include "io/foam/foam_cyclic.hpp"

#include <algorithm>

#include "mesher/mesh/node_table.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::io {

namespace {

/// Replaces the edges of a boundary by those along a line, in the order of its nodes or each the other way.
void replace_edges(const Communicator& comm, const BoundaryLine& line, bool backwards, NodeTable& table,
                   BoundaryEdges& boundary) {
  boundary.edges.clear();
  if (!comm.is_root()) return;
  for (std::size_t i = 1; i < line.nodes.size(); ++i) {
    std::array<NodeId, 2> edge{table.local(line.nodes[i - 1], line.points[i - 1]),
                               table.local(line.nodes[i], line.points[i])};
    if (backwards) std::swap(edge[0], edge[1]);
    boundary.edges.push_back(edge);
  }
}

}  // namespace

void order_edges_of_pairs(const Communicator& comm, Mesh& mesh) {
  if (mesh.pairs.empty()) return;
  NodeTable table(mesh);
  for (const PeriodicPair& pair : mesh.pairs) {
    const PairedNodes nodes = paired_nodes(comm, mesh, pair);
    for (BoundaryEdges& boundary : mesh.boundaries) {
      if (boundary.name == pair.from) replace_edges(comm, nodes.from, false, table, boundary);
      if (boundary.name == pair.to) replace_edges(comm, nodes.to, true, table, boundary);
    }
  }
}

}  // namespace quadloop::io
