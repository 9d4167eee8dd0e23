#include "io/loaded/foreign_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "io/loaded/orient_cells.hpp"
#include "io/loaded/repeated_rows.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// With the rows of `width` values that begin at `rows`.
template <class Cells>
void sort_by_block(Cells& cells, std::vector<std::int32_t>& cell_to_block, std::vector<double>::iterator rows,
                   std::size_t width) {
  if (std::is_sorted(cell_to_block.begin(), cell_to_block.end())) return;
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cell_to_block[a] < cell_to_block[b]; });
  Cells sorted;
  sorted.reserve(cells.size());
  for (const std::size_t cell : order) sorted.push_back(cells[cell]);
  cells = std::move(sorted);
  std::vector<double> sorted_rows;
  for (const std::size_t cell : order)
    sorted_rows.insert(sorted_rows.end(), rows + cell * width, rows + (cell + 1) * width);
  std::ranges::copy(sorted_rows, rows);
  std::sort(cell_to_block.begin(), cell_to_block.end());
}

std::int64_t size_of_group(const std::vector<std::int64_t>& sizes, std::int32_t group) {
  return group < std::ssize(sizes) ? sizes[group] : 0;
}

/// The rows of values of those that stay are appended to `kept_values`.
template <class Cells>
void drop_repeated_cells(Cells& cells, std::vector<std::int32_t>& cell_to_block, const LoadedMesh& loaded,
                         const GroupSizes& sizes, std::span<const double> rows,
                         std::vector<double>& kept_values, RepeatedElements& repeated) {
  const auto kept = kept_rows(
      cells, [](const auto& nodes) { return nodes; },
      [&](std::size_t i) { return size_of_group(sizes.of_blocks, cell_to_block[i]); });
  const std::size_t width = cells.empty() ? 0 : rows.size() / cells.size();
  const auto name = [&](std::size_t i) { return loaded.block_names[cell_to_block[i]]; };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto row = rows.subspan(i * width, width);
    if (kept[i] == i) kept_values.insert(kept_values.end(), row.begin(), row.end());
    if (kept[i] != i) ++repeated[{name(kept[i]), name(i)}];
  }
  keep_rows(cell_to_block, kept);
  keep_rows(cells, kept);
}

std::int32_t block_of(const LoadedMesh& loaded, std::int32_t cell) {
  const std::size_t at = cell;
  const std::size_t triangles = loaded.triangle_to_block.size();
  return at < triangles ? loaded.triangle_to_block[at] : loaded.quad_to_block[at - triangles];
}

/// A block whose every element stood in another one too has no cells.
void drop_empty_blocks(LoadedMesh& loaded) {
  std::vector<std::int32_t> new_number(loaded.block_names.size(), -1);
  for (const auto* cell_to_block : {&loaded.triangle_to_block, &loaded.quad_to_block}) {
    for (const std::int32_t block : *cell_to_block) new_number[block] = 0;
  }
  std::int32_t kept = 0;
  for (std::size_t block = 0; block < new_number.size(); ++block) {
    if (new_number[block] < 0) continue;
    new_number[block] = kept;
    std::swap(loaded.block_names[kept++], loaded.block_names[block]);
  }
  loaded.block_names.resize(kept);
  loaded.blocks = kept;
  for (auto* cell_to_block : {&loaded.triangle_to_block, &loaded.quad_to_block}) {
    for (std::int32_t& block : *cell_to_block) block = new_number[block];
  }
}

[[noreturn]] void refuse_edge(const ForeignMesh& foreign, const ForeignEdge& edge, const TextScanner& scan) {
  const Mesh& mesh = foreign.loaded.mesh;
  const Point a = mesh.point(edge.nodes[0]), b = mesh.point(edge.nodes[1]);
  const std::string& name = mesh.boundaries[edge.boundary].name;
  scan.refuse_at(edge.place, fmt::format("an edge of boundary {}, from ({}, {}) to ({}, {}), belongs to no "
                                         "cell; take it out of the boundary, "
                                         "or mesh the surface beside it",
                                         name, a.x, a.y, b.x, b.y));
}

/// Gives the edges to their boundaries, or to inner curves of the same names where they lie inside a block.
void place_edges(ForeignMesh& foreign, const TextScanner& scan) {
  LoadedMesh& loaded = foreign.loaded;
  const EdgeTable table(loaded.mesh);
  std::vector<BoundaryEdges> inner(loaded.mesh.boundaries.size());
  for (const ForeignEdge& edge : foreign.edges) {
    auto [from, to] = edge.nodes;
    const std::int32_t left = table.cell_left_of(from, to), right = table.cell_left_of(to, from);
    if (left < 0 && right < 0) refuse_edge(foreign, edge, scan);
    const bool between = left >= 0 && right >= 0;
    if (between && block_of(loaded, left) == block_of(loaded, right)) {
      inner[edge.boundary].edges.push_back(edge.nodes);
      continue;
    }
    if (left < 0 || (between && block_of(loaded, right) < block_of(loaded, left))) std::swap(from, to);
    loaded.mesh.boundaries[edge.boundary].edges.push_back({from, to});
  }
  for (std::size_t b = 0; b < inner.size(); ++b) {
    if (inner[b].edges.empty()) continue;
    inner[b].name = loaded.mesh.boundaries[b].name;
    loaded.inner_curves.push_back(std::move(inner[b]));
  }
}

void warn_of_inner_curves(LoadedMesh& loaded, const std::string& path) {
  std::vector<std::string> names;
  std::size_t count = 0;
  for (const BoundaryEdges& curve : loaded.inner_curves) {
    names.push_back(curve.name);
    count += curve.edges.size();
  }
  if (names.empty()) return;
  loaded.warnings.push_back(
      fmt::format("{}: {} edges between two cells are no boundary and were left out: those of {}", path,
                  count, some_names(names)));
}

void add_outer_boundary(Mesh& mesh) {
  const EdgeTable table(mesh);
  BoundaryEdges outer{"boundary", "none", {}};
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    if (table.cell_left_of(to, from) < 0) outer.edges.push_back({from, to});
  });
  if (!outer.edges.empty()) mesh.boundaries.push_back(std::move(outer));
}

}  // namespace

std::int32_t ForeignMesh::boundary_named(const std::string& name) {
  const auto [number, is_new] = boundary_names.entry_of(name);
  if (is_new) loaded.mesh.boundaries.push_back({name, "none", {}});
  return number;
}

std::int32_t ForeignMesh::block_named(const std::string& name) {
  const auto [number, is_new] = block_names.entry_of(name);
  if (is_new) loaded.block_names.push_back(name);
  return number;
}

void drop_repeated(ForeignMesh& foreign, const std::string& path, const GroupSizes& sizes) {
  LoadedMesh& loaded = foreign.loaded;
  Mesh& mesh = loaded.mesh;
  Field none;
  CellValues& values = (loaded.solution ? *loaded.solution : none).cells;
  const std::span<const double> rows = values.values;
  const std::size_t quad_rows = mesh.triangles.size() * values.width();
  std::vector<double> kept_values;
  RepeatedElements repeated;
  drop_repeated_cells(mesh.triangles, loaded.triangle_to_block, loaded, sizes, rows.first(quad_rows),
                      kept_values, repeated);
  drop_repeated_cells(mesh.quads, loaded.quad_to_block, loaded, sizes, rows.subspan(quad_rows), kept_values,
                      repeated);
  auto& edges = foreign.edges;
  const auto kept = kept_rows(
      edges, [](const ForeignEdge& edge) { return edge.nodes; },
      [&](std::size_t i) { return size_of_group(sizes.of_boundaries, edges[i].boundary); });
  const auto name = [&](std::size_t i) { return mesh.boundaries[edges[i].boundary].name; };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (kept[i] != i) ++repeated[{name(kept[i]), name(i)}];
  }
  keep_rows(edges, kept);
  values.values = std::move(kept_values);
  warn_of_repeated(repeated, path, loaded.warnings);
}

void drop_unused_nodes(ForeignMesh& foreign, const std::string& path) {
  Mesh& mesh = foreign.loaded.mesh;
  IdVector<NodeId, NodeId> new_id(mesh.points.size());
  const auto note_used = [&](NodeId& node) { new_id[node] = node; };
  const auto renumber = [&](NodeId& node) { node = new_id[node]; };
  const auto for_each_node = [&](const auto& visit) {
    for (auto& nodes : mesh.triangles) std::for_each(nodes.begin(), nodes.end(), visit);
    for (auto& nodes : mesh.quads) std::for_each(nodes.begin(), nodes.end(), visit);
    for (ForeignEdge& edge : foreign.edges) std::for_each(edge.nodes.begin(), edge.nodes.end(), visit);
  };
  for_each_node(note_used);
  std::int32_t kept = 0;
  for (const NodeId node : new_id.ids()) {
    if (!new_id[node].valid()) continue;
    new_id[node] = NodeId{kept};
    mesh.points[kept++] = mesh.point(node);
  }
  const std::size_t dropped = mesh.points.size() - kept;
  if (dropped == 0) return;
  mesh.points.resize(kept);
  for_each_node(renumber);
  std::ranges::for_each(foreign.loaded.periodic_nodes, renumber);
  std::erase_if(foreign.loaded.periodic_nodes, [](NodeId node) { return !node.valid(); });
  foreign.loaded.warnings.push_back(
      fmt::format("{}: {} nodes that belong to no cell were left out", path, dropped));
}

void order_by_blocks(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  if (!loaded.solution) loaded.solution.emplace();
  CellValues& values = loaded.solution->cells;
  const std::size_t width = values.width();
  sort_by_block(mesh.triangles, loaded.triangle_to_block, values.values.begin(), width);
  sort_by_block(mesh.quads, loaded.quad_to_block, values.values.begin() + mesh.triangles.size() * width,
                width);
  if (loaded.solution->empty()) loaded.solution.reset();
}

LoadedMesh finish(ForeignMesh foreign, const TextScanner& scan) {
  LoadedMesh& loaded = foreign.loaded;
  Mesh& mesh = loaded.mesh;
  if (mesh.triangles.empty() && mesh.quads.empty())
    scan.refuse("the file has no triangle and no quadrilateral; a mesh needs cells");
  mesh.owned_nodes = size32(mesh.points);
  drop_empty_blocks(loaded);
  const std::int64_t turned = orient_cells(mesh);
  order_by_blocks(loaded);
  place_edges(foreign, scan);
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
  if (mesh.boundaries.empty()) add_outer_boundary(mesh);
  if (turned > 0)
    loaded.warnings.push_back(fmt::format("{}: {} cells ran clockwise and were turned", scan.path(), turned));
  warn_of_inner_curves(loaded, scan.path());
  return std::move(loaded);
}

}  // namespace quadloop
