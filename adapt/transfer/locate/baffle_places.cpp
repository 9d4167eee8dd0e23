#include "adapt/transfer/locate/baffle_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop::adapt {

namespace {

using BaffleEdge = Baffles::Edge;

std::tuple<Point, Point, GlobalNodeId, GlobalNodeId> order_of(const BaffleEdge& e) {
  return {e.from, e.to, e.from_node, e.to_node};
}

/// All ranks' boundary edges, sorted.
std::vector<BaffleEdge> sorted_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<BaffleEdge> own;
  std::int32_t index = -1;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      ++index;
      if (!boundary.two_sided())
        own.push_back(
            {mesh.point(from), mesh.point(to), mesh.global(from), mesh.global(to), comm.rank(), index});
    }
  }
  std::vector<BaffleEdge> all = comm.all_gather_values(std::span<const BaffleEdge>(own));
  std::ranges::sort(all, {}, order_of);
  return all;
}

/// The edges that start or end at each node, ascending.
std::vector<std::pair<GlobalNodeId, std::int32_t>> by_node(const std::vector<BaffleEdge>& edges,
                                                           GlobalNodeId BaffleEdge::*node) {
  std::vector<std::pair<GlobalNodeId, std::int32_t>> found;
  for (std::int32_t e = 0; e < size32(edges); ++e) found.emplace_back(edges[e].*node, e);
  std::ranges::sort(found);
  return found;
}

const BaffleEdge* first_at(const std::vector<std::pair<GlobalNodeId, std::int32_t>>& edges_of_nodes,
                           const std::vector<BaffleEdge>& edges, GlobalNodeId node) {
  const auto at = std::ranges::lower_bound(edges_of_nodes, std::pair(node, std::int32_t{0}));
  return at != edges_of_nodes.end() && at->first == node ? &edges[at->second] : nullptr;
}

BoundaryPlace place_on(const BaffleEdge& edge, Point p) {
  return {edge.rank, edge.index, place_on_segment(p, edge.from, edge.to).parameter};
}

/// The sine of the angle at the nearer end of the edge by which the point is to the left of it.
double share_of_left(const BaffleEdge& edge, Point p) {
  const bool from_is_nearer = length(p - edge.from) <= length(p - edge.to);
  const Point to_p = p - (from_is_nearer ? edge.from : edge.to);
  const double distance = length(to_p);
  return distance > 0 ? cross(edge.direction(), to_p) / distance : 0;
}

}  // namespace

Baffles::Baffles(const Communicator& comm, const Mesh& mesh) {
  const std::vector<BaffleEdge> all = sorted_edges(comm, mesh);
  for (const BaffleEdge& edge : all) {
    const auto ends = [](const BaffleEdge& e) { return std::pair(e.from, e.to); };
    const auto twin = std::ranges::lower_bound(all, std::pair(edge.to, edge.from), {}, ends);
    if (twin == all.end() || ends(*twin) != std::pair(edge.to, edge.from)) continue;
    edges_.push_back(edge);
    edges_.back().tip_at_from = twin->to_node == edge.from_node;
    edges_.back().tip_at_to = twin->from_node == edge.to_node;
  }
  tree_ = BoxTree(size32(edges_), [&](std::int32_t e) { return box_of(edges_[e].from, edges_[e].to); });
}

template <class Share>
const Baffles::Edge* Baffles::nearest(Point p, const Share& share) const {
  constexpr double rounding = 1e-10;  // in lengths of the edge
  const auto distance = [&](std::int32_t e) {
    return place_on_segment(p, edges_[e].from, edges_[e].to).squared_distance;
  };
  const std::int32_t one = tree_.nearest(p, distance);
  if (one == BoxTree::none) return nullptr;
  const double reach = std::sqrt(distance(one)) + rounding * length(edges_[one].to - edges_[one].from);
  std::vector<std::int32_t> near;
  tree_.for_each_meeting({{p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}}, [&](std::int32_t e) {
    if (distance(e) <= reach * reach) near.push_back(e);
  });
  std::ranges::sort(near);
  const BaffleEdge* best = nullptr;
  double largest = 0;
  for (const std::int32_t e : near) {
    const double of_edge = share(edges_[e]);
    if (of_edge > largest) {
      largest = of_edge;
      best = &edges_[e];
    }
  }
  return best;
}

BafflePlaces::BafflePlaces(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh)
    : old_(comm, old_mesh),
      new_(comm, new_mesh),
      starts_{by_node(new_.edges(), &BaffleEdge::from_node)},
      ends_{by_node(new_.edges(), &BaffleEdge::to_node)} {}

const BaffleEdge* BafflePlaces::old_edge_along(const BaffleEdge& edge, Point at) const {
  const Point direction = edge.direction();
  return old_.nearest(at, [&](const BaffleEdge& old) { return dot(direction, old.direction()); });
}

std::optional<BoundaryPlace> BafflePlaces::of_node(GlobalNodeId node) const {
  if (none()) return std::nullopt;
  const BaffleEdge* out = first_at(starts_, new_.edges(), node);
  const BaffleEdge* in = first_at(ends_, new_.edges(), node);
  if (out == nullptr && in == nullptr) return std::nullopt;
  // Where baffles meet, the edges of several sides are equally near; those of the same side begin or end
  // here.
  const BaffleEdge& edge = out != nullptr ? *out : *in;
  const Point at = out != nullptr ? edge.from : edge.to, direction = edge.direction();
  const BaffleEdge* old = old_.nearest(at, [&](const BaffleEdge& one) {
    const bool same_end = (out != nullptr ? one.from : one.to) == at;
    return dot(direction, one.direction()) + (same_end ? 2 : 0);
  });
  if (old == nullptr) return std::nullopt;
  return place_on(*old, at);
}

std::optional<BoundaryPlace> BafflePlaces::across(Point p) const {
  if (none()) return std::nullopt;
  const BaffleEdge* here = new_.nearest(p, [&](const BaffleEdge& edge) { return share_of_left(edge, p); });
  if (here == nullptr) return std::nullopt;
  const double parameter = place_on_segment(p, here->from, here->to).parameter;
  if ((parameter == 0 && here->tip_at_from) || (parameter == 1 && here->tip_at_to)) return std::nullopt;
  const BaffleEdge* old = old_edge_along(*here, here->from + parameter * (here->to - here->from));
  if (old == nullptr || orientation(old->from, old->to, p) > 0) return std::nullopt;
  // Beyond that, the baffle is another one.
  constexpr double reach = 0.5;
  const PlaceOnSegment place = place_on_segment(p, old->from, old->to);
  if (std::sqrt(place.squared_distance) > reach * length(old->to - old->from)) return std::nullopt;
  return place_on(*old, p);
}

}  // namespace quadloop::adapt
