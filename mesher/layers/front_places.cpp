#include "mesher/layers/front_places.hpp"

#include <limits>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

FrontPlaces::FrontPlaces(const LayerFront& front, bool on_interfaces, bool on_wall)
    : front_{&front}, on_wall_{on_wall}, of_boundary_(front.outer.boundaries().size()) {
  const WallLine& line = front.line;
  for (std::int32_t s = 0; s < front.outer.size(); ++s) {
    const std::int32_t i = front.station_of[s];
    if (i == WallLine::none || line.is_on_interface(i) != on_interfaces) continue;
    if (on_wall && line.width(i) == 0) continue;
    const BoundaryId boundary =
        on_wall ? line.geometry().boundary_of(line[i].segment) : front.outer.boundary_of(s);
    of_boundary_[boundary].stations.push_back(i);
  }
  for (const BoundaryId b : of_boundary_.ids()) {
    std::vector<Box> boxes;
    for (const std::int32_t i : of_boundary_[b].stations)
      boxes.push_back(box_of(point(i), point(line.next(i))));
    of_boundary_[b].tree = BoxTree(boxes);
  }
}

FrontPlace FrontPlaces::locate(Point node, BoundaryId boundary) const {
  const auto& [stations, tree] = of_boundary_[boundary];
  const auto distance = [&](std::int32_t k) {
    return place_on_segment(node, point(stations[k]), point(front_->line.next(stations[k]))).squared_distance;
  };
  const std::int32_t nearest = tree.nearest(node, distance);
  if (nearest == BoxTree::none) return {};
  const std::int32_t i = stations[nearest], j = front_->line.next(i);
  const Point from = point(i), to = point(j);
  const double share = place_on_segment(node, from, to).parameter;
  if (share == 1) return {j};
  return {i, share, share == 0 ? 1 : place_on_segment(node, to, from).parameter};
}

FrontPlace place_of_column(const WallLine& line, const FrontPlace& place) {
  return place.valid() && place.at_station() ? FrontPlace{line.column_at(place.station)} : place;
}

std::array<FrontPlace, 2> places_of_edge(const WallLine& line, const std::array<FrontPlace, 2>& ends) {
  auto [from, to] = ends;
  if (from.valid() && from.at_station()) from.station = line.beginning_at(from.station);
  if (to.valid() && to.at_station()) to.station = line.ending_at(to.station);
  return {from, to};
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
      const auto ends = places.locate_edge(mesh.point(edge[0]), mesh.point(edge[1]), boundary);
      if (!places.follows(ends[0], ends[1])) continue;
      for (const std::size_t k : {0, 1}) {
        found[edge[k]] = place_of_column(places.line(), ends[k]);
        const GlobalNodeId node = mesh.global(edge[k]);
        if (!mesh.owns(edge[k])) asked.add(owners.rank_of(node), {node, boundary});
      }
    }
  }
  for (const Asked& a : asked.deliver(comm)) {
    const NodeId node = owners.local(a.node);
    found[node] = place_of_column(places.line(), places.locate(mesh.point(node), a.boundary));
  }
  return found;
}

}  // namespace quadloop
