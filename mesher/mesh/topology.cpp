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
        starts_[from.value() + std::size_t{1}];  // shifted by one: it moves to where the node's edges end
    edges_[next++] = {to, cell};
  });
}

}  // namespace quadloop
