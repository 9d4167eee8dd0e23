#include "mesher/mesh/topology.hpp"

#include <numeric>

namespace quadloop {

EdgeTable::EdgeTable(const Mesh& mesh)
    : starts_(mesh.points.size() + 2, 0), edges_(3 * mesh.triangles.size() + 4 * mesh.quads.size()) {
  for_each_cell_edge(mesh,
                     [&](NodeId from, NodeId, std::int32_t) { ++starts_[from.value() + std::size_t{2}]; });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    auto& next =
        starts_[from.value() + std::size_t{1}];  // shifted by one: becomes the end of the node's edges
    edges_[next++] = {to, cell};
  });
}

bool EdgeTable::repeats() const {
  for (std::size_t node = 0; node + 1 < starts_.size(); ++node) {
    const auto edges = std::span(edges_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
    for (auto edge = edges.begin(); edge != edges.end(); ++edge) {
      if (std::any_of(edges.begin(), edge, [&](const Edge& other) { return other.to == edge->to; }))
        return true;
    }
  }
  return false;
}

MeshTopology::MeshTopology(const Mesh& mesh, Kept kept) : table_{mesh} {
  if (kept == Kept::all) beyond_.reserve(3 * mesh.triangles.size() + 4 * mesh.quads.size());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t beyond = table_.cell_left_of(to, from);
    if (kept == Kept::all) beyond_.push_back(beyond);
    if (beyond < 0 && table_.cell_left_of(from, to) == cell) outer_edges_.push_back({from, to});
  });
}

}  // namespace quadloop
