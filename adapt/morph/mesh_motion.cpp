#include "adapt/morph/mesh_motion.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <string>

namespace quadloop::adapt {

namespace {

// relative to the extent of the geometry: smaller motions are due to rounding and ignored
constexpr double least_move = 1e-9;

std::vector<Box> boxes_of_loops(const Geometry& geometry) {
  std::vector<Box> boxes(geometry.loop_count());
  for (std::int32_t v = 0; v < geometry.size(); ++v) boxes[geometry.loop_of(v)].include(geometry.point(v));
  return boxes;
}

std::set<std::string> names_of(const Geometry& geometry) {
  std::set<std::string> names;
  for (const Boundary& boundary : geometry.boundaries()) names.insert(boundary.name);
  return names;
}

double extent(const Box& box) { return std::max(box.width(), box.height()); }

/// Returns the extent of the moving boundaries; 0 if none moves.
double extent_of_moved(const BoundaryOutline& outline, std::span<const BoundaryNodeMotion> boundary) {
  const Geometry& geometry = outline.geometry;
  const double enough = least_move * extent(geometry.box());
  std::vector<char> moves(geometry.loop_count(), 0);
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const auto at = std::ranges::lower_bound(boundary, outline.nodes[v], {}, &BoundaryNodeMotion::node);
    if (length(at->motion.to - at->motion.from) > enough) moves[geometry.loop_of(v)] = 1;
  }
  const std::vector<Box> boxes = boxes_of_loops(geometry);
  double largest = 0;
  for (std::size_t loop = 0; loop < boxes.size(); ++loop) {
    if (moves[loop] != 0) largest = std::max(largest, extent(boxes[loop]));
  }
  return largest;
}

}  // namespace

MeshMotion::MeshMotion(const Communicator& comm, const Mesh& mesh, const OutlineChange& change)
    : halo_{comm, mesh},
      places_{layer_places(comm, mesh)},
      outline_{outline_of(comm, mesh, change.by_pieces, names_of(change.to))},
      boundary_{boundary_motion(outline_, change)},
      feet_(halo_.points().size(), -1),
      reach_{extent_of_moved(outline_, boundary_)} {
  halo_.exchange().update(halo_.points());
  for (const NodeId node : ids_below(NodeId{halo_.owned_nodes()})) {
    const auto at = std::ranges::lower_bound(boundary_, mesh.global(node), {}, &BoundaryNodeMotion::node);
    if (at == boundary_.end() || at->node != mesh.global(node)) continue;
    feet_[node] = static_cast<std::int32_t>(at - boundary_.begin());
  }
  halo_.exchange().update(feet_);
  LayerPlaces places = places_;
  places.resize(halo_.points().size());
  halo_.exchange().update(places);
  find_feet(comm, halo_, places, feet_);
  gather_sources(comm, places);
}

double MeshMotion::possible_reach(const OutlineChange& change) const {
  if (reach_ > 0) return reach_;
  const std::set<std::string> names = names_of(change.to);
  const Geometry& geometry = outline_.geometry;
  const std::vector<Box> boxes = boxes_of_loops(geometry);
  double inside = 0, all = 0;
  for (std::size_t loop = 0; loop < boxes.size(); ++loop) {
    const std::int32_t first = geometry.loop_start(static_cast<std::int32_t>(loop));
    if (!names.contains(geometry.boundary(geometry.boundary_of(first)).name)) continue;
    const double own = extent(boxes[loop]);
    all = std::max(all, own);
    if (own < extent(geometry.box())) inside = std::max(inside, own);
  }
  return inside > 0 ? inside : all;
}

/// Collects the boundary, and the outer edges of layers instead of the walls below. *Collective.*
void MeshMotion::gather_sources(const Communicator& comm, const LayerPlaces& places) {
  IdVector<NodeId, double> widths(halo_.points().size(), 0);
  for (const NodeId node : ids_below(NodeId{halo_.owned_nodes()})) {
    if (is_boundary(node)) widths[node] = boundary_[feet_[node]].width;
  }
  const auto is_front = [&](NodeId node) { return feet_[node] >= 0 && places[node].left == 0; };
  halo_.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
      if (!is_front(a) || !is_front(b)) continue;
      const double quarter = length(halo_.point(b) - halo_.point(a)) / 4;  // each edge has two cells
      for (const NodeId node : {a, b}) widths[node] += halo_.owns(node) && !is_boundary(node) ? quarter : 0;
    }
  });
  std::vector<Source> own;
  for (const NodeId node : ids_below(NodeId{halo_.owned_nodes()})) {
    if (feet_[node] >= 0 && places[node].left <= 0 && widths[node] > 0)
      own.push_back({feet_[node], widths[node]});
  }
  sources_ = comm.all_gather_values(std::span<const Source>(own));
}

}  // namespace quadloop::adapt
