#include "mesher/mesh/layers/layered_edges.hpp"

#include <cmath>
#include <span>
#include <unordered_map>

#include "mesher/mesh/part_names.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t none = -1;

/// A boundary edge, shared by all ranks.
struct OutlineEdge {
  GlobalNodeId from, to;
  Point begin, end;
  std::int32_t layers = none;  ///< boundary whose layers are on it
  bool is_cut = false;         ///< between partitions of a mesh: layers do not continue along it
};

Point direction(const OutlineEdge& e) {
  const Point along = e.end - e.begin;
  return (1 / length(along)) * along;
}

/// Whether layers on `before` end where `after` begins; with `backwards` the edges are traversed in reverse.
/// At 45 degrees rounding decided how the layers were made; an edge of a column is then recognised by its
/// length.
bool end_between(const OutlineEdge& before, const OutlineEdge& after, bool backwards) {
  constexpr double cosine_of_45 = 0.70710678118654757, rounding = 1e-9, half = 0.5;
  const Point a = direction(before), b = direction(after);
  const double cosine = std::abs(dot(a, b));
  if (cross(a, b) <= 0) return false;
  if (std::abs(cosine - cosine_of_45) > rounding) return cosine < cosine_of_45;
  const double first = length(before.end - before.begin), second = length(after.end - after.begin);
  return backwards ? first < half * second : second < half * first;
}

std::vector<OutlineEdge> own_edges(const Mesh& mesh) {
  std::vector<OutlineEdge> edges;
  for (std::int32_t b = 0; b < size32(mesh.boundaries); ++b) {
    const BoundaryEdges& boundary = mesh.boundaries[b];
    const bool is_cut = is_part_name(boundary.name);
    for (const auto& [from, to] : boundary.edges) {
      edges.push_back({mesh.global(from), mesh.global(to), mesh.point(from), mesh.point(to),
                       boundary.layers.count > 0 ? b : none, is_cut});
    }
  }
  return edges;
}

/// Continues the layers along the boundary, in one direction.
void extend(std::vector<OutlineEdge>& edges, bool backwards) {
  std::unordered_map<GlobalNodeId, std::size_t> edge_at;
  for (std::size_t e = 0; e < edges.size(); ++e) edge_at.emplace(backwards ? edges[e].to : edges[e].from, e);
  std::vector<std::size_t> ends;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].layers != none) ends.push_back(e);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const OutlineEdge& wall = edges[ends[k]];
    const auto next = edge_at.find(backwards ? wall.from : wall.to);
    if (next == edge_at.end()) continue;
    OutlineEdge& beyond = edges[next->second];
    if (beyond.layers != none || beyond.is_cut) continue;
    if (backwards ? end_between(beyond, wall, true) : end_between(wall, beyond, false)) continue;
    beyond.layers = wall.layers;
    ends.push_back(next->second);
  }
}

}  // namespace

std::vector<LayeredEdge> layered_edges(const Communicator& comm, const Mesh& mesh) {
  const std::vector<OutlineEdge> own = own_edges(mesh);
  const std::int64_t first = comm.exclusive_sum(std::ssize(own));
  std::vector<OutlineEdge> edges = comm.all_gather_values(std::span<const OutlineEdge>(own));
  extend(edges, false);
  extend(edges, true);
  std::vector<LayeredEdge> result;
  auto edge = edges.cbegin() + first;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& nodes : boundary.edges) {
      if (edge->layers != none) result.push_back({nodes, edge->layers});
      ++edge;
    }
  }
  return result;
}

}  // namespace quadloop
