#include "adapt/morph/morph_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "adapt/morph/mesh_motion.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/paired_nodes.hpp"
#include "smoother/keep_layers.hpp"
#include "smoother/smooth_mesh.hpp"
#include "smoother/sweeps/rings.hpp"

namespace quadloop::adapt {

namespace {

constexpr double quality_kept = 0.8;  // relative quality of the worst cell: below it the mesh is smoothed
constexpr int smoothed_rings = 4;
constexpr int bisections = 7;
constexpr double pair_tolerance = 1e-11;  // of the largest coordinate, as for `quadloop check`

/// Returns the quality of a cell with the node positions `place(node)`.
template <std::size_t width, class Place>
double quality_at(const std::array<NodeId, width>& nodes, const Place& place) {
  std::array<Point, width> corners;
  for (std::size_t k = 0; k < width; ++k) corners[k] = place(nodes[k]);
  return quality_of(corners);
}

/// A mesh before the morph, with the motion of its nodes.
class Morph {
 public:
  /// `mesh` may be moved by this object; its cells must not change. *Collective.*
  Morph(const Communicator& comm, const Mesh& mesh, const OutlineChange& change)
      : comm_{comm}, motion_{comm, mesh, change}, halo_{motion_.before()} {}

  /// Moves the nodes by a fraction of the motion. *Collective.*
  void move(double share, Mesh& mesh) const {
    const auto part_of = [&](std::int32_t foot) { return motion_.boundary()[foot].motion.part(share); };
    const InverseDistance field =
        motion_.field(motion_.reach(), [&](std::int32_t foot) { return linear_motion(part_of(foot)); });
    for (const NodeId node : ids_below(NodeId{mesh.owned_nodes})) {
      const Point p = halo_.point(node);
      const std::int32_t foot = motion_.foot(node);
      Point& to = mesh.points[node.value()];
      if (foot < 0)
        to = p + field.displacement(p);
      else
        to = motion_.is_boundary(node) ? part_of(foot).to : part_of(foot).moved(p);
    }
    const NodeExchange exchange(comm_, NodeOwners(comm_, mesh.first_node), mesh.owned_nodes, mesh.ghosts);
    exchange.update(mesh.points);
  }

  bool moves() const { return motion_.reach() > 0; }
  const HaloMesh& before() const { return halo_; }
  NodeFlags boundary_nodes() const {
    NodeFlags flags(halo_.owned_nodes(), 0);
    for (const NodeId node : flags.ids()) flags[node] = motion_.is_boundary(node) ? 1 : 0;
    return flags;
  }
  /// Throws InputError if the nodes on the two sides of a pair would no longer match. *Collective.*
  void require_alike(const Mesh& mesh, const PeriodicPair& pair) const {
    const PairedNodes nodes = paired_nodes(comm_, mesh, pair);
    for (std::size_t k = 0; k < nodes.from.nodes.size(); ++k) {
      const Point from = image_of(nodes.from.nodes[k]), to = image_of(nodes.to.nodes[k]);
      const double size = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
      if (length(pair.image(from) - to) <= pair_tolerance * size) continue;
      throw InputError(
          fmt::format("the two sides of the periodic pair '{}' and '{}' do not move alike near ({:g}, {:g}), "
                      "so that their nodes would no longer match; generate a new mesh",
                      pair.from, pair.to, nodes.from.points[k].x, nodes.from.points[k].y));
    }
  }

  /// Returns how far an owned node has moved.
  double way_of(NodeId node, const Mesh& mesh) const { return length(mesh.point(node) - halo_.point(node)); }

  /// Flags owned nodes: those of cells whose quality has decreased too much, and some rings around them.
  /// *Collective.*
  NodeFlags nodes_near_suffering(const Mesh& mesh) const {
    std::vector<GlobalNodeId> nodes;
    const auto look_at = [&](const auto& cell) {
      const auto before = [&](NodeId node) { return halo_.point(node); };
      const auto now = [&](NodeId node) { return mesh.point(node); };
      if (quality_at(cell, now) >= quality_kept * quality_at(cell, before)) return;
      for (const NodeId node : cell) nodes.push_back(mesh.global(node));
    };
    mesh.for_each_cell(look_at);
    NodeFlags near(halo_.points().size(), 0);
    flag_at_owners(comm_, NodeOwners(comm_, mesh.first_node), nodes, near);
    smoother::grow(halo_, near, smoothed_rings);
    near.resize(halo_.owned_nodes());
    return near;
  }

  /// Returns the first node of the worst cell over all ranks. *Collective.*
  Point worst_place(const Mesh& mesh) const {
    std::pair<double, Point> worst{std::numeric_limits<double>::infinity(), {}};
    const auto look_at = [&](const auto& nodes) {
      const double quality = quality_at(nodes, [&](NodeId node) { return mesh.point(node); });
      worst = std::min(worst, std::pair(quality, mesh.point(nodes[0])));
    };
    mesh.for_each_cell(look_at);
    struct Found {
      double quality;
      Point place;
    };
    for (const Found& found : comm_.all_gather(Found{worst.first, worst.second}))
      worst = std::min(worst, std::pair(found.quality, found.place));
    return worst.second;
  }

  /// Returns the quality of the worst cell outside layers, or of any inverted cell. *Collective.*
  double worst_quality(const Mesh& mesh) const {
    double worst = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const auto& nodes) {
      const double quality = quality_at(nodes, [&](NodeId node) { return mesh.point(node); });
      if (quality <= 0 || !is_layer_cell(motion_.places(), nodes)) worst = std::min(worst, quality);
    };
    mesh.for_each_cell(look_at);
    return comm_.minimum(worst);
  }

 private:
  Point image_of(GlobalNodeId node) const {
    const auto at = std::ranges::lower_bound(motion_.boundary(), node, {}, &BoundaryNodeMotion::node);
    return at->motion.to;
  }

  const Communicator& comm_;
  MeshMotion motion_;
  const HaloMesh& halo_;  ///< with the original node positions
};

/// Flags the owned nodes that are shared by cells of two blocks. *Collective.*
void flag_between_blocks(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo, NodeFlags& flags) {
  std::vector<std::int32_t> of_cells = mesh.blocks.of_triangles;
  of_cells.insert(of_cells.end(), mesh.blocks.of_quads.begin(), mesh.blocks.of_quads.end());
  const std::vector<std::int32_t> blocks = halo.spread(comm, of_cells);
  IdVector<NodeId, std::int32_t> block_of(halo.points().size(), -1);
  auto block = blocks.begin();
  halo.for_each_cell([&](const auto& nodes) {
    for (const NodeId node : nodes) {
      if (halo.owns(node) && block_of[node] >= 0 && block_of[node] != *block) flags[node] = 1;
      block_of[node] = *block;
    }
    ++block;
  });
}

/// Flags the owned nodes of inner lines. *Collective.*
void flag_inner_lines(const Communicator& comm, const Mesh& mesh, NodeFlags& flags) {
  std::vector<GlobalNodeId> nodes;
  for (const BoundaryEdges& line : mesh.boundaries) {
    if (!line.inner_line) continue;
    for (const auto& [a, b] : line.edges) nodes.insert(nodes.end(), {mesh.global(a), mesh.global(b)});
  }
  flag_at_owners(comm, NodeOwners(comm, mesh.first_node), nodes, flags);
}

/// Smooths the cells outside layers whose quality has decreased too much, and those near them; boundary,
/// nodes between blocks, inner lines and layers do not move. *Collective.*
void smooth_inside(const Communicator& comm, Mesh& mesh, const Morph& morph) {
  smoother::SmoothOptions options;
  options.pinned = morph.boundary_nodes();
  if (!mesh.blocks.names.empty()) flag_between_blocks(comm, mesh, morph.before(), options.pinned);
  flag_inner_lines(comm, mesh, options.pinned);
  const NodeFlags near = morph.nodes_near_suffering(mesh);
  for (const NodeId node : near.ids()) {
    if (near[node] == 0) options.pinned[node] = 1;
  }
  options.level_transitions = false;
  smoother::keep_layers(comm, mesh, options);
  smoother::smooth_mesh(comm, mesh, options);
}

/// Returns the largest fraction of the motion, to 1 in 2^bisections, after which no cell is inverted, or
/// worse than `least_quality`; leaves the mesh there. *Collective.*
double possible_way(const Morph& morph, Mesh& mesh, double least_quality) {
  double possible = 0, impossible = 1;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (possible + impossible) / 2;
    morph.move(middle, mesh);
    const double worst = morph.worst_quality(mesh);
    (worst > 0 && worst >= least_quality ? possible : impossible) = middle;
  }
  return possible;
}

}  // namespace

std::string text_of_inversion(const MorphReport& report) {
  return fmt::format("cells near ({:g}, {:g}) become inverted after {:.0f} % of the movement",
                     report.worst_place.x, report.worst_place.y, 100 * report.possible_way);
}

std::string text_of_smoothing(const std::string& geometry) {
  return fmt::format(
      "the mesh had to be smoothed on {}, so the node positions have no derivative; start from a mesh closer "
      "to that geometry",
      geometry);
}

MorphReport morph_mesh(const Communicator& comm, Mesh& mesh, const OutlineChange& change,
                       double least_quality) {
  MorphReport report;
  const Morph morph(comm, mesh, change);
  for (const PeriodicPair& pair : mesh.pairs) morph.require_alike(mesh, pair);
  report.worst_before = report.worst_after = morph.worst_quality(mesh);
  if (!morph.moves()) return report;
  morph.move(1, mesh);
  report.worst_after = morph.worst_quality(mesh);
  if (report.worst_after < quality_kept * report.worst_before) {
    report.smoothed = true;
    smooth_inside(comm, mesh, morph);
    report.worst_after = morph.worst_quality(mesh);
  }
  if (!report.valid()) report.worst_place = morph.worst_place(mesh);
  if (!report.valid() || report.worst_after < least_quality) {
    Mesh tried = mesh;
    report.possible_way = possible_way(morph, tried, least_quality);
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

}  // namespace quadloop::adapt
