#include "flow/postprocess/wall_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "flow/postprocess/flow_quantities.hpp"
#include "flow/postprocess/nodes_above_walls.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::flow {

namespace {

/// State of a wall node or edge.
struct WallState {
  Point velocity;
  double pressure = 0, density = 0, shear = 0;
};

/// Returns a direction along a wall, oriented downstream.
Point downstream(Point along, const FreeStream& stream) {
  const double angle = stream.alpha * std::numbers::pi / 180;
  return dot(along, {std::cos(angle), std::sin(angle)}) < 0 ? -1.0 * along : along;
}

/// Flags of the requested walls, for the mesh's boundaries: 1 or 0.
struct Walls {
  Walls(const Mesh& mesh, const std::vector<std::string>& names, const FreeStream& stream) {
    for (const BoundaryEdges& boundary : mesh.boundaries) {
      const bool is_wall = std::ranges::find(names, boundary.name) != names.end();
      asked.push_back(is_wall ? 1 : 0);
      rough.push_back(
          is_wall && stream.viscosity > 0 && boundary.condition != BoundaryCondition::inviscid_wall ? 1 : 0);
    }
  }
  std::vector<char> asked, rough;  ///< rough: with friction
};

/// The rows of the owned nodes.
class WallRows {
 public:
  WallRows(const Mesh& mesh, bool has_density, bool has_shear)
      : has_density_{has_density}, has_shear_{has_shear} {
    rows_.names = {"x_velocity", "y_velocity", "pressure"};
    if (has_density) rows_.names.emplace_back("density");
    if (has_shear) rows_.names.emplace_back("wall_shear");
    rows_.values.reserve(rows_.width() * mesh.owned_nodes);
  }
  void add(const WallState& state) {
    rows_.values.insert(rows_.values.end(), {state.velocity.x, state.velocity.y, state.pressure});
    if (has_density_) rows_.values.push_back(state.density);
    if (has_shear_) rows_.values.push_back(state.shear);
  }
  Field take() { return std::move(rows_); }

 private:
  Field rows_;
  bool has_density_, has_shear_;
};

/// For each owned node. *Collective.*
std::vector<double> shear_at_nodes(const Communicator& comm, const Mesh& mesh, const Field& solution,
                                   const FlowColumns& columns, const FreeStream& stream,
                                   const std::vector<char>& rough) {
  const HaloMesh halo(comm, mesh);
  const NodesAboveWalls above = nodes_above(halo, rough, mesh.strips);
  std::vector<Point> velocities(halo.points().size());
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    velocities[i] = columns.velocity(solution.row(NodeId{i}));
  halo.exchange().update(velocities);
  const auto coefficients = components_like(solution.names, "Skin_Friction_Coefficient");  // SU2's
  std::vector<double> shear(mesh.owned_nodes, 0.0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    if (length(above.inward[i]) == 0) continue;
    const auto row = solution.row(NodeId{i});
    const Point along = downstream({above.inward[i].y, -above.inward[i].x}, stream);
    if (columns.has_shear()) {
      shear[i] = columns.shear(row);
    } else if (coefficients) {
      const auto [x, y] = *coefficients;
      shear[i] = stream.dynamic_pressure() * dot({row[x], row[y]}, along);
    } else if (above.heights[i] > 0) {
      const Point faster = velocities[above.nodes[i].value()] - velocities[i];
      shear[i] = stream.viscosity * dot(faster, along) / above.heights[i];
    }
  }
  return shear;
}

/// *Collective.*
Field from_nodes(const Communicator& comm, const Mesh& mesh, const Field& solution, const FreeStream& stream,
                 const Walls& walls, const std::string& where) {
  const FlowColumns columns(solution, where);
  const bool viscous = stream.viscosity > 0;
  const std::vector<double> shear =
      viscous ? shear_at_nodes(comm, mesh, solution, columns, stream, walls.rough) : std::vector<double>();
  WallRows rows(mesh, columns.has_density(), viscous);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const auto row = solution.row(NodeId{i});
    rows.add(
        {columns.velocity(row), columns.pressure(row), columns.density(row, stream), viscous ? shear[i] : 0});
  }
  return rows.take();
}

/// A wall edge, by the global numbers of its nodes, with the values of the adjacent cell.
struct CellAtWall {
  std::int64_t from = 0, to = 0;
  double length = 0;
  WallState state;
};

/// Returns the state at the wall of the cell adjacent to the edge.
WallState state_at(const Mesh& mesh, const std::array<NodeId, 2>& edge, const FlowColumns& columns,
                   std::span<const double> row, Point centroid, const FreeStream& stream, bool rough) {
  const Point from = mesh.point(edge[0]), edge_along = mesh.point(edge[1]) - from;
  WallState state{columns.velocity(row), columns.pressure(row), columns.density(row, stream), 0};
  if (!rough) return state;
  const double size = length(edge_along), height = cross(edge_along, centroid - from) / size;
  const Point along = downstream((1 / size) * edge_along, stream);
  state.shear = stream.viscosity * dot(state.velocity, along) / height;
  state.velocity = {};
  return state;
}

/// Returns those of this rank. *Collective.*
std::vector<CellAtWall> cells_at_walls(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                                       const FreeStream& stream, const Walls& walls,
                                       const std::string& where) {
  const FlowColumns columns(cells.names, where);
  const std::vector<std::int64_t> of_boundary = edge_cells(comm, mesh).of_boundary;
  std::vector<std::int64_t> beside;
  auto cell = of_boundary.begin();
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    for (std::size_t e = 0; e < mesh.boundaries[b].edges.size(); ++e, ++cell) {
      if (walls.asked[b] != 0) beside.push_back(*cell);
    }
  }
  std::vector<Point> own_centroids;
  for (const CellShape& shape : cell_shapes(mesh)) own_centroids.push_back(shape.centroid);
  const CellOwners owners(comm, mesh);
  const std::span<const std::int64_t> wanted = beside;
  const std::vector<Point> centroids = rows_of_cells(comm, owners, wanted, own_centroids);
  const std::vector<double> values = rows_of_cells(comm, owners, wanted, cells.values, cells.width());
  std::vector<CellAtWall> at_walls;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    if (walls.asked[b] == 0) continue;
    for (const auto& edge : mesh.boundaries[b].edges) {
      const std::size_t i = at_walls.size();
      const auto row = std::span<const double>(values).subspan(i * cells.width(), cells.width());
      at_walls.push_back({mesh.global(edge[0]).value(), mesh.global(edge[1]).value(),
                          length(mesh.point(edge[1]) - mesh.point(edge[0])),
                          state_at(mesh, edge, columns, row, centroids[i], stream, walls.rough[b] != 0)});
    }
  }
  return at_walls;
}

/// A weighted mean of states.
class MeanState {
 public:
  void add(const WallState& state, double weight) {
    sum_.velocity = sum_.velocity + weight * state.velocity;
    sum_.pressure += weight * state.pressure;
    sum_.density += weight * state.density;
    sum_.shear += weight * state.shear;
    weight_ += weight;
  }
  WallState mean() const {
    return {(1 / weight_) * sum_.velocity, sum_.pressure / weight_, sum_.density / weight_,
            sum_.shear / weight_};
  }

 private:
  WallState sum_;
  double weight_ = 0;
};

/// Interpolates linearly along the wall between the midpoints of the two edges at a node. *Collective.*
Field from_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                 const FreeStream& stream, const Walls& walls, const std::string& where) {
  const std::vector<CellAtWall> own = cells_at_walls(comm, mesh, cells, stream, walls, where);
  std::vector<CellAtWall> all = comm.all_gather_values(std::span<const CellAtWall>(own));
  std::ranges::sort(all, {}, [](const CellAtWall& cell) { return std::pair(cell.from, cell.to); });
  std::map<std::int64_t, MeanState> means;
  for (const CellAtWall& cell : all) {
    for (const std::int64_t node : {cell.from, cell.to}) means[node].add(cell.state, 1 / cell.length);
  }
  const WallState nothing{{}, stream.pressure, stream.density, 0};
  WallRows rows(mesh, FlowColumns(cells.names, where).has_density(), stream.viscosity > 0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const auto found = means.find(mesh.first_node + i);
    rows.add(found == means.end() ? nothing : found->second.mean());
  }
  return rows.take();
}

}  // namespace

std::vector<std::string> walls_of(const Mesh& mesh) {
  std::vector<std::string> walls;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (boundary.condition.is_wall()) walls.push_back(boundary.name);
  }
  return walls;
}

Field wall_flow(const Communicator& comm, const Mesh& mesh, const Field& solution, const FreeStream& stream,
                const std::vector<std::string>& walls, const std::string& where) {
  const Walls which(mesh, walls, stream);
  if (solution.names.empty()) return from_cells(comm, mesh, solution.cells, stream, which, where);
  return from_nodes(comm, mesh, solution, stream, which, where);
}

}  // namespace quadloop::flow
