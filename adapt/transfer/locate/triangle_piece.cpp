#include "adapt/transfer/locate/triangle_piece.hpp"

#include "mesher/base/ids.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::adapt {

namespace {

std::vector<std::vector<CellTriangle>> triangles_by_rank(const Communicator& comm,
                                                         const CurvePartition& shares, const Mesh& mesh,
                                                         std::span<const CellTriangle> triangles) {
  std::vector<std::vector<CellTriangle>> by_rank(comm.size());
  std::vector<int> ranks;
  for (const CellTriangle& triangle : triangles) {
    Box box;
    for (const NodeId node : triangle.nodes) box.include(mesh.point(node));
    shares.ranks_meeting(box, ranks);
    for (const int rank : ranks) by_rank[rank].push_back(triangle);
  }
  return by_rank;
}

/// Renumbers the nodes of some triangles in the order in which they appear; returns their old numbers.
std::vector<NodeId> renumber(std::vector<CellTriangle>& triangles, IdVector<NodeId, NodeId>& new_id_of) {
  std::vector<NodeId> nodes;
  for (CellTriangle& triangle : triangles) {
    for (NodeId& node : triangle.nodes) {
      NodeId& new_id = new_id_of[node];
      if (!new_id.valid()) {
        new_id = NodeId{size32(nodes)};
        nodes.push_back(node);
      }
      node = new_id;
    }
  }
  for (const NodeId node : nodes) new_id_of[node] = {};
  return nodes;
}

}  // namespace

TrianglePiece gather_piece(const Communicator& comm, const CurvePartition& shares, const Mesh& mesh,
                           const Field& field, std::span<const CellTriangle> triangles) {
  std::vector<CellTriangle> cells;
  std::vector<Point> points;
  std::vector<double> values;
  std::vector<int> cell_ranks, node_ranks;
  IdVector<NodeId, NodeId> new_id_of(mesh.points.size());
  int rank = 0;
  for (std::vector<CellTriangle>& of_rank : triangles_by_rank(comm, shares, mesh, triangles)) {
    for (const NodeId node : renumber(of_rank, new_id_of)) {
      points.push_back(mesh.point(node));
      const auto row = field.row(node);
      values.insert(values.end(), row.begin(), row.end());
    }
    cells.insert(cells.end(), of_rank.begin(), of_rank.end());
    cell_ranks.resize(cells.size(), rank);
    node_ranks.resize(points.size(), rank++);
  }
  const Exchange of_cells(comm, cell_ranks), of_nodes(comm, node_ranks);
  TrianglePiece piece{IdVector<NodeId, Point>(of_nodes.deliver(points)),
                      {field.names, of_nodes.deliver(values, field.width()), {}},
                      of_cells.deliver(cells)};
  for (const Exchange::Source& source : of_cells.sources()) {
    const auto before = static_cast<std::int32_t>(of_nodes.arrivals_before(source.rank));
    for (std::size_t i = source.begin; i < source.end; ++i) {
      for (NodeId& node : piece.triangles[i].nodes) node = NodeId{before + node.value()};
    }
  }
  return piece;
}

}  // namespace quadloop::adapt
