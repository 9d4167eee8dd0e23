#include "mesher/layers/front_places.hpp"

#include <array>
#include <limits>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

FrontPlaces::FrontPlaces(const LayerFront& front)
    : front_{&front}, of_boundary_(front.outer.boundaries().size()) {
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    if (front.station_of[s] != WallLine::none) of_boundary_[front.outer.boundary_of(s)].segments.push_back(s);
  }
  for (const BoundaryId b : of_boundary_.ids()) {
    std::vector<Box> boxes;
    for (const std::int32_t s : of_boundary_[b].segments)
      boxes.push_back(box_of(front.outer.point(s), front.outer.point(front.outer.next(s))));
    of_boundary_[b].tree = BoxTree(boxes);
  }
}

FrontPlace FrontPlaces::locate(Point node, BoundaryId boundary) const {
  const Geometry& outer = front_->outer;
  const auto& [segments, tree] = of_boundary_[boundary];
  const std::int32_t nearest = tree.nearest(node, [&](std::int32_t k) {
    const std::int32_t s = segments[k];
    return place_on_segment(node, outer.point(s), outer.point(outer.next(s))).squared_distance;
  });
  if (nearest == BoxTree::none) return {};
  const std::int32_t i = front_->station_of[segments[nearest]], j = front_->line.next(i);
  const Point from = front_->points[i], to = front_->points[j];
  const double share = place_on_segment(node, from, to).parameter;
  if (share == 1) return {j};
  return {i, share, share == 0 ? 1 : place_on_segment(node, to, from).parameter};
}

bool FrontPlaces::follows(const FrontPlace& first, const FrontPlace& second) const {
  if (!first.valid() || !second.valid()) return false;
  const WallLine& line = front_->line;
  if (first.station == second.station && first.share < second.share) return true;
  const std::int32_t steps = line.steps(first.station, second.station);
  return steps != WallLine::none && steps != 0;
}

IdVector<NodeId, FrontPlace> places_of_nodes(const Communicator& comm, const FrontPlaces& places,
                                             const Mesh& mesh) {
  struct Asked {
    GlobalNodeId node;
    BoundaryId boundary;
  };
  const NodeOwners owners(comm, mesh.first_node);
  IdVector<NodeId, FrontPlace> found(mesh.points.size());
  Outbox<Asked> asked;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    const BoundaryId boundary{static_cast<std::int32_t>(b)};
    for (const auto& edge : mesh.boundaries[b].edges) {
      const std::array ends{places.locate(mesh.point(edge[0]), boundary),
                            places.locate(mesh.point(edge[1]), boundary)};
      if (!places.follows(ends[0], ends[1])) continue;
      for (const std::size_t k : {0, 1}) {
        found[edge[k]] = ends[k];
        const GlobalNodeId node = mesh.global(edge[k]);
        if (!mesh.owns(edge[k])) asked.add(owners.rank_of(node), {node, boundary});
      }
    }
  }
  for (const Asked& a : asked.deliver(comm)) {
    const NodeId node = owners.local(a.node);
    found[node] = places.locate(mesh.point(node), a.boundary);
  }
  return found;
}

}  // namespace quadloop
