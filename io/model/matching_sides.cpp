#include "io/model/matching_sides.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::io {

namespace {

constexpr double matching = 1e-9;  // relative to the mesh's extent
constexpr int most_trials = 16;    // maximum number of similar sides tested per side

/// Returns the nodes of a boundary from end to end with the domain on the left; empty if it is closed or in
/// several parts.
std::vector<NodeId> chain_of(const BoundaryEdges& boundary) {
  auto edges = boundary.edges;
  std::ranges::sort(edges);
  std::vector<NodeId> ends;
  for (const auto& edge : edges) ends.push_back(edge[1]);
  std::ranges::sort(ends);
  const auto is_end = [&](NodeId node) { return std::ranges::binary_search(ends, node); };
  const auto first = std::ranges::find_if(edges, [&](const auto& edge) { return !is_end(edge[0]); });
  if (first == edges.end()) return {};
  std::vector<NodeId> chain{(*first)[0]};
  while (chain.size() <= edges.size()) {
    const auto next = std::ranges::lower_bound(edges, chain.back(), {}, [](const auto& e) { return e[0]; });
    if (next == edges.end() || (*next)[0] != chain.back()) break;
    chain.push_back((*next)[1]);
  }
  return chain.size() == edges.size() + 1 ? chain : std::vector<NodeId>{};
}

/// An open side, with quantities invariant under rigid motion.
struct OpenSide {
  std::vector<NodeId> nodes;
  double from_first = 0, from_last = 0;  ///< sums of the distances of all nodes from each end
};

/// Product of p and q as complex numbers.
Point product(Point p, Point q) { return {p.x * q.x - p.y * q.y, p.x * q.y + p.y * q.x}; }

/// Whether the rigid motion that maps the ends maps `one` to the reverse of `other`.
bool match(const Mesh& mesh, const OpenSide& one, const OpenSide& other, double enough) {
  const Point from = mesh.point(one.nodes.front()), to = mesh.point(other.nodes.back());
  const Point before = mesh.point(one.nodes.back()) - from, after = mesh.point(other.nodes.front()) - to;
  const Point turn = (1 / dot(before, before)) * product(after, {before.x, -before.y});
  const std::size_t count = one.nodes.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point image = to + product(turn, mesh.point(one.nodes[k]) - from);
    if (length(image - mesh.point(other.nodes[count - 1 - k])) > enough) return false;
  }
  return true;
}

std::vector<OpenSide> open_sides(const Mesh& mesh, double enough) {
  std::vector<OpenSide> sides;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    OpenSide side{chain_of(boundary)};
    if (side.nodes.empty()) continue;
    const Point first = mesh.point(side.nodes.front()), last = mesh.point(side.nodes.back());
    for (const NodeId node : side.nodes) {
      side.from_first += length(mesh.point(node) - first);
      side.from_last += length(mesh.point(node) - last);
    }
    if (length(last - first) > enough) sides.push_back(std::move(side));
  }
  std::ranges::sort(sides, {},
                    [](const OpenSide& side) { return std::tuple(side.nodes.size(), side.from_first); });
  return sides;
}

/// Returns the first of the sorted sides that `side` is the image of.
const OpenSide* partner_of(const OpenSide& side, const std::vector<OpenSide>& sides, const Mesh& mesh,
                           double enough) {
  const std::size_t count = side.nodes.size();
  const double off = enough * static_cast<double>(count);
  const auto key = [](const OpenSide& other) { return std::pair(other.nodes.size(), other.from_first); };
  auto other = std::ranges::lower_bound(sides, std::pair(count, side.from_last - off), {}, key);
  for (int trial = 0; trial < most_trials && other != sides.end(); ++trial, ++other) {
    if (key(*other) > std::pair(count, side.from_last + off)) return nullptr;
    if (&*other != &side && match(mesh, side, *other, enough)) return &*other;
  }
  return nullptr;
}

/// The box is that of all nodes.
std::vector<NodeId> matching_nodes(const Mesh& mesh, const Box& box) {
  const double enough = matching * std::max(box.width(), box.height());
  const std::vector<OpenSide> sides = open_sides(mesh, enough);
  std::vector<NodeId> nodes;
  for (const OpenSide& side : sides) {
    if (partner_of(side, sides, mesh, enough) != nullptr)
      nodes.insert(nodes.end(), side.nodes.begin(), side.nodes.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Box box_of(const Mesh& mesh) {
  Box box;
  for (const Point p : mesh.points) box.include(p);
  return box;
}

/// Returns the global numbers of all boundary nodes on the root, ascending. *Collective.*
std::vector<GlobalNodeId> boundary_nodes(const Communicator& comm, const Mesh& mesh) {
  std::vector<GlobalNodeId> nodes;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      nodes.insert(nodes.end(), {mesh.global(from), mesh.global(to)});
  }
  nodes = gather_at_root(comm, nodes);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

std::vector<NodeId> nodes_of_matching_sides(const Mesh& mesh) { return matching_nodes(mesh, box_of(mesh)); }

std::vector<NodeId> nodes_of_matching_sides(const Communicator& comm, const Mesh& mesh) {
  if (comm.size() == 1) return nodes_of_matching_sides(mesh);
  const Box box = box_over_ranks(comm, mesh.points);
  const Mesh boundaries = gather_boundaries(comm, mesh);
  const std::vector<GlobalNodeId> globals = boundary_nodes(comm, mesh);
  std::vector<GlobalNodeId> found;
  if (comm.is_root()) {
    for (const NodeId node : matching_nodes(boundaries, box)) found.push_back(globals[node.value()]);
  }
  comm.broadcast(found);
  std::vector<NodeId> nodes;
  for (const GlobalNodeId node : found) {
    if (const std::int64_t at = node.value() - mesh.first_node; at >= 0 && at < mesh.owned_nodes)
      nodes.emplace_back(static_cast<std::int32_t>(at));
  }
  return nodes;
}

}  // namespace quadloop::io
