#include "adapt/sensor/measured_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/variable_names.hpp"

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

std::optional<std::size_t> only_one(const std::vector<std::size_t>& found) {
  if (found.size() != 1) return std::nullopt;
  return found.front();
}

std::optional<std::size_t> y_plus_among(const std::vector<std::string>& names) {
  const auto as_written = std::ranges::find(names, "y+");
  if (as_written != names.end()) return as_written - names.begin();
  return only_one(variables_like(names, "y_plus"));
}

/// Wall edges of all ranks, in the order of their nodes. *Collective.*
std::vector<WallEdge> wall_edges(const Communicator& comm, const Mesh& mesh, const Field& with_ghosts,
                                 std::span<const std::string> walls, std::optional<std::size_t> variable) {
  const auto density = only_one(variables_like(with_ghosts.names, "density"));
  std::vector<WallEdge> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (std::ranges::find(walls, boundary.name) == walls.end()) continue;
    for (const auto& [from, to] : boundary.edges) {
      const auto of = [&](const std::optional<std::size_t>& v, NodeId node) {
        return v ? with_ghosts.row(node)[*v] : 0;
      };
      own.push_back({{mesh.global(from), mesh.global(to)},
                     {mesh.point(from), mesh.point(to)},
                     {of(variable, from), of(variable, to)},
                     {of(density, from), of(density, to)}});
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
        shear{only_one(variables_like(names, "wall_shear"))},
        shear_x{only_one(variables_like(names, "wallShearStress_x"))},
        shear_y{only_one(variables_like(names, "wallShearStress_y"))},
        density{only_one(variables_like(names, "density"))} {}

  bool tells() const { return y_plus || shear || (shear_x && shear_y); }
  const std::string& name(const std::vector<std::string>& names) const {
    return names[y_plus ? *y_plus : shear ? *shear : *shear_x];
  }

  /// `height`: of the cell centre above the wall.
  double wall_units(std::span<const double> row, double height, const WallFlow& flow) const {
    if (y_plus) return std::abs(row[*y_plus]) / height;
    const double along_wall = shear ? std::abs(row[*shear]) : std::hypot(row[*shear_x], row[*shear_y]);
    const double at_wall = density && row[*density] > 0 ? row[*density] : flow.density;
    return std::sqrt(along_wall * at_wall) / flow.viscosity;
  }

  std::optional<std::size_t> y_plus, shear, shear_x, shear_y, density;
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

}  // namespace

MeasuredWall measured_friction(const Communicator& comm, const Mesh& mesh, const Field& solution,
                               std::span<const std::string> walls, const WallFlow& flow,
                               const std::string& where) {
  const auto shear = only_one(variables_like(solution.names, "wall_shear")),
             y_plus = shear ? std::nullopt : y_plus_among(solution.names);
  if (!shear && !y_plus) {
    if (!FrictionInCells(solution.cells.names).tells()) return {};
    const std::vector<WallEdge> edges = wall_edges(comm, mesh, {}, walls, std::nullopt);
    return friction_of_cells(comm, mesh, solution.cells, edges, flow, where);
  }
  const Field values = with_ghosts(comm, mesh, solution);
  const std::vector<WallEdge> edges = wall_edges(comm, mesh, values, walls, shear ? *shear : *y_plus);
  const auto heights = y_plus ? heights_above(comm, mesh, edges) : std::map<GlobalNodeId, double>{};
  MeasuredWall measured;
  for (const WallEdge& edge : edges) {
    const auto wall_units = [&](std::size_t end) {
      const double value = std::abs(edge.value[end]);
      if (!std::isfinite(value))
        throw InputError(fmt::format("{}: '{}' is not finite at the wall's node at ({}, {})", where,
                                     solution.names[shear ? *shear : *y_plus], edge.points[end].x,
                                     edge.points[end].y));
      const double density = edge.density[end] > 0 ? edge.density[end] : flow.density;
      return shear ? std::sqrt(value * density) / flow.viscosity : value / heights.at(edge.nodes[end]);
    };
    measured.push_back({edge.points[0], edge.points[1], wall_units(0), wall_units(1)});
  }
  return measured;
}

}  // namespace quadloop::adapt
