#include "io/model/clean_up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "io/model/inner_curves.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/model/orient_cells.hpp"
#include "io/model/repeated_rows.hpp"
#include "io/model/serialize_mesh.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

namespace {

using Face = FileBoundary::Face;

/// Sorts cells and their rows of `width` values, which start at `rows`.
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

/// Removes duplicate cells of one kind. Takes their rows from the front of `rows`, and appends those of the
/// remaining cells to `kept_values`.
template <class Cells>
void drop_repeated_cells(Cells& cells, std::vector<std::int32_t>& cell_to_block, std::size_t width,
                         std::span<const std::string> block_names, const GroupSizes& sizes,
                         std::span<const double>& rows, std::vector<double>& kept_values,
                         RepeatedElements& repeated) {
  const auto kept = kept_rows(
      cells, [](const auto& nodes) { return nodes; },
      [&](std::size_t i) { return size_of_group(sizes.of_blocks, cell_to_block[i]); });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto row = rows.subspan(i * width, width);
    if (kept[i] == i) kept_values.insert(kept_values.end(), row.begin(), row.end());
    if (kept[i] != i) ++repeated[{block_names[cell_to_block[kept[i]]], block_names[cell_to_block[i]]}];
  }
  rows = rows.subspan(cells.size() * width);
  keep_rows(cell_to_block, kept);
  keep_rows(cells, kept);
}

void drop_repeated_faces(FileMesh& mesh, const GroupSizes& sizes, RepeatedElements& repeated) {
  struct FaceOfBoundary {
    Face nodes;
    std::int32_t boundary;
    std::size_t place;
  };
  std::vector<FaceOfBoundary> faces;
  for (std::int32_t b = 0; b < std::ssize(mesh.boundaries); ++b) {
    const FileBoundary& boundary = mesh.boundaries[b];
    for (std::size_t i = 0; i < boundary.faces.size(); ++i)
      faces.push_back({boundary.faces[i], b, boundary.places.empty() ? 0 : boundary.places[i]});
  }
  const auto kept = kept_rows(
      faces, [](const FaceOfBoundary& face) { return face.nodes; },
      [&](std::size_t i) { return size_of_group(sizes.of_boundaries, faces[i].boundary); });
  for (FileBoundary& boundary : mesh.boundaries) boundary.faces.clear();
  for (FileBoundary& boundary : mesh.boundaries) boundary.places.clear();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    FileBoundary& boundary = mesh.boundaries[faces[i].boundary];
    if (kept[i] == i) {
      boundary.faces.push_back(faces[i].nodes);
      boundary.places.push_back(faces[i].place);
    } else {
      ++repeated[{mesh.boundaries[faces[kept[i]].boundary].name, boundary.name}];
    }
  }
}

/// Calls `visit(node)` for each node of each cell and of each boundary face.
template <class FileMeshOrConst, class Visit>
void for_each_named_node(FileMeshOrConst& mesh, const Visit& visit) {
  for_each_kind([&]<CellKind kind>() {
    for (auto& nodes : cells_of<kind>(mesh)) std::for_each(nodes.begin(), nodes.end(), visit);
  });
  for (auto& boundary : mesh.boundaries) {
    for (auto& face : boundary.faces) {
      for (auto& node : face) {
        if (node != FileBoundary::no_node) visit(node);
      }
    }
  }
}

/// Returns the lowest of the nodes that are one, and shortens the way to it.
std::int32_t first_among(std::vector<std::int32_t>& first_of, std::int32_t node) {
  while (first_of[node] != node) node = first_of[node] = first_of[first_of[node]];
  return node;
}
void unite(std::vector<std::int32_t>& first_of, std::int32_t a, std::int32_t b) {
  const std::int32_t first = first_among(first_of, a), second = first_among(first_of, b);
  first_of[std::max(first, second)] = std::min(first, second);
}

/// Whether two of the nodes at one position, which are ascending, belong to one zone.
template <class ZoneOf>
bool has_twice(std::span<const std::int32_t> nodes, const ZoneOf& zone_of) {
  return std::ranges::adjacent_find(nodes, {}, zone_of) != nodes.end();
}

/// Keeps the nodes whose `new_id` is not negative, and renumbers all references. The new numbers must be
/// ascending.
void renumber_nodes(FileMesh& mesh, const std::vector<std::int32_t>& new_id) {
  for_each_named_node(mesh, [&](std::int32_t& node) { node = new_id[node]; });
  std::ranges::for_each(mesh.periodic_nodes, [&](std::int32_t& node) { node = new_id[node]; });
  std::erase(mesh.periodic_nodes, -1);
  for (NamedNode& named : mesh.named_nodes) named.node = GlobalNodeId{new_id[named.node.value()]};
  std::erase_if(mesh.named_nodes, [](const NamedNode& named) { return !named.node.valid(); });
}

[[noreturn]] void refuse_edge(const Mesh& mesh, const FileBoundary& boundary, std::size_t number,
                              const TextScanner& scan) {
  const Face& edge = boundary.faces[number];
  const Point a = mesh.point(NodeId{edge[0]}), b = mesh.point(NodeId{edge[1]});
  scan.refuse_at(boundary.places.empty() ? 0 : boundary.places[number],
                 fmt::format("an edge of boundary {}, from ({}, {}) to ({}, {}), belongs to no cell; remove "
                             "it from the boundary, or mesh the surface beside it",
                             boundary.name, a.x, a.y, b.x, b.y));
}

/// Assigns the edges to their boundaries.
void place_edges(const std::vector<FileBoundary>& boundaries, LoadedMesh& loaded, const EdgeTable& table,
                 const TextScanner& scan) {
  for (const FileBoundary& boundary : boundaries) {
    BoundaryEdges outer{boundary.name, boundary.condition, {}, boundary.layers};
    for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
      NodeId from{boundary.faces[i][0]}, to{boundary.faces[i][1]};
      const std::int32_t left = table.cell_left_of(from, to), right = table.cell_left_of(to, from);
      if (left < 0 && right < 0) refuse_edge(loaded.mesh, boundary, i, scan);
      const bool between = left >= 0 && right >= 0;
      if (left < 0 || (between && block_of_cell(loaded, right) < block_of_cell(loaded, left)))
        std::swap(from, to);
      outer.edges.push_back({from, to});
    }
    if (!outer.edges.empty()) loaded.mesh.boundaries.push_back(std::move(outer));
  }
}

void add_outer_boundary(Mesh& mesh) {
  const EdgeTable table(mesh);
  BoundaryEdges outer{"boundary", {}, {}};
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    if (table.cell_left_of(to, from) < 0) outer.edges.push_back({from, to});
  });
  if (!outer.edges.empty()) mesh.boundaries.push_back(std::move(outer));
}

/// Converts the cells of one kind to typed node numbers.
template <std::size_t width>
std::vector<std::array<NodeId, width>> with_ids(const std::vector<std::array<std::int32_t, width>>& cells) {
  std::vector<std::array<NodeId, width>> result;
  result.reserve(cells.size());
  for (const auto& nodes : cells) {
    auto& ids = result.emplace_back();
    std::ranges::transform(nodes, ids.begin(), [](std::int32_t node) { return NodeId{node}; });
  }
  return result;
}

/// Converts everything except the boundaries.
LoadedMesh cells_and_points(FileMesh& file) {
  LoadedMesh loaded;
  Mesh& mesh = loaded.mesh;
  mesh.points.reserve(file.points.size());
  for (const Point3 p : file.points) mesh.points.push_back({p.x, p.y});
  mesh.owned_nodes = size32(mesh.points);
  mesh.triangles = with_ids(file.triangles);
  mesh.quads = with_ids(file.quads);
  mesh.strips = std::move(file.strips);
  mesh.pairs = std::move(file.pairs);
  mesh.named_nodes = std::move(file.named_nodes);
  loaded.triangle_to_block = std::move(file.cell_to_block[0]);
  loaded.quad_to_block = std::move(file.cell_to_block[1]);
  loaded.block_names = std::move(file.block_names);
  loaded.blocks = size32(loaded.block_names);
  for (const std::int32_t node : file.periodic_nodes) loaded.periodic_nodes.push_back(NodeId{node});
  loaded.solution = std::move(file.solution);
  loaded.warnings = std::move(file.warnings);
  return loaded;
}

}  // namespace

void drop_repeated(FileMesh& mesh, const std::string& path, const GroupSizes& sizes) {
  Field none;
  CellValues& values = (mesh.solution ? *mesh.solution : none).cells;
  const std::size_t width = values.width();
  std::span<const double> rows = values.values;
  std::vector<double> kept_values;
  RepeatedElements repeated;
  for_each_kind([&]<CellKind kind>() {
    drop_repeated_cells(cells_of<kind>(mesh), mesh.cell_to_block[static_cast<std::size_t>(kind)], width,
                        mesh.block_names, sizes, rows, kept_values, repeated);
  });
  drop_repeated_faces(mesh, sizes, repeated);
  values.values = std::move(kept_values);
  warn_of_repeated(repeated, path, mesh.warnings);
}

bool refers_to_nodes(const FileMesh& mesh, std::int64_t nodes) {
  bool good = true;
  const auto visit = [&](std::int64_t node) { good = good && node >= 0 && node < nodes; };
  for_each_named_node(mesh, visit);
  std::ranges::for_each(mesh.periodic_nodes, visit);
  for (const NamedNode& named : mesh.named_nodes) visit(named.node.value());
  return good;
}

void require_consistent(const FileMesh& mesh, const std::string& path) {
  const auto is_in = [](std::int64_t number, const auto& list) {
    return number >= 0 && number < std::ssize(list);
  };
  bool good = refers_to_nodes(mesh, std::ssize(mesh.points));
  for_each_kind([&]<CellKind kind>() {
    const std::vector<std::int32_t>& blocks = mesh.cell_to_block[static_cast<std::size_t>(kind)];
    good = good && blocks.size() == cells_of<kind>(mesh).size();
    for (const std::int32_t block : blocks) good = good && is_in(block, mesh.block_names);
  });
  if (mesh.solution) {
    const auto& [names, values, constants, cells] = *mesh.solution;
    good = good && values.size() == names.size() * mesh.points.size() &&
           std::ssize(cells.values) == std::ssize(cells.names) * cell_count(mesh);
  }
  if (!good) throw InputError(path + ": is damaged: what was read from it is no mesh");
}

std::vector<char> used_nodes(const FileMesh& mesh) {
  std::vector<char> is_used(mesh.points.size(), 0);
  for_each_named_node(mesh, [&](std::int32_t node) { is_used[node] = 1; });
  return is_used;
}

void drop_unused_nodes(FileMesh& mesh, const std::string& path) {
  const std::vector<char> is_used = used_nodes(mesh);
  const auto dropped = std::ranges::count(is_used, 0);
  if (dropped == 0) return;
  std::vector<std::int32_t> new_id(is_used.size(), -1);
  std::int32_t kept = 0;
  for (std::size_t node = 0; node < is_used.size(); ++node) {
    if (is_used[node] == 0) continue;
    mesh.points[kept] = mesh.points[node];
    new_id[node] = kept++;
  }
  mesh.points.resize(kept);
  renumber_nodes(mesh, new_id);
  mesh.warnings.push_back(fmt::format("{}: left out {} without a cell", path, counted(dropped, "node")));
}

void unite_nodes(FileMesh& mesh, std::span<const std::size_t> first_nodes, const NodeLinks& links) {
  std::vector<Point3>& points = mesh.points;
  std::vector<std::int32_t> order(points.size()), first_of(points.size()), new_id(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::iota(first_of.begin(), first_of.end(), 0);
  for (const auto& [a, b] : links.nodes) unite(first_of, a, b);
  const auto place = [&](std::int32_t i) { return std::tuple(points[i].x, points[i].y, points[i].z); };
  std::ranges::stable_sort(order, {}, place);
  const auto zone_of = [&](std::size_t node) -> std::size_t {
    return std::ranges::upper_bound(first_nodes, node) - first_nodes.begin() - 1;
  };
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && place(order[last]) == place(order[first])) ++last;
    const std::span here = std::span(order).subspan(first, last - first);
    if (!first_nodes.empty() && has_twice(here, zone_of)) continue;
    for (const std::int32_t node : here.subspan(1)) {
      const auto [low, high] = std::minmax({zone_of(here[0]), zone_of(node)});
      if (first_nodes.empty() || !links.zones.contains({low, high})) unite(first_of, here[0], node);
    }
  }
  Field none;
  Field& solution = mesh.solution ? *mesh.solution : none;
  const auto width = std::ssize(solution.names);
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < std::ssize(points); ++i) {
    if (const std::int32_t first = first_among(first_of, i); first == i) {
      std::copy_n(solution.values.begin() + i * width, width, solution.values.begin() + kept * width);
      points[kept] = points[i];
      new_id[i] = kept++;
    } else {
      new_id[i] = new_id[first];  // the first one comes earlier
    }
  }
  points.resize(kept);
  solution.values.resize(kept * width);
  renumber_nodes(mesh, new_id);
}

void drop_inner_faces(FileMesh& mesh) {
  std::map<Face, int> mentions;
  const auto key_of = [](Face face) {
    std::ranges::sort(face);
    return face;
  };
  for (const FileBoundary& boundary : mesh.boundaries) {
    for (const Face& face : boundary.faces) ++mentions[key_of(face)];
  }
  for (FileBoundary& boundary : mesh.boundaries) {
    const auto is_inner = [&](const Face& face) { return mentions[key_of(face)] > 1; };
    std::erase_if(boundary.faces, is_inner);
    boundary.places.clear();
  }
}

void keep_first_mentions(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  const EdgeTable table(mesh);
  std::set<std::array<NodeId, 2>> taken;
  for (BoundaryEdges& boundary : mesh.boundaries) {
    std::erase_if(boundary.edges, [&](std::array<NodeId, 2>& edge) {
      const std::int32_t left = table.cell_left_of(edge[0], edge[1]),
                         right = table.cell_left_of(edge[1], edge[0]);
      if (left < 0 || right < 0) return false;
      if (block_of_cell(loaded, right) < block_of_cell(loaded, left)) std::swap(edge[0], edge[1]);
      return !taken.insert(edge).second;
    });
  }
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
}

void drop_empty_groups(FileMesh& mesh) {
  std::vector<std::int32_t> new_number(mesh.block_names.size(), -1);
  for (const auto& blocks : mesh.cell_to_block) {
    for (const std::int32_t block : blocks) new_number[block] = 0;
  }
  std::int32_t kept = 0;
  for (std::size_t block = 0; block < new_number.size(); ++block) {
    if (new_number[block] < 0) continue;
    new_number[block] = kept;
    std::swap(mesh.block_names[kept++], mesh.block_names[block]);
  }
  mesh.block_names.resize(kept);
  for (auto& blocks : mesh.cell_to_block) {
    for (std::int32_t& block : blocks) block = new_number[block];
  }
  std::erase_if(mesh.boundaries, [](const FileBoundary& boundary) { return boundary.faces.empty(); });
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

LoadedMesh plane_mesh(FileMesh file, const TextScanner& scan) {
  if (file.triangles.empty() && file.quads.empty())
    scan.refuse("the file has no triangle and no quadrilateral; a mesh needs cells");
  drop_empty_groups(file);
  LoadedMesh loaded = cells_and_points(file);
  const std::int64_t turned = orient_cells(loaded.mesh);
  order_by_blocks(loaded);
  const EdgeTable table(loaded.mesh);
  place_edges(file.boundaries, loaded, table, scan);
  if (turned > 0)
    loaded.warnings.push_back(
        fmt::format("{}: reversed {} with clockwise nodes", scan.path(), counted(turned, "cell")));
  separate_inner_curves(loaded, table, scan.path());
  if (loaded.mesh.boundaries.empty()) add_outer_boundary(loaded.mesh);
  return loaded;
}

LoadedMesh loaded_mesh_of(FileMesh file) {
  LoadedMesh loaded = cells_and_points(file);
  for (const FileBoundary& boundary : file.boundaries) {
    loaded.mesh.boundaries.push_back({boundary.name, boundary.condition, {}, boundary.layers});
    for (const Face& edge : boundary.faces)
      loaded.mesh.boundaries.back().edges.push_back({NodeId{edge[0]}, NodeId{edge[1]}});
  }
  return loaded;
}

FileMesh file_mesh_of(const LoadedMesh& loaded) {
  FileMesh file;
  file.dimension = 2;
  for (const Point p : loaded.mesh.points) file.points.push_back({p.x, p.y, 0});
  const auto nodes_of = [](const auto& ids) {
    std::array<std::int32_t, std::tuple_size_v<std::decay_t<decltype(ids)>>> nodes;
    std::ranges::transform(ids, nodes.begin(), [](NodeId id) { return id.value(); });
    return nodes;
  };
  for (const std::string& block : loaded.block_names) file.block_named(block);
  for (std::size_t i = 0; i < loaded.mesh.triangles.size(); ++i)
    add_cell<CellKind::triangle>(file, nodes_of(loaded.mesh.triangles[i]), loaded.triangle_to_block[i]);
  for (std::size_t i = 0; i < loaded.mesh.quads.size(); ++i)
    add_cell<CellKind::quad>(file, nodes_of(loaded.mesh.quads[i]), loaded.quad_to_block[i]);
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) {
    FileBoundary& own = file.boundaries[file.boundary_named(boundary.name)];
    own.condition = boundary.condition;
    own.layers = boundary.layers;
    for (const auto& [from, to] : boundary.edges)
      own.faces.push_back({from.value(), to.value(), FileBoundary::no_node, FileBoundary::no_node});
  }
  for (const NodeId node : loaded.periodic_nodes) file.periodic_nodes.push_back(node.value());
  file.solution = loaded.solution;
  file.strips = loaded.mesh.strips;
  file.pairs = loaded.mesh.pairs;
  file.named_nodes = loaded.mesh.named_nodes;
  file.warnings = loaded.warnings;
  return file;
}

}  // namespace quadloop::io
