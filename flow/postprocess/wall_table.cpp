#include "flow/postprocess/wall_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "flow/postprocess/flow_quantities.hpp"
#include "flow/postprocess/nodes_above_walls.hpp"
#include "flow/postprocess/wall_walk.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::flow {

namespace {

/// A node's row of the table.
struct WallRow {
  std::int64_t number = 0;
  double pressure_coefficient = 0, mach = 0, friction_coefficient = 0, y_plus = 0;
};

/// Returns all ranks' nodes on the walls, by their global numbers.
std::unordered_map<std::int64_t, WallRow> rows_of(const Communicator& comm, const Mesh& mesh,
                                                  const Field& flow, const FreeStream& stream,
                                                  const std::vector<char>& is_wall) {
  const HaloMesh halo(comm, mesh);
  std::vector<WallRow> own;
  comm.together([&] {
    const FlowColumns columns(flow, "the flow");
    std::vector<char> wanted(mesh.owned_nodes, 0);
    for (const HaloEdge& edge : halo.boundary_edges()) {
      for (const NodeId node : {edge.from, edge.to}) {
        if (is_wall[edge.boundary] != 0 && halo.owns(node)) wanted[node.value()] = 1;
      }
    }
    const NodesAboveWalls above =
        stream.viscosity > 0 ? nodes_above(halo, is_wall, mesh.strips) : NodesAboveWalls{};
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      const NodeId node{i};
      if (wanted[node.value()] == 0) continue;
      const auto values = flow.row(node);
      WallRow row{mesh.global(node).value(), pressure_coefficient(columns.pressure(values), stream),
                  columns.mach(values, stream.gamma)};
      if (stream.viscosity > 0) {
        const double shear = columns.shear(values), density = columns.density(values, stream);
        row.friction_coefficient = stream.speed > 0 ? shear / stream.dynamic_pressure() : 0;
        row.y_plus = above.heights[node.value()] * std::sqrt(density * std::abs(shear)) / stream.viscosity;
      }
      own.push_back(row);
    }
  });
  std::unordered_map<std::int64_t, WallRow> rows;
  for (const WallRow& row : comm.all_gather_values(std::span<const WallRow>(own))) rows[row.number] = row;
  return rows;
}

/// Returns all ranks' edges of a boundary, in the order of ranks.
std::vector<WallEdge> edges_of(const Communicator& comm, const Mesh& mesh, const BoundaryEdges& boundary) {
  std::vector<WallEdge> own;
  const auto node_at = [&](NodeId node) { return WallNode{mesh.global(node).value(), mesh.point(node)}; };
  for (const auto& [from, to] : boundary.edges) own.push_back({node_at(from), node_at(to)});
  return comm.all_gather_values(std::span<const WallEdge>(own));
}

/// Appends the shortest text that reads back to the same double.
void append(std::string& text, double value, char before) {
  std::array<char, 32> digits{};
  text += before;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// Quotes a field if it contains separators.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

void append_chain(std::string& text, const std::string& name, const std::vector<WallNode>& chain,
                  const std::unordered_map<std::int64_t, WallRow>& rows, bool viscous) {
  double along = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i > 0) along += length(chain[i].at - chain[i - 1].at);
    const WallRow& row = rows.at(chain[i].number);
    text += name;
    for (const double value : {along, chain[i].at.x, chain[i].at.y, row.pressure_coefficient, row.mach})
      append(text, value, ',');
    if (viscous) {
      append(text, row.friction_coefficient, ',');
      append(text, row.y_plus, ',');
    }
    text += '\n';
  }
}

}  // namespace

std::string wall_table(const Communicator& comm, const Mesh& mesh, const Field& flow,
                       const FreeStream& stream, const std::vector<std::string>& walls) {
  std::vector<char> is_wall;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    is_wall.push_back(std::ranges::find(walls, boundary.name) != walls.end() ? 1 : 0);
  const auto rows = rows_of(comm, mesh, flow, stream, is_wall);
  const bool viscous = stream.viscosity > 0;
  std::string text = viscous ? "boundary,s,x,y,Cp,Mach,Cf,y+\n" : "boundary,s,x,y,Cp,Mach\n";
  for (const std::string& wall : walls) {
    for (const BoundaryEdges& boundary : mesh.boundaries) {
      if (boundary.name != wall) continue;
      const std::vector<WallEdge> edges = edges_of(comm, mesh, boundary);
      if (!comm.is_root()) continue;
      for (const auto& chain : walk(edges)) append_chain(text, quoted(wall), chain, rows, viscous);
    }
  }
  return comm.is_root() ? text : std::string();
}

}  // namespace quadloop::flow
