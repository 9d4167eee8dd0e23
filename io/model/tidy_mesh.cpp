#include "io/model/tidy_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/model/inner_curves.hpp"
#include "io/model/orient_cells.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

namespace {

/// Calls `visit(node)` for the nodes of all cells, and of all boundary edges.
template <class Visit>
void for_each_named_node(Mesh& mesh, const Visit& visit) {
  mesh.for_each_cell([&](auto& nodes) { std::for_each(nodes.begin(), nodes.end(), visit); });
  for (BoundaryEdges& boundary : mesh.boundaries) {
    for (auto& edge : boundary.edges) std::for_each(edge.begin(), edge.end(), visit);
  }
}

void move_row(Field& solution, std::size_t from, std::size_t to) {
  const std::size_t width = solution.names.size();
  if (from != to)
    std::copy_n(solution.values.begin() + from * width, width, solution.values.begin() + to * width);
}

/// Renumbers strips; a strip with a node that has no cell is removed.
void renumber_strips(const IdVector<NodeId, NodeId>& new_id, std::vector<StripLayers>& strips) {
  const auto number = [&](GlobalNodeId node) {
    return new_id[NodeId{static_cast<std::int32_t>(node.value())}];
  };
  std::erase_if(strips, [&](const StripLayers& strip) {
    return std::ranges::any_of(strip.nodes, [&](GlobalNodeId node) { return !number(node).valid(); });
  });
  for (StripLayers& strip : strips) {
    for (GlobalNodeId& node : strip.nodes) node = GlobalNodeId{number(node).value()};
  }
}

/// Renumbers named nodes; those without cells are removed.
void renumber_named_nodes(const IdVector<NodeId, NodeId>& new_id, std::vector<NamedNode>& nodes) {
  for (NamedNode& named : nodes)
    named.node = GlobalNodeId{new_id[NodeId{static_cast<std::int32_t>(named.node.value())}].value()};
  std::erase_if(nodes, [](const NamedNode& named) { return !named.node.valid(); });
}

/// Inner curves consist of cell edges, but a periodic node may have lost its cells.
void renumber_flags(const IdVector<NodeId, NodeId>& new_id, LoadedMesh& loaded) {
  for (BoundaryEdges& curve : loaded.inner_curves) {
    for (auto& edge : curve.edges) edge = {new_id[edge[0]], new_id[edge[1]]};
  }
  for (NodeId& node : loaded.periodic_nodes) node = new_id[node];
  std::erase_if(loaded.periodic_nodes, [](NodeId node) { return !node.valid(); });
}

/// A node that only a boundary edge uses is kept: the error is in the edge, not in the node.
std::size_t drop_unused_nodes(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  IdVector<NodeId, NodeId> new_id(mesh.points.size());
  for_each_named_node(mesh, [&](NodeId& node) { new_id[node] = node; });
  std::int32_t kept = 0;
  for (const NodeId node : new_id.ids()) {
    if (!new_id[node].valid()) continue;
    mesh.points[kept] = mesh.point(node);
    if (loaded.solution) move_row(*loaded.solution, node.value(), kept);
    new_id[node] = NodeId{kept++};
  }
  const std::size_t dropped = mesh.points.size() - kept;
  if (dropped == 0) return 0;
  for_each_named_node(mesh, [&](NodeId& node) { node = new_id[node]; });
  renumber_strips(new_id, mesh.strips);
  renumber_named_nodes(new_id, mesh.named_nodes);
  renumber_flags(new_id, loaded);
  mesh.points.resize(kept);
  mesh.owned_nodes = kept;
  if (loaded.solution) loaded.solution->values.resize(kept * loaded.solution->names.size());
  return dropped;
}

/// An edge between two blocks may have either direction.
std::int64_t turn_edges(Mesh& mesh, const EdgeTable& table) {
  std::int64_t turned = 0;
  for (BoundaryEdges& boundary : mesh.boundaries) {
    for (auto& [from, to] : boundary.edges) {
      if (table.cell_left_of(from, to) >= 0 || table.cell_left_of(to, from) < 0) continue;
      std::swap(from, to);
      ++turned;
    }
  }
  return turned;
}

std::string free_name(const Mesh& mesh) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(mesh.boundaries.begin(), mesh.boundaries.end(),
                       [&](const BoundaryEdges& b) { return b.name == name; });
  };
  std::string name = "boundary";
  for (int number = 2; taken(name); ++number) name = fmt::format("boundary_{}", number);
  return name;
}

std::size_t add_missing_boundary(Mesh& mesh, const EdgeTable& table) {
  std::vector<std::array<NodeId, 2>> named;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    named.insert(named.end(), boundary.edges.begin(), boundary.edges.end());
  std::sort(named.begin(), named.end());
  BoundaryEdges missing{free_name(mesh), {}, {}};
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    const bool outer = table.cell_left_of(to, from) < 0;
    if (outer && !std::binary_search(named.begin(), named.end(), std::array{from, to}))
      missing.edges.push_back({from, to});
  });
  const std::size_t added = missing.edges.size();
  if (added > 0) mesh.boundaries.push_back(std::move(missing));
  return added;
}

}  // namespace

void tidy_mesh(LoadedMesh& loaded, const std::string& path) {
  Mesh& mesh = loaded.mesh;
  const auto warn = [&](auto count, const char* done, const char* noun, const std::string& rest) {
    if (count > 0)
      loaded.warnings.push_back(fmt::format("{}: {} {} {}", path, done, counted(count, noun), rest));
  };
  warn(drop_unused_nodes(loaded), "left out", "node", "without a cell");
  EdgeTable table(mesh);
  if (!surely_oriented(mesh, table)) {
    warn(orient_cells(mesh), "reversed", "cell", "with clockwise nodes");
    table = EdgeTable(mesh);
  }
  warn(turn_edges(mesh, table), "reversed", "boundary edge", "with the cell to the right");
  warn(std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); }),
       "left out", "named boundary curve", "without edges");
  separate_inner_curves(loaded, table, path);
  const std::size_t added = add_missing_boundary(mesh, table);
  if (added > 0)
    warn(added, "added", "outer edge",
         fmt::format("without a boundary, as boundary \"{}\"", mesh.boundaries.back().name));
}

}  // namespace quadloop::io
