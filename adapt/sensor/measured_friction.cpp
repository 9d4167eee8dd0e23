#include "adapt/sensor/measured_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/variable_names.hpp"
#include "mesher/mesh/wake_roots.hpp"

namespace quadloop::adapt {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// A wall edge, known to all ranks, with values at its ends.
struct WallEdge {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::array<double, 2> value{}, density{};  ///< shear or y+
};

/// Height of the cells above one end of an edge.
struct HeightAbove {
  GlobalNodeId node;
  double height = unknown;
};

std::optional<std::size_t> y_plus_among(const std::vector<std::string>& names) {
  const auto as_written = std::ranges::find(names, "y+");
  if (as_written != names.end()) return as_written - names.begin();
  return only_variable_like(names, "y_plus");
}

/// The nodal variables that give friction: shear along the wall, SU2's skin friction coefficient, or else y+.
class FrictionAtNodes {
 public:
  FrictionAtNodes(const std::vector<std::string>& names, const WallFlow& flow)
      : shear_{only_variable_like(names, "wall_shear")}, dynamic_pressure_{flow.dynamic_pressure} {
    if (shear_) return;
    if (dynamic_pressure_ > 0) coefficient_ = components_like(names, "Skin_Friction_Coefficient");
    if (!coefficient_) y_plus_ = y_plus_among(names);
  }

  bool tells() const { return shear_ || coefficient_ || y_plus_; }
  bool is_y_plus() const { return y_plus_.has_value(); }
  const std::string& name(const std::vector<std::string>& names) const {
    return names[shear_ ? *shear_ : coefficient_ ? coefficient_->front() : *y_plus_];
  }
  /// Magnitude of the shear, or y+.
  double value(std::span<const double> row) const {
    if (coefficient_)
      return dynamic_pressure_ * std::hypot(row[coefficient_->front()], row[coefficient_->back()]);
    return std::abs(row[shear_ ? *shear_ : *y_plus_]);
  }

 private:
  std::optional<std::size_t> shear_, y_plus_;
  std::optional<std::array<std::size_t, 2>> coefficient_;
  double dynamic_pressure_;
};

/// Wall edges of all ranks, in the order of their nodes; `friction` is null for edges without values.
/// *Collective.*
std::vector<WallEdge> wall_edges(const Communicator& comm, const Mesh& mesh, const Field& with_ghosts,
                                 std::span<const std::string> walls, const FrictionAtNodes* friction) {
  const auto density = only_variable_like(with_ghosts.names, "density");
  std::vector<WallEdge> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (std::ranges::find(walls, boundary.name) == walls.end()) continue;
    for (const auto& [from, to] : boundary.edges) {
      const auto value_at = [&](NodeId node) {
        return friction != nullptr ? friction->value(with_ghosts.row(node)) : 0;
      };
      const auto density_at = [&](NodeId node) { return density ? with_ghosts.row(node)[*density] : 0; };
      own.push_back({{mesh.global(from), mesh.global(to)},
                     {mesh.point(from), mesh.point(to)},
                     {value_at(from), value_at(to)},
                     {density_at(from), density_at(to)}});
    }
  }
  std::vector<WallEdge> edges = comm.all_gather_values(std::span<const WallEdge>(own));
  std::ranges::sort(edges, {}, &WallEdge::nodes);
  return edges;
}

/// Friction data of the cell at a wall edge.
struct CellAtEdge {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  double wall_units;
};

/// The cell variables that give friction: y+ of the cell centres, or shear along the wall.
struct FrictionInCells {
  explicit FrictionInCells(const std::vector<std::string>& names)
      : y_plus{y_plus_among(names)},
        shear{only_variable_like(names, "wall_shear")},
        stress{components_like(names, "wallShearStress")},
        density{only_variable_like(names, "density")} {}

  bool tells() const { return y_plus || shear || stress; }
  const std::string& name(const std::vector<std::string>& names) const {
    return names[y_plus ? *y_plus : shear ? *shear : stress->front()];
  }

  /// `height`: of the cell centre above the wall.
  double wall_units(std::span<const double> row, double height, const WallFlow& flow) const {
    if (y_plus) return std::abs(row[*y_plus]) / height;
    const double along_wall =
        shear ? std::abs(row[*shear]) : std::hypot(row[stress->front()], row[stress->back()]);
    const double at_wall = density && row[*density] > 0 ? row[*density] : flow.density;
    return std::sqrt(along_wall * at_wall) / flow.viscosity;
  }

  std::optional<std::size_t> y_plus, shear;
  std::optional<std::array<std::size_t, 2>> stress;
  std::optional<std::size_t> density;
};

/// The local cells at wall edges, by the ends of the edges.
class CellsAtWalls {
 public:
  CellsAtWalls(const Mesh& mesh, const CellValues& cells, const std::vector<WallEdge>& edges,
               const WallFlow& flow)
      : mesh_{mesh}, cells_{cells}, friction_{cells.names}, flow_{flow} {
    for (const WallEdge& edge : edges) points_.emplace(edge.nodes, edge.points);
    mesh.for_each_cell([&](const auto& cell) { add(cell); });
  }
  const std::vector<CellAtEdge>& found() const { return found_; }

 private:
  template <std::size_t corners>
  void add(const std::array<NodeId, corners>& cell) {
    const auto row = std::span(cells_.values).subspan(number_++ * cells_.width(), cells_.width());
    for (std::size_t k = 0; k < corners; ++k) {
      const std::array nodes{mesh_.global(cell[k]), mesh_.global(cell[(k + 1) % corners])};
      const auto edge = points_.find(nodes);
      if (edge == points_.end()) continue;
      std::array<Point, corners> places;
      for (std::size_t i = 0; i < corners; ++i) places[i] = mesh_.point(cell[i]);
      const auto [a, b] = edge->second;
      const double height = cross(b - a, shape_of(places).centroid - a) / length(b - a);
      found_.push_back({nodes, edge->second, friction_.wall_units(row, height, flow_)});
    }
  }

  const Mesh& mesh_;
  const CellValues& cells_;
  FrictionInCells friction_;
  WallFlow flow_;
  std::map<std::array<GlobalNodeId, 2>, std::array<Point, 2>> points_;
  std::size_t number_ = 0;
  std::vector<CellAtEdge> found_;
};

/// Friction at wall nodes as the mean of the adjacent wall edges. *Collective.*
MeasuredWall friction_of_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                               const std::vector<WallEdge>& edges, const WallFlow& flow,
                               const std::string& where) {
  const CellsAtWalls own(mesh, cells, edges, flow);
  std::vector<CellAtEdge> all = comm.all_gather_values(std::span<const CellAtEdge>(own.found()));
  std::ranges::sort(all, {}, &CellAtEdge::nodes);
  std::map<GlobalNodeId, std::pair<double, int>> sums;
  for (const CellAtEdge& at : all) {
    if (!std::isfinite(at.wall_units))
      throw InputError(fmt::format("{}: '{}' is not finite in the cell at the wall at ({}, {})", where,
                                   FrictionInCells(cells.names).name(cells.names), at.points[0].x,
                                   at.points[0].y));
    for (const GlobalNodeId node : at.nodes) {
      sums[node].first += at.wall_units;
      ++sums[node].second;
    }
  }
  const auto mean = [&](GlobalNodeId node) { return sums.at(node).first / sums.at(node).second; };
  MeasuredWall measured;
  for (const CellAtEdge& at : all)
    measured.push_back({at.points[0], at.points[1], mean(at.nodes[0]), mean(at.nodes[1])});
  return measured;
}

/// Heights of the other nodes of wall-adjacent cells above the edge, assigned to the nearer end.
class CellHeights {
 public:
  CellHeights(const Mesh& mesh, const std::vector<WallEdge>& edges) : mesh_{mesh} {
    for (const WallEdge& edge : edges) points_.emplace(edge.nodes, edge.points);
    mesh.for_each_cell([&](const auto& cell) { add(cell); });
  }
  const std::vector<HeightAbove>& heights() const { return heights_; }

 private:
  template <std::size_t corners>
  void add(const std::array<NodeId, corners>& cell) {
    for (std::size_t k = 0; k < corners; ++k) {
      const GlobalNodeId from = mesh_.global(cell[k]), to = mesh_.global(cell[(k + 1) % corners]);
      const auto edge = points_.find({from, to});
      if (edge == points_.end()) continue;
      const auto [a, b] = edge->second;
      const auto above = [&](NodeId node) { return cross(b - a, mesh_.point(node) - a) / length(b - a); };
      heights_.push_back({to, above(cell[(k + 2) % corners])});
      heights_.push_back({from, above(cell[(k + corners - 1) % corners])});
    }
  }

  const Mesh& mesh_;
  std::map<std::array<GlobalNodeId, 2>, std::array<Point, 2>> points_;
  std::vector<HeightAbove> heights_;
};

/// The smallest height at each node. *Collective.*
std::map<GlobalNodeId, double> heights_above(const Communicator& comm, const Mesh& mesh,
                                             const std::vector<WallEdge>& edges) {
  const CellHeights own(mesh, edges);
  std::map<GlobalNodeId, double> least;
  for (const auto& [node, height] : comm.all_gather_values(std::span<const HeightAbove>(own.heights()))) {
    const auto at = least.try_emplace(node, height).first;
    at->second = std::min(at->second, height);
  }
  return least;
}

/// Whether the wall turns at the node between two edges, so that the nearest node off the wall, to whose
/// distance a solver's y+ refers, may be on a wake or in a corner.
bool is_corner(const WallEdge& before, const WallEdge& after) {
  constexpr double cosine = 0.866;  // 30 degrees
  const Point a = before.points[1] - before.points[0], b = after.points[1] - after.points[0];
  return dot(a, b) < cosine * length(a) * length(b);
}

/// Replaces the value at each corner by that at the other end of the edge; if that is a corner too, by the
/// value beyond the corner. `is_left_out(edge, next)`: whether their common node is a corner.
template <class IsLeftOut>
void replace_corners(const std::vector<WallEdge>& edges, const IsLeftOut& is_left_out,
                     MeasuredWall& measured) {
  std::map<GlobalNodeId, std::size_t> edge_from;
  for (std::size_t k = 0; k < edges.size(); ++k) edge_from.emplace(edges[k].nodes[0], k);
  std::vector<std::array<bool, 2>> corners(edges.size());
  std::vector<std::array<std::size_t, 2>> joints;  // edges before and after a corner
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto next = edge_from.find(edges[k].nodes[1]);
    if (next == edge_from.end() || !is_left_out(edges[k], edges[next->second])) continue;
    corners[k][1] = corners[next->second][0] = true;
    joints.push_back({k, next->second});
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (corners[k][0] && !corners[k][1]) measured[k].wall_units_from = measured[k].wall_units_to;
    if (corners[k][1] && !corners[k][0]) measured[k].wall_units_to = measured[k].wall_units_from;
  }
  const auto has_value = [&](std::size_t k) { return !corners[k][0] || !corners[k][1]; };
  for (const auto& [before, after] : joints) {
    if (has_value(before) && !has_value(after))
      measured[after].wall_units_from = measured[before].wall_units_to;
    if (has_value(after) && !has_value(before))
      measured[before].wall_units_to = measured[after].wall_units_from;
  }
}

/// *Collective.*
MeasuredWall friction_at_nodes(const Communicator& comm, const Mesh& mesh, const Field& solution,
                               std::span<const std::string> walls, const WallFlow& flow,
                               const std::string& where) {
  const FrictionAtNodes friction(solution.names, flow);
  const std::vector<WallEdge> edges =
      wall_edges(comm, mesh, with_ghosts(comm, mesh, solution), walls, &friction);
  const bool by_height = friction.is_y_plus();
  const auto heights = by_height ? heights_above(comm, mesh, edges) : std::map<GlobalNodeId, double>{};
  MeasuredWall measured;
  for (const WallEdge& edge : edges) {
    const auto wall_units = [&](std::size_t end) {
      const double value = edge.value[end];
      if (!std::isfinite(value))
        throw InputError(fmt::format("{}: '{}' is not finite at the wall's node at ({}, {})", where,
                                     friction.name(solution.names), edge.points[end].x, edge.points[end].y));
      if (by_height) return value / heights.at(edge.nodes[end]);
      const double density = edge.density[end] > 0 ? edge.density[end] : flow.density;
      return std::sqrt(value * density) / flow.viscosity;
    };
    measured.push_back({edge.points[0], edge.points[1], wall_units(0), wall_units(1)});
  }
  const std::set<GlobalNodeId> roots = wake_roots(mesh.strips);
  const auto is_left_out = [&](const WallEdge& edge, const WallEdge& next) {
    return roots.contains(edge.nodes[1]) || (by_height && is_corner(edge, next));
  };
  replace_corners(edges, is_left_out, measured);
  return measured;
}

}  // namespace

MeasuredWall measured_friction(const Communicator& comm, const Mesh& mesh, const Field& solution,
                               std::span<const std::string> walls, const WallFlow& flow,
                               const std::string& where) {
  if (FrictionAtNodes(solution.names, flow).tells())
    return friction_at_nodes(comm, mesh, solution, walls, flow, where);
  if (!FrictionInCells(solution.cells.names).tells()) return {};
  const std::vector<WallEdge> edges = wall_edges(comm, mesh, {}, walls, nullptr);
  return friction_of_cells(comm, mesh, solution.cells, edges, flow, where);
}

}  // namespace quadloop::adapt
