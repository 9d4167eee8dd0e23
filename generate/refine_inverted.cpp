#include "generate/refine_inverted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "generate/leaf_quadrant.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

struct PlacedNode {
  GlobalNodeId node;
  Point place;
};

/// Appends the nodes of the cells that have a corner that does not turn left.
template <class Cells>
void append_inverted(const Mesh& mesh, const Cells& cells, std::vector<PlacedNode>& nodes) {
  for (const auto& cell : cells) {
    const std::size_t width = cell.size();
    bool sound = true;
    for (std::size_t k = 0; k < width; ++k) {
      sound = sound && orientation(mesh.point(cell[k]), mesh.point(cell[(k + 1) % width]),
                                   mesh.point(cell[(k + 2) % width])) > 0;
    }
    if (sound) continue;
    for (const NodeId node : cell) nodes.push_back({mesh.global(node), mesh.point(node)});
  }
}

/// The nodes of such cells on all ranks.
std::vector<PlacedNode> inverted_nodes(const Communicator& comm, const Mesh& mesh) {
  std::vector<PlacedNode> own;
  append_inverted(mesh, mesh.triangles, own);
  append_inverted(mesh, mesh.quads, own);
  return comm.all_gather_values(std::span<const PlacedNode>(own));
}

}  // namespace

bool refine_inverted(const Communicator& comm, const Geometry& geometry, const MeshResult& result,
                     DemandedSplits& splits) {
  if (!geometry.has_curves()) return false;
  const Mesh& mesh = result.mesh;
  std::set<GlobalNodeId> inverted;
  for (const PlacedNode& node : inverted_nodes(comm, mesh)) inverted.insert(node.node);
  if (inverted.empty()) return false;
  std::vector<SplitDemand> demands;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    const auto& edges = mesh.boundaries[b].edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool beside =
          std::ranges::any_of(edges[e], [&](NodeId node) { return inverted.contains(mesh.global(node)); });
      if (!beside) continue;
      const Quadrant cell = quadrant_of(result.tree.leaves[result.edge_leaves[b][e]]);
      demands.push_back({cell, 1U << cell.level});
    }
  }
  const std::int64_t count = comm.sum(std::ssize(demands));
  if (count == 0) return false;
  log::detail(fmt::format("cells at {} boundary edges are inverted; the mesh is made again", count));
  splits = DemandedSplits(comm, demands, splits);
  return true;
}

void require_not_inverted(const Communicator& comm, const Geometry& geometry, const Mesh& mesh) {
  if (!geometry.has_curves()) return;
  const std::vector<PlacedNode> nodes = inverted_nodes(comm, mesh);
  if (nodes.empty()) return;
  const Point place = std::ranges::min_element(nodes, {}, &PlacedNode::node)->place;
  throw InputError(fmt::format(
      "near ({:.6g}, {:.6g}): cells at a curve are thinner than the curve is off its chords; reduce "
      "spacing.min, move curves and points that nearly touch there apart, or increase "
      "smooth.sweeps",
      place.x, place.y));
}

}  // namespace quadloop
