#include "mesher/mesh/check/surely_valid.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/point_table.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/require_sound.hpp"
#include "mesher/mesh/check/validate_rules.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop {

namespace {

/// A boundary edge, with the domain to its left.
struct OuterEdge {
  GlobalNodeId from, to;
  Point at_from, at_to;
};

std::vector<OuterEdge> outer_edges_of(const Mesh& mesh) {
  std::vector<OuterEdge> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      edges.push_back({mesh.global(from), mesh.global(to), mesh.point(from), mesh.point(to)});
  }
  return edges;
}

/// Whether every node belongs to a cell. *Collective.*
bool all_nodes_used(const Communicator& comm, const Mesh& mesh) {
  NodeFlags used(mesh.points.size(), 0);
  mesh.for_each_cell([&](const auto& nodes) { flag_all(nodes, used); });
  std::vector<GlobalNodeId> ghosts;
  for (std::size_t i = 0; i < mesh.ghosts.size(); ++i) {
    if (used[NodeId{mesh.owned_nodes + static_cast<std::int32_t>(i)}] != 0) ghosts.push_back(mesh.ghosts[i]);
  }
  flag_at_owners(comm, NodeOwners(comm, mesh.first_node), ghosts, used);
  const auto unused = std::count(used.begin(), used.begin() + mesh.owned_nodes, 0);
  return !comm.any(unused > 0);
}

bool all_boundaries_have_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<std::int64_t> own;
  for (std::int64_t number = 0; const BoundaryEdges& boundary : mesh.boundaries) {
    if (!boundary.edges.empty()) own.push_back(number);
    ++number;
  }
  std::vector<std::int64_t> all = comm.all_gather_values(std::span<const std::int64_t>(own));
  std::ranges::sort(all);
  return std::ranges::unique(all).begin() - all.begin() == std::ssize(mesh.boundaries);
}

/// Follows the loops of edges; returns the index of one edge of each. No result if a node has not exactly one
/// edge to the next.
std::optional<std::vector<std::size_t>> edge_of_each_loop(const std::vector<OuterEdge>& edges) {
  std::unordered_map<GlobalNodeId, std::size_t> edge_from;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edge_from.emplace(edges[i].from, i).second) return {};
  }
  std::vector<char> seen(edges.size(), 0);
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (seen[i] != 0) continue;
    first.push_back(i);
    for (std::size_t at = i; seen[at] == 0;) {
      seen[at] = 1;
      const auto next = edge_from.find(edges[at].to);
      if (next == edge_from.end()) return {};
      at = next->second;
    }
  }
  return first;
}

/// Whether the middle of an edge, as winding() counts it, is on the edge's left.
bool counts_as_left(const BoundarySegment& s, Point middle) {
  if (s.from.y == s.to.y) return s.to.x > s.from.x;
  const double side = orientation(s.from, s.to, middle);
  return s.to.y > s.from.y ? side > 0 : side >= 0;
}

/// Whether a whole boundary winds once around what is to its left, and not around what is to its right.
bool winds_once(const std::vector<OuterEdge>& edges) {
  const auto loops = edge_of_each_loop(edges);
  if (!loops) return false;
  std::vector<BoundarySegment> segments;
  std::vector<Point> points;
  for (const OuterEdge& edge : edges) {
    segments.push_back({edge.at_from, edge.at_to});
    points.push_back(edge.at_from);
  }
  if (PointTable(points).any_twice()) return false;
  Faults crossings;
  check_boundary_crossings(segments, crossings);
  if (!crossings.empty()) return false;
  return loops->size() >= most_components || std::ranges::all_of(*loops, [&](std::size_t i) {
           const BoundarySegment& s = segments[i];
           const Point middle = 0.5 * (s.from + s.to);
           return winding(segments, middle) == (counts_as_left(s, middle) ? 1 : 0);
         });
}

}  // namespace

bool is_surely_valid(const Communicator& comm, const Mesh& mesh) {
  const MeshCounts counts = count(comm, mesh);
  if (mesh.blocks.names.size() > 1 || counts.triangles + counts.quads == 0) return false;
  if (!all_nodes_used(comm, mesh) || !all_boundaries_have_edges(comm, mesh)) return false;
  if (!is_sound(comm, mesh)) return false;
  const std::vector<OuterEdge> edges = gather_at_root(comm, outer_edges_of(mesh));
  if (comm.any(comm.is_root() && !winds_once(edges))) return false;
  return std::ranges::none_of(
      mesh.pairs, [&](const PeriodicPair& pair) { return fault_of_pair(comm, mesh, pair).has_value(); });
}

}  // namespace quadloop
