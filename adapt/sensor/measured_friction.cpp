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
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// An edge of a wall as all ranks know it; after them what stands at its ends.
struct WallEdge {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::array<double, 2> value{}, density{};  ///< shear or y+
};

/// The cells' height above one end of an edge.
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

/// Of all ranks, in the order of their nodes. *Collective.*
std::vector<WallEdge> wall_edges(const Communicator& comm, const Mesh& mesh, const Field& with_copies,
                                 std::span<const std::string> walls, std::size_t variable) {
  const auto density = only_one(variables_like(with_copies.names, "density"));
  std::vector<WallEdge> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (std::ranges::find(walls, boundary.name) == walls.end()) continue;
    for (const auto& [from, to] : boundary.edges) {
      const auto of = [&](const std::optional<std::size_t>& v, NodeId node) {
        return v ? with_copies.row(node)[*v] : 0;
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

/// Of a wall's cells, the height of their other nodes above the edge, at the end that each is nearer to.
class CellHeights {
 public:
  CellHeights(const Mesh& mesh, const std::vector<WallEdge>& edges) : mesh_{mesh} {
    for (const WallEdge& edge : edges) points_.emplace(edge.nodes, edge.points);
    for (const auto& cell : mesh.triangles) add(cell);
    for (const auto& cell : mesh.quads) add(cell);
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

/// The least one of each node. *Collective.*
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
  if (!shear && !y_plus) return {};
  const Field values = with_copies(comm, mesh, solution);
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

}  // namespace quadloop
