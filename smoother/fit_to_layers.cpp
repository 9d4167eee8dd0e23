#include "smoother/fit_to_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "smoother/coloured_sweeps.hpp"
#include "smoother/rings.hpp"

namespace quadloop {

namespace {

constexpr double lowest = 0.75, highest = 2;  // heights of cells, over that of the last layer, that are left
constexpr double steepest = 1.3;              // ratio of neighbouring widths that is left
constexpr double low_aim = 0.9, high_aim = 1.7;      // heights aimed at lie between these
constexpr double height_of_equilateral = 0.8660254;  // over its width
constexpr double weight = 0.04;                      // of a cell's misfit, against the costs of shapes
constexpr double worthwhile = 1 - 1e-3;
constexpr double cotangent_of_28 = 1.8807264653463318;
constexpr double defect_at_28 = 0.2683281572999748;  // square root of the cost of the worst cell allowed
constexpr std::array<double, 2> steps{0.12, 0.04};   // of the node's mean edge
constexpr int rings = 1, most_sweeps = 6;

/// Which side of a cell lies on the front, if any, and the height of the last layer below it.
struct FrontSide {
  std::int8_t side = -1;
  double height = 0;
};

/// A cell with a side on the front: its nodes from that side's on, three or four.
struct FrontCell {
  std::array<NodeId, 4> nodes;
  bool is_quad = false;
  double height = 0;
};

/// Of the mesh's own cells.
std::vector<FrontSide> own_sides(const Mesh& mesh, const BoundarySlide& slide,
                                 std::span<const double> heights) {
  IdVector<NodeId, NodeId> next(mesh.points.size());
  IdVector<NodeId, double> height(mesh.points.size(), 0);
  for (std::int32_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    for (const auto& [from, to] : mesh.boundaries[b].edges) {
      const double h = slide.height_at({from, to, b}, heights);
      if (h == 0) continue;
      next[from] = to;
      height[from] = h;
    }
  }
  std::vector<FrontSide> sides;
  const auto add = [&](const auto& cell) {
    FrontSide found;
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const NodeId from = cell[k], to = cell[(k + 1) % cell.size()];
      if (height[from] > 0 && next[from] == to) found = {static_cast<std::int8_t>(k), height[from]};
    }
    sides.push_back(found);
  };
  for (const auto& cell : mesh.triangles) add(cell);
  for (const auto& cell : mesh.quads) add(cell);
  return sides;
}

class LayerFit {
 public:
  LayerFit(const Communicator& comm, HaloMesh& mesh, const Mesh& own, const BoundarySlide& slide,
           std::span<const double> heights)
      : comm_{comm}, mesh_{mesh}, slide_{slide}, heights_{heights} {
    const std::vector<FrontSide> sides = mesh.spread(comm, own_sides(own, slide, heights));
    std::size_t number = 0;
    mesh.for_each_cell([&](const auto& cell) {
      const FrontSide& front = sides[number++];
      if (front.side < 0) return;
      FrontCell found{{}, cell.size() == 4, front.height};
      for (std::size_t k = 0; k < cell.size(); ++k) found.nodes[k] = cell[(front.side + k) % cell.size()];
      cells_.push_back(found);
    });
  }

  bool run() {
    std::vector<NodeId> nodes = nodes_of_misfits();
    if (!comm_.any(!nodes.empty())) return false;
    const NodeStars stars(mesh_, std::move(nodes), {});
    nodes_ = stars.nodes();
    list_cells(stars);
    ColouredSweeps coloured(comm_, mesh_, stars);
    bool moved = true, moved_ever = false;
    for (int sweep = 0; sweep < most_sweeps && moved; ++sweep) {
      fixed_ = slide_.widths_at_fixed(heights_);
      moved = comm_.any(coloured.sweep([](std::size_t) { return true; },
                                       [&](std::size_t i) {
                                         stars.gather(i, star_);
                                         return better_place(i);
                                       }) > 0);
      moved_ever = moved_ever || moved;
    }
    return moved_ever;
  }

 private:
  /// A front cell's height, as if it were as wide everywhere.
  double height_of(const FrontCell& cell) const {
    const auto& n = cell.nodes;
    const Point along = mesh_.point(n[1]) - mesh_.point(n[0]);
    const double doubled =
        cell.is_quad ? cross(mesh_.point(n[2]) - mesh_.point(n[0]), mesh_.point(n[3]) - mesh_.point(n[1]))
                     : cross(along, mesh_.point(n[2]) - mesh_.point(n[0]));
    return doubled / length(along) / (cell.is_quad ? 2 : 1);
  }

  std::vector<NodeId> nodes_of_misfits() const {
    NodeFlags flags(mesh_.points().size(), 0);
    for (const FrontCell& cell : cells_) {
      const double height = height_of(cell) / cell.height;
      if (height < lowest || height > highest)
        flag_all(std::span(cell.nodes).first(cell.is_quad ? 4 : 3), flags);
    }
    for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes()})) {
      if (slide_.freedom(node) == NodeFreedom::sliding && slide_.unevenness(node) > steepest &&
          slide_.lies_on(node, heights_))
        flags[node] = 1;
    }
    grow(mesh_, flags, rings);
    std::vector<NodeId> nodes;
    for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes()})) {
      const NodeFreedom freedom = slide_.freedom(node);
      if (flags[node] != 0 && (freedom == NodeFreedom::interior ||
                               (freedom == NodeFreedom::sliding && slide_.lies_on(node, heights_))))
        nodes.push_back(node);
    }
    return nodes;
  }

  void list_cells(const NodeStars& stars) {
    IdVector<NodeId, std::int32_t> star_of(mesh_.points().size(), -1);
    for (std::int32_t i = 0; const NodeId node : stars.nodes()) star_of[node] = i++;
    cells_of_.resize(stars.size());
    for (std::int32_t c = 0; c < size32(cells_); ++c) {
      for (std::size_t k = 2; k < (cells_[c].is_quad ? 4U : 3U); ++k) {
        if (const std::int32_t i = star_of[cells_[c].nodes[k]]; i >= 0) cells_of_[i].push_back(c);
      }
    }
  }

  /// How far the cell's area is from what is aimed at, with a node at p.
  double misfit(const FrontCell& cell, NodeId node, Point p) const {
    const auto& n = cell.nodes;
    const auto at = [&](NodeId other) { return other == node ? p : mesh_.point(other); };
    const Point a = mesh_.point(n[0]), b = mesh_.point(n[1]);
    const double width = length(b - a);
    const double natural = (cell.is_quad ? 1 : height_of_equilateral) * width;
    const double aim = std::clamp(natural, low_aim * cell.height, high_aim * cell.height);
    const double doubled = cell.is_quad ? cross(at(n[2]) - a, at(n[3]) - b) / 2 : cross(b - a, at(n[2]) - a);
    const double share = doubled / (aim * width);
    return share + 1 / share - 2;
  }

  std::optional<Point> better_place(std::size_t i) {
    const NodeId node = nodes_[i];
    if (slide_.freedom(node) == NodeFreedom::sliding) return slide_.towards_middle(node, star_, fixed_);
    const Point p = mesh_.point(node);
    constexpr double diagonal = 0.70710678118654757;
    static constexpr std::array<Point, Star::batch> directions{{{1, 0},
                                                                {diagonal, diagonal},
                                                                {0, 1},
                                                                {-diagonal, diagonal},
                                                                {-1, 0},
                                                                {-diagonal, -diagonal},
                                                                {0, -1},
                                                                {diagonal, -diagonal}}};
    const auto misfits = [&](Point at) {
      double sum = 0;
      for (const std::int32_t c : cells_of_[i]) sum += misfit(cells_[c], node, at);
      return weight * sum;
    };
    const StarCost<1> now = star_.cost(p, Objective::power);
    if (!now.valid[0]) return std::nullopt;
    const double flattest = std::max(cotangent_of_28, now.largest_cotangent[0]),
                 defect = std::max(defect_at_28, now.largest_defect[0]);
    const double edge = std::sqrt(star_.reference(p));
    double best = worthwhile * (now.objective[0] + misfits(p));
    for (const double step : steps) {
      Star::Batch x, y;
      for (int k = 0; k < Star::batch; ++k) {
        x[k] = p.x + step * edge * directions[k].x;
        y[k] = p.y + step * edge * directions[k].y;
      }
      const StarCost<Star::batch> cost = star_.cost(x, y, Objective::power);
      std::optional<Point> found;
      for (int k = 0; k < Star::batch; ++k) {
        if (!cost.valid[k] || cost.largest_cotangent[k] > flattest || cost.largest_defect[k] > defect ||
            cost.objective[k] >= best)
          continue;
        const double value = cost.objective[k] + misfits({x[k], y[k]});
        if (value >= best) continue;
        best = value;
        found = Point{x[k], y[k]};
      }
      if (found) return found;
    }
    return std::nullopt;
  }

  const Communicator& comm_;
  HaloMesh& mesh_;
  const BoundarySlide& slide_;
  std::span<const double> heights_;
  std::vector<FrontCell> cells_;
  std::vector<std::vector<std::int32_t>>
      cells_of_;  ///< of each node that may move, those it is no front node of
  std::vector<NodeId> nodes_;
  std::vector<Point> fixed_;
  Star star_;
};

}  // namespace

bool fit_to_layers(const Communicator& comm, HaloMesh& mesh, const Mesh& own, const BoundarySlide& slide,
                   std::span<const double> heights) {
  return LayerFit(comm, mesh, own, slide, heights).run();
}

}  // namespace quadloop
