#include "io/solution_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/topology.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

void require_values(const LoadedMesh& loaded, const std::string& path) {
  if (loaded.solution && !loaded.solution->names.empty()) return;
  throw InputError(path + ": holds a mesh without a solution; " + format_of(path)->without_values);
}

/// Finite, and so small that differences, squares and integrals over the mesh are finite too.
void require_usable(const Field& solution, const std::string& path) {
  constexpr double largest = 1e150;
  const std::size_t width = solution.names.size();
  for (std::size_t i = 0; i < solution.values.size(); ++i) {
    const double value = solution.values[i];
    if (std::fabs(value) <= largest) continue;
    const std::string fault = std::isfinite(value) ? fmt::format("is beyond {}", largest) : "is not finite";
    throw InputError(fmt::format("{}: {} {} at node {}: {}", path, solution.names[i % width], fault,
                                 i / width + 1, value));
  }
}

/// The cells with the nodes of each in ascending order, and so the cells: the same list for the same cells.
template <std::size_t width>
std::vector<std::array<NodeId, width>> in_one_order(std::vector<std::array<NodeId, width>> cells) {
  for (auto& nodes : cells) std::sort(nodes.begin(), nodes.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// Empty where the cells are the same, in whatever order.
template <std::size_t width>
std::string cell_difference(const std::string& kind, const std::vector<std::array<NodeId, width>>& found,
                            const std::vector<std::array<NodeId, width>>& wanted) {
  if (found.size() != wanted.size())
    return fmt::format("has {} {}, the mesh {}; it is a solution of another mesh; solve on this one",
                       found.size(), kind, wanted.size());
  const auto of_file = in_one_order(found), of_mesh = in_one_order(wanted);
  const auto [at_file, at_mesh] = std::mismatch(of_file.begin(), of_file.end(), of_mesh.begin());
  if (at_file == of_file.end()) return {};
  std::string nodes;
  for (const NodeId node : *at_file) nodes += (nodes.empty() ? "" : " ") + std::to_string(node.value() + 1);
  return fmt::format(
      "of its {} the one of nodes {} is not the mesh's; it is a solution of another mesh; solve on this one",
      kind, nodes);
}

/// The shortest edge at each node, squared.
IdVector<NodeId, double> shortest_edges(const Mesh& mesh) {
  IdVector<NodeId, double> shortest(mesh.points.size(), std::numeric_limits<double>::infinity());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    const Point along = mesh.point(to) - mesh.point(from);
    for (const NodeId node : {from, to}) {
      double& least = shortest[node];
      least = std::min(least, dot(along, along));
    }
  });
  return shortest;
}

std::string place_difference(const LoadedSolution& solution, const Mesh& mesh) {
  const NodeFlags elsewhere = nodes_elsewhere(solution.points, mesh);
  const auto first = std::find(elsewhere.begin(), elsewhere.end(), 1);
  if (first == elsewhere.end()) return {};
  const std::size_t i = first - elsewhere.begin();
  const Point p = solution.points[i], wanted = mesh.points[i];
  return fmt::format(
      "node {} lies at ({}, {}), in the mesh at ({}, {}); it is a solution of another mesh, or its rows are "
      "in another order; solve on this mesh "
      "and keep its order of nodes",
      i + 1, p.x, p.y, wanted.x, wanted.y);
}

LoadedSolution read_with_mesh(const std::string& path) {
  LoadedMesh loaded = read_mesh(path);
  require_values(loaded, path);
  LoadedSolution result{path, std::move(*loaded.solution), std::ssize(loaded.mesh.points), {}, true, {}, {}};
  result.points = std::move(loaded.mesh.points);
  result.triangles = std::move(loaded.mesh.triangles);
  result.quads = std::move(loaded.mesh.quads);
  return result;
}

}  // namespace

LoadedSolution read_solution(const std::string& path) {
  require_solution_suffix(path);
  const auto read_alone = format_of(path)->read_solution;
  LoadedSolution result = read_alone != nullptr ? read_alone(path) : read_with_mesh(path);
  result.solution.names = distinct_words(result.solution.names, path);
  require_usable(result.solution, path);
  return result;
}

void require_solution_suffix(const std::string& path) {
  const FileFormat* format = format_of(path);
  if (format != nullptr && format->holds(Content::solution)) return;
  throw InputError(path + ": no solution is read from the format '" +
                   std::filesystem::path(path).extension().string() + "'; give a " +
                   suffixes_for({Content::solution}) + " file");
}

NodeFlags nodes_elsewhere(const std::vector<Point>& points, const Mesh& mesh) {
  const IdVector<NodeId, double> shortest = shortest_edges(mesh);
  NodeFlags elsewhere(points.size(), 0);
  for (const NodeId node : elsewhere.ids()) {
    const Point way = points[node.value()] - mesh.point(node);
    elsewhere[node] = dot(way, way) <= solution_tolerance * solution_tolerance * shortest[node] ? 0 : 1;
  }
  return elsewhere;
}

bool same_cells_in_any_order(const Mesh& one, const Mesh& other) {
  return in_one_order(one.triangles) == in_one_order(other.triangles) &&
         in_one_order(one.quads) == in_one_order(other.quads);
}

std::string difference(const LoadedSolution& solution, const Mesh& whole) {
  if (solution.nodes != std::ssize(whole.points)) {
    return fmt::format(
        "holds values at {} nodes, the mesh has {}; it is a solution of another mesh; solve on this one",
        solution.nodes, whole.points.size());
  }
  std::string found = solution.points.empty() ? "" : place_difference(solution, whole);
  if (!solution.has_cells) return found;
  if (found.empty()) found = cell_difference("triangles", solution.triangles, whole.triangles);
  if (found.empty()) found = cell_difference("quads", solution.quads, whole.quads);
  return found;
}

void require_same_mesh(const LoadedSolution& solution, const Mesh& whole) {
  const std::string found = difference(solution, whole);
  if (!found.empty()) throw InputError(solution.path + ": " + found);
}

}  // namespace quadloop
