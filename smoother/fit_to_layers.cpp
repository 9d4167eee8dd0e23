#include "smoother/fit_to_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "smoother/sweeps/coloured_sweeps.hpp"
#include "smoother/sweeps/rings.hpp"

namespace quadloop::smoother {

namespace {

// Cells are left alone between these ratios of their height to the last layer's.
constexpr double least_height_ratio = 0.75, largest_height_ratio = 2;
constexpr double steepest = 1.3;                 // ratio of neighbouring widths that is left alone
constexpr double low_aim = 0.9, high_aim = 1.7;  // limits of the target height, in heights of the last layer
constexpr double height_of_equilateral = 0.8660254;  // height over width
constexpr double weight = 0.04;                      // of the height misfit, relative to the shape costs
constexpr double worthwhile = 1 - 1e-3;
constexpr double defect_at_28 = 0.2683281572999748;  // square root of the largest corner cost at 28 degrees
constexpr std::array<double, 2> fit_steps{0.12, 0.04};  // in mean edge lengths of the node
constexpr double diagonal = 0.70710678118654757;
constexpr std::array<Point, Star::batch> fit_directions{{{1, 0},
                                                         {diagonal, diagonal},
                                                         {0, 1},
                                                         {-diagonal, diagonal},
                                                         {-1, 0},
                                                         {-diagonal, -diagonal},
                                                         {0, -1},
                                                         {diagonal, -diagonal}}};
constexpr int fitted_rings = 1, most_sweeps = 6;

/// The boundary edge that begins at a node, where it is on the outer edge of the layers.
struct FrontEdge {
  GlobalNodeId to{-1};
  double last_layer = 0;  ///< the height of the last layer below it; 0: no such edge begins here
};

/// Of each node, copies too. *Collective.*
IdVector<NodeId, FrontEdge> front_edges(const HaloMesh& mesh, BoundarySlide& slide,
                                        std::span<const double> heights) {
  IdVector<NodeId, FrontEdge> edges(mesh.points().size());
  for (const HaloEdge& edge : mesh.edges_in_place()) {
    if (!mesh.owns(edge.from)) continue;
    const double height = slide.height_at(edge, heights);
    if (height > 0) edges[edge.from] = {mesh.global(edge.to), height};
  }
  mesh.exchange().update(edges);
  return edges;
}

/// A cell with a side on the outer edge of the layers. `nodes` are its three or four nodes, starting with
/// that side.
struct FrontCell {
  std::array<NodeId, 4> nodes;
  bool is_quad = false;
  double last_layer = 0;  ///< height of the last layer below the cell

  std::span<const NodeId> all() const { return std::span(nodes).first(is_quad ? 4 : 3); }
};

class LayerFit {
 public:
  LayerFit(const Communicator& comm, HaloMesh& mesh, BoundarySlide& slide, std::span<const double> heights)
      : comm_{comm}, mesh_{mesh}, slide_{slide}, heights_{heights} {
    const IdVector<NodeId, FrontEdge> edges = front_edges(mesh, slide, heights);
    mesh.for_each_cell([&](const auto& cell) {
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const FrontEdge& edge = edges[cell[k]];
        if (edge.last_layer > 0 && mesh.global(cell[(k + 1) % cell.size()]) == edge.to)
          add_cell(cell, k, edge.last_layer);
      }
    });
  }

  bool run() {
    fixed_ = slide_.widths_at_fixed(heights_);
    nodes_ = nodes_near_misfits();
    if (!comm_.any(!nodes_.empty())) return false;
    list_cells();
    const NodeStars stars(mesh_, nodes_, {});
    NodeFlags stale(mesh_.points().size(), 1);
    ColouredSweeps coloured(comm_, mesh_, stars, stale);
    bool moved = true, moved_ever = false;
    for (int sweep = 0; sweep < most_sweeps && moved; ++sweep) {
      fixed_ = slide_.widths_at_fixed(heights_);
      moved = comm_.any(coloured.sweep(
                            stars.all(), [](std::size_t) { return true; },
                            [&](std::size_t i) {
                              stars.gather(i, star_);
                              return better_place(i);
                            }) > 0);
      moved_ever = moved_ever || moved;
    }
    return moved_ever;
  }

 private:
  template <std::size_t width>
  void add_cell(const std::array<NodeId, width>& cell, std::size_t side, double last_layer) {
    FrontCell found{{}, width == 4, last_layer};
    for (std::size_t k = 0; k < width; ++k) found.nodes[k] = cell[(side + k) % width];
    cells_.push_back(found);
  }
  bool slides_on_front(NodeId node) const {
    return slide_.freedom(node) == NodeFreedom::sliding && slide_.lies_on(node, heights_);
  }
  double width_of(const FrontCell& cell) const {
    return length(mesh_.point(cell.nodes[1]) - mesh_.point(cell.nodes[0]));
  }
  /// The height of a cell with `node` at p: its area over the width of its side.
  double height_of(const FrontCell& cell, NodeId node, Point p) const {
    const auto at = [&](std::size_t k) { return cell.nodes[k] == node ? p : mesh_.point(cell.nodes[k]); };
    const Point a = at(0), b = at(1);
    return (cell.is_quad ? cross(at(2) - a, at(3) - b) / 2 : cross(b - a, at(2) - a)) / length(b - a);
  }
  double height_of(const FrontCell& cell) const {
    return height_of(cell, cell.nodes[0], mesh_.point(cell.nodes[0]));
  }

  /// Whether the widths of the two edges along the layers' outer edge differ too much at an owned node.
  bool is_uneven(NodeId node) const {
    const auto [back, ahead] = fixed_[node.value()];
    if (std::min(back, ahead) > 0) return std::max(back, ahead) > steepest * std::min(back, ahead);
    return slide_.freedom(node) == NodeFreedom::sliding && slide_.unevenness(node) > steepest &&
           slides_on_front(node);
  }

  /// Flags the nodes of cells whose height does not fit the last layer, and nodes where the widths jump;
  /// valid for owned nodes.
  NodeFlags misfits() const {
    NodeFlags flags(mesh_.points().size(), 0);
    for (const FrontCell& cell : cells_) {
      const double ratio = height_of(cell) / cell.last_layer;
      if (ratio < least_height_ratio || ratio > largest_height_ratio) flag_all(cell.all(), flags);
    }
    for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes()})) {
      if (is_uneven(node)) flags[node] = 1;
    }
    return flags;
  }

  std::vector<NodeId> nodes_near_misfits() const {
    NodeFlags flags = misfits();
    grow(mesh_, flags, fitted_rings);
    std::vector<NodeId> nodes;
    for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes()})) {
      if (flags[node] != 0 && (slide_.freedom(node) == NodeFreedom::interior || slides_on_front(node)))
        nodes.push_back(node);
    }
    return nodes;
  }

  /// Lists the cells that have a movable node off the outer edge of the layers.
  void list_cells() {
    IdVector<NodeId, std::int32_t> place_of(mesh_.points().size(), -1);
    for (std::int32_t i = 0; const NodeId node : nodes_) place_of[node] = i++;
    cells_of_.resize(nodes_.size());
    for (const FrontCell& cell : cells_) {
      for (const NodeId node : cell.all().subspan(2)) {
        if (const std::int32_t i = place_of[node]; i >= 0) cells_of_[i].push_back(cell);
      }
    }
  }

  /// The misfit of the heights of a node's cells with the node at p. The star must be valid there.
  double misfit(std::size_t i, Point p) const {
    double sum = 0;
    for (const FrontCell& cell : cells_of_[i]) {
      const double natural = (cell.is_quad ? 1 : height_of_equilateral) * width_of(cell);
      const double aim = std::clamp(natural, low_aim * cell.last_layer, high_aim * cell.last_layer);
      const double ratio = height_of(cell, nodes_[i], p) / aim;
      sum += ratio + 1 / ratio - 2;
    }
    return weight * sum;
  }

  std::optional<Point> better_place(std::size_t i) const {
    const NodeId node = nodes_[i];
    if (slide_.freedom(node) == NodeFreedom::sliding) return slide_.towards_middle(node, star_, fixed_);
    const Point p = mesh_.point(node);
    const StarCost<1> now = star_.cost(p, Objective::power);
    if (!now.valid[0]) return std::nullopt;
    const double edge = std::sqrt(star_.reference(p));
    for (const double step : fit_steps) {
      if (const auto found = best_step(i, p, now, step * edge)) return found;
    }
    return std::nullopt;
  }

  std::optional<Point> best_step(std::size_t i, Point p, const StarCost<1>& now, double step) const {
    const double flattest = std::max(cotangent_of_28, now.largest_cotangent[0]),
                 defect = std::max(defect_at_28, now.largest_defect[0]);
    Star::Batch x, y;
    for (int k = 0; k < Star::batch; ++k) {
      x[k] = p.x + step * fit_directions[k].x;
      y[k] = p.y + step * fit_directions[k].y;
    }
    const StarCost<Star::batch> cost = star_.cost(x, y, Objective::power);
    double best = worthwhile * (now.objective[0] + misfit(i, p));
    std::optional<Point> found;
    for (int k = 0; k < Star::batch; ++k) {
      if (!cost.valid[k] || cost.largest_cotangent[k] > flattest || cost.largest_defect[k] > defect) continue;
      const double value = cost.objective[k] + misfit(i, {x[k], y[k]});
      if (value >= best) continue;
      best = value;
      found = Point{x[k], y[k]};
    }
    return found;
  }

  const Communicator& comm_;
  HaloMesh& mesh_;
  BoundarySlide& slide_;
  std::span<const double> heights_;
  std::vector<FrontCell> cells_;
  std::vector<NodeId> nodes_;  ///< nodes that may move
  std::vector<std::vector<FrontCell>> cells_of_;
  std::vector<Point> fixed_;
  Star star_;  ///< star of the visited node
};

}  // namespace

bool fit_to_layers(const Communicator& comm, HaloMesh& mesh, BoundarySlide& slide,
                   std::span<const double> heights) {
  return LayerFit(comm, mesh, slide, heights).run();
}

}  // namespace quadloop::smoother
