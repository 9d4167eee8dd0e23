#include "generate/free_baffles.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "generate/split_edges.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

/// An edge of one side of a baffle.
struct BaffleEdge {
  GlobalNodeId from, to;
  std::int32_t boundary = 0;
  Point middle;
  std::pair<GlobalNodeId, GlobalNodeId> nodes() const { return std::minmax(from, to); }
};

/// The edges of baffles on all ranks, those with the same nodes next to each other. *Collective.*
std::vector<BaffleEdge> edges_of_baffles(const Communicator& comm, const Geometry& geometry,
                                         const Mesh& mesh) {
  std::vector<BaffleEdge> own;
  for (std::int32_t b = 0; b < size32(mesh.boundaries); ++b) {
    if (!geometry.boundaries()[b].baffle) continue;
    for (const auto& [from, to] : mesh.boundaries[b].edges)
      own.push_back({mesh.global(from), mesh.global(to), b, 0.5 * (mesh.point(from) + mesh.point(to))});
  }
  std::vector<BaffleEdge> all = comm.all_gather_values(std::span<const BaffleEdge>(own));
  std::ranges::sort(all, {}, [](const BaffleEdge& e) { return std::pair(e.nodes(), e.boundary); });
  return all;
}

/// The point of a boundary's chords that is nearest to a point.
Point nearest_on_boundary(const Geometry& geometry, std::int32_t boundary, Point p) {
  Point nearest = p;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (geometry.boundary_of(s).value() != boundary) continue;
    const Point a = geometry.point(s), b = geometry.point(geometry.next(s));
    const double distance = distance_to_segment(p, a, b);
    if (distance >= least) continue;
    least = distance;
    nearest = nearest_on_segment(p, a, b);
  }
  return nearest;
}

}  // namespace

NodeFlags divide_free_baffles(const Communicator& comm, const Geometry& geometry, MeshResult& result) {
  if (std::ranges::none_of(geometry.boundaries(), &Boundary::baffle)) return {};
  const std::vector<BaffleEdge> edges = edges_of_baffles(comm, geometry, result.mesh);
  std::vector<EdgeSplit> splits;
  std::set<Point> places;
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    if (edges[e].nodes() != edges[e + 1].nodes()) continue;
    const Point place = nearest_on_boundary(geometry, edges[e].boundary, edges[e].middle);
    for (const BaffleEdge& side : {edges[e], edges[e + 1]}) splits.push_back({side.from, side.to, {place}});
    places.insert(place);
  }
  if (splits.empty()) return {};
  split_edges(comm, std::move(splits), result);
  NodeFlags added(result.mesh.points.size(), 0);
  for (const NodeId node : added.ids()) added[node] = places.contains(result.mesh.point(node)) ? 1 : 0;
  return added;
}

}  // namespace quadloop
