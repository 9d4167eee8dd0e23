#include "adapt/morph/morph_mesh.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "adapt/morph/inverse_distance.hpp"
#include "adapt/morph/layer_motion.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "smoother/keep_layers.hpp"
#include "smoother/smooth_mesh.hpp"
#include "smoother/sweeps/rings.hpp"

namespace quadloop {

namespace {

constexpr double quality_kept = 0.8;  // of the worst cell: below it the mesh is smoothed
constexpr double least_move = 1e-9;   // of the outline's extent: what moves less stays, but for rounding
constexpr int smoothed_rings = 4;
constexpr int bisections = 7;

/// The extent of those boundaries that move; 0 where none does.
double extent_of_moved(const BoundaryOutline& outline, std::span<const BoundaryNodeMotion> boundary) {
  const Geometry& geometry = outline.geometry;
  const double enough = least_move * std::max(geometry.box().width(), geometry.box().height());
  std::vector<char> moves(geometry.loop_count(), 0);
  std::vector<Box> boxes(geometry.loop_count());
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const auto at = std::ranges::lower_bound(boundary, outline.nodes[v], {}, &BoundaryNodeMotion::node);
    if (length(at->motion.to - at->motion.from) > enough) moves[geometry.loop_of(v)] = 1;
    boxes[geometry.loop_of(v)].include(geometry.point(v));
  }
  double extent = 0;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    if (moves[loop] != 0) extent = std::max({extent, boxes[loop].width(), boxes[loop].height()});
  }
  return extent;
}

/// The quality of a cell whose nodes are where `place(node)` says.
template <std::size_t width, class Place>
double quality_at(const std::array<NodeId, width>& nodes, const Place& place) {
  std::array<Point, width> corners;
  for (std::size_t k = 0; k < width; ++k) corners[k] = place(nodes[k]);
  return quality_of(corners);
}

/// A mesh as it was, and what moves each of its nodes.
class Morph {
 public:
  /// `mesh` may be moved by this, and keeps its cells. *Collective.*
  Morph(const Communicator& comm, const Mesh& mesh, const OutlineChange& change)
      : comm_{comm},
        halo_{comm, mesh},
        places_{layer_places(comm, mesh)},
        motions_(halo_.points().size()),
        is_boundary_(halo_.points().size(), 0) {
    const BoundaryOutline outline = outline_of(comm, mesh);
    const std::vector<BoundaryNodeMotion> boundary = boundary_motion(outline, change);
    reach_ = extent_of_moved(outline, boundary);
    halo_.exchange().update(halo_.points());
    IdVector<NodeId, double> widths(halo_.points().size(), 0);
    for (const NodeId node : ids_below(NodeId{halo_.owned_nodes()})) {
      const auto at = std::ranges::lower_bound(boundary, mesh.global(node), {}, &BoundaryNodeMotion::node);
      if (at == boundary.end() || at->node != mesh.global(node)) continue;
      motions_[node] = at->motion;
      widths[node] = at->width;
      is_boundary_[node] = 1;
    }
    halo_.exchange().update(motions_);
    LayerPlaces places = places_;
    places.resize(halo_.points().size());
    halo_.exchange().update(places);
    move_columns(comm, halo_, places, motions_);
    gather_sources(places, widths);
  }

  /// Puts the nodes where they are after a share of the way. *Collective.*
  void move(double share, Mesh& mesh) const {
    std::vector<MotionSource> sources = sources_;
    for (MotionSource& source : sources) source.motion = source.motion.part(share);
    const InverseDistance field(sources, reach_);
    for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
      const Point p = halo_.point(node);
      Point& to = mesh.points[node.value()];
      if (is_boundary_[node] != 0)
        to = motions_[node]->part(share).to;
      else
        to = motions_[node] ? motions_[node]->part(share).moved(p) : p + field.displacement(p);
    }
    const NodeExchange exchange(comm_, NodeOwners(comm_, mesh.first_node), mesh.owned_nodes, mesh.copies);
    exchange.update(mesh.points);
  }

  bool moves() const { return reach_ > 0; }
  NodeFlags boundary_nodes() const {
    NodeFlags flags = is_boundary_;
    flags.resize(halo_.owned_nodes());
    return flags;
  }
  /// How far an owned node has gone.
  double way_of(NodeId node, const Mesh& mesh) const { return length(mesh.point(node) - halo_.point(node)); }

  /// Flags owned nodes: those of cells whose quality has suffered, and some rings round them. *Collective.*
  NodeFlags nodes_near_suffering(const Mesh& mesh) const {
    std::vector<GlobalNodeId> nodes;
    const auto look_at = [&](const auto& cell) {
      const auto before = [&](NodeId node) { return halo_.point(node); };
      const auto now = [&](NodeId node) { return mesh.point(node); };
      if (quality_at(cell, now) >= quality_kept * quality_at(cell, before)) return;
      for (const NodeId node : cell) nodes.push_back(mesh.global(node));
    };
    for (const auto& cell : mesh.triangles) look_at(cell);
    for (const auto& cell : mesh.quads) look_at(cell);
    NodeFlags near(halo_.points().size(), 0);
    flag_at_owners(comm_, NodeOwners(comm_, mesh.first_node), nodes, near);
    grow(halo_, near, smoothed_rings);
    near.resize(halo_.owned_nodes());
    return near;
  }

  /// The first node of the worst cell over all ranks. *Collective.*
  Point worst_place(const Mesh& mesh) const {
    std::pair<double, Point> worst{std::numeric_limits<double>::infinity(), {}};
    const auto look_at = [&](const auto& nodes) {
      const double quality = quality_at(nodes, [&](NodeId node) { return mesh.point(node); });
      worst = std::min(worst, std::pair(quality, mesh.point(nodes[0])));
    };
    for (const auto& nodes : mesh.triangles) look_at(nodes);
    for (const auto& nodes : mesh.quads) look_at(nodes);
    struct Found {
      double quality;
      Point place;
    };
    for (const Found& found : comm_.all_gather(Found{worst.first, worst.second}))
      worst = std::min(worst, std::pair(found.quality, found.place));
    return worst.second;
  }

  /// The quality of the worst cell outside layers, or of any that is inverted. *Collective.*
  double worst_quality(const Mesh& mesh) const {
    double worst = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const auto& nodes) {
      const double quality = quality_at(nodes, [&](NodeId node) { return mesh.point(node); });
      if (quality <= 0 || !is_layer_cell(places_, nodes)) worst = std::min(worst, quality);
    };
    for (const auto& nodes : mesh.triangles) look_at(nodes);
    for (const auto& nodes : mesh.quads) look_at(nodes);
    return comm_.minimum(worst);
  }

 private:
  /// The boundary, and the fronts of layers in the place of the walls below. *Collective.*
  void gather_sources(const LayerPlaces& places, IdVector<NodeId, double>& widths) {
    const auto is_front = [&](NodeId node) { return motions_[node] && places[node].left == 0; };
    halo_.for_each_cell([&](const auto& nodes) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
        if (!is_front(a) || !is_front(b)) continue;
        const double quarter = length(halo_.point(b) - halo_.point(a)) / 4;  // each edge has two cells
        for (const NodeId node : {a, b}) widths[node] += is_boundary_[node] != 0 ? 0 : quarter;
      }
    });
    std::vector<MotionSource> own;
    for (const NodeId node : ids_below(NodeId{halo_.owned_nodes()})) {
      if (motions_[node] && places[node].left <= 0 && widths[node] > 0)
        own.push_back({*motions_[node], widths[node]});
    }
    sources_ = comm_.all_gather_values(std::span<const MotionSource>(own));
  }

  const Communicator& comm_;
  HaloMesh halo_;  ///< with the nodes where they were
  LayerPlaces places_;
  NodeMotions motions_;
  NodeFlags is_boundary_;
  std::vector<MotionSource> sources_;
  double reach_ = 0;
};

/// Cells outside layers that have suffered, and those near them, made better; boundary and layers stay.
/// *Collective.*
void smooth_inside(const Communicator& comm, Mesh& mesh, const Morph& morph, const NodeFlags& interfaces) {
  SmoothOptions options;
  options.pinned = morph.boundary_nodes();
  for (const NodeId node : interfaces.ids()) options.pinned[node] |= interfaces[node];
  const NodeFlags near = morph.nodes_near_suffering(mesh);
  for (const NodeId node : near.ids()) {
    if (near[node] == 0) options.pinned[node] = 1;
  }
  options.level_lines = false;
  keep_layers(comm, mesh, options);
  smooth_mesh(comm, mesh, options);
}

/// The longest share of the way after which no cell is inverted, to 1 in 2^bisections; the mesh is left
/// there. *Collective.*
double possible_way(const Morph& morph, Mesh& mesh) {
  double possible = 0, impossible = 1;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (possible + impossible) / 2;
    morph.move(middle, mesh);
    (morph.worst_quality(mesh) > 0 ? possible : impossible) = middle;
  }
  return possible;
}

}  // namespace

MorphReport morph_mesh(const Communicator& comm, Mesh& mesh, const OutlineChange& change,
                       const NodeFlags& interfaces) {
  MorphReport report;
  const Morph morph(comm, mesh, change);
  report.worst_before = report.worst_after = morph.worst_quality(mesh);
  if (!morph.moves()) return report;
  morph.move(1, mesh);
  report.worst_after = morph.worst_quality(mesh);
  if (report.worst_after < quality_kept * report.worst_before) {
    report.smoothed = true;
    smooth_inside(comm, mesh, morph, interfaces);
    report.worst_after = morph.worst_quality(mesh);
  }
  if (!report.valid()) {
    report.worst_place = morph.worst_place(mesh);
    Mesh tried = mesh;
    report.possible_way = possible_way(morph, tried);
  }
  std::int64_t moved = 0;
  double largest = 0;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
    const double way = morph.way_of(node, mesh);
    if (way > 0) ++moved;
    largest = std::max(largest, way);
  }
  report.moved = comm.sum(moved);
  report.largest_move = comm.maximum(largest);
  return report;
}

}  // namespace quadloop
