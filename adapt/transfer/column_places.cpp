#include "adapt/transfer/column_places.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/layers/layered_edges.hpp"

namespace quadloop::adapt {

namespace {

constexpr double rounding = 1e-10;  // in wall edges: nodes within this distance of the old wall are on it

/// The walls with layers, of all ranks.
class LayeredWall {
 public:
  /// *Collective.*
  LayeredWall(const Communicator& comm, const Mesh& mesh) {
    std::vector<Segment> own;
    for (const LayeredEdge& edge : layered_edges(comm, mesh))
      own.push_back({mesh.point(edge.nodes[0]), mesh.point(edge.nodes[1])});
    segments_ = comm.all_gather_values(std::span<const Segment>(own));
    // Independent of the ranks: the first of equal ones is found.
    std::ranges::sort(segments_, {},
                      [](const Segment& s) { return std::tuple(s.from.x, s.from.y, s.to.x, s.to.y); });
    std::vector<Box> boxes;
    for (const Segment& s : segments_) boxes.push_back(box_of(s.from, s.to));
    tree_ = BoxTree(boxes);
  }

  struct Foot {
    Point point;
    double edge = 0;  ///< length of the edge that contains the foot
  };
  Foot nearest(Point p) const {
    const std::int32_t found = tree_.nearest(p, [&](std::int32_t k) {
      return place_on_segment(p, segments_[k].from, segments_[k].to).squared_distance;
    });
    const auto& [from, to] = segments_[found];
    return {from + place_on_segment(p, from, to).parameter * (to - from), length(to - from)};
  }

 private:
  struct Segment {
    Point from, to;
  };
  std::vector<Segment> segments_;
  BoxTree tree_;
};

}  // namespace

std::vector<Point> column_places(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh) {
  std::vector<Point> places(new_mesh.points.begin(), new_mesh.points.begin() + new_mesh.owned_nodes);
  if (!has_layers(old_mesh) || !has_layers(new_mesh)) return places;
  const LayeredWall old_wall(comm, old_mesh), new_wall(comm, new_mesh);
  const LayerPlaces in_layers = layer_places(comm, new_mesh);
  const IdVector<NodeId, double> rest = heights_to_front(comm, new_mesh, in_layers);
  for (const NodeId node : ids_below(NodeId{new_mesh.owned_nodes})) {
    if (!in_layers[node].valid() || in_layers[node].strip >= 0) continue;  // strips do not move
    // On the outer edge of the layers, or on a base whose layers end in a strip.
    if (rest[node] == 0) continue;
    Point& p = places[node.value()];
    const auto [foot, edge] = new_wall.nearest(p);
    const Point shift = old_wall.nearest(foot).point - foot;
    const double height = length(p - foot);
    if (length(shift) > rounding * edge) p = p + (rest[node] / (height + rest[node])) * shift;
  }
  return places;
}

}  // namespace quadloop::adapt
