#include "io/solution_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/check/compare_meshes.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop {

namespace {

void require_values(const LoadedMesh& loaded, const std::string& path) {
  if (loaded.solution && !loaded.solution->empty()) return;
  throw InputError(path + ": holds a mesh without a solution; " + format_of(path)->without_values);
}

/// Finite, and so small that differences, squares and integrals over the mesh are finite too.
void require_usable(const std::vector<std::string>& names, const std::vector<double>& values,
                    const std::string& place, const std::string& path) {
  constexpr double largest = 1e150;
  const std::size_t width = names.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (std::fabs(value) <= largest) continue;
    const std::string fault = std::isfinite(value) ? fmt::format("is beyond {}", largest) : "is not finite";
    throw InputError(
        fmt::format("{}: {} {} at {} {}: {}", path, names[i % width], fault, place, i / width + 1, value));
  }
}

/// Empty where the cells are the same, in whatever order.
template <std::size_t width>
std::string cell_difference(const std::string& kind, const std::vector<std::array<NodeId, width>>& found,
                            const std::vector<std::array<NodeId, width>>& wanted) {
  if (found.size() != wanted.size())
    return fmt::format("has {} {}, the mesh {}; it is a solution of another mesh; solve on this one",
                       found.size(), kind, wanted.size());
  const auto other = other_cell(found, wanted);
  if (!other) return {};
  std::string nodes;
  for (const NodeId node : *other) nodes += (nodes.empty() ? "" : " ") + std::to_string(node.value() + 1);
  return fmt::format(
      "of its {} the one of nodes {} is not the mesh's; it is a solution of another mesh; solve on this one",
      kind, nodes);
}

/// `points` are as many as `nodes`, or none where they are not known.
std::string node_difference(std::int64_t nodes, const std::vector<Point>& points, const Mesh& mesh) {
  if (nodes != std::ssize(mesh.points)) {
    return fmt::format(
        "holds values at {} nodes, the mesh has {}; it is a solution of another mesh; solve on this one",
        nodes, mesh.points.size());
  }
  if (points.empty()) return {};
  const NodeFlags elsewhere = nodes_elsewhere(points, mesh);
  const auto first = std::find(elsewhere.begin(), elsewhere.end(), 1);
  if (first == elsewhere.end()) return {};
  const std::size_t i = first - elsewhere.begin();
  const Point p = points[i], wanted = mesh.points[i];
  return fmt::format(
      "node {} lies at ({}, {}), in the mesh at ({}, {}); it is a solution of another mesh, or its rows are "
      "in another order; solve on this mesh "
      "and keep its order of nodes",
      i + 1, p.x, p.y, wanted.x, wanted.y);
}

LoadedSolution read_with_mesh(const std::string& path) {
  LoadedMesh loaded = read_mesh(path);
  require_values(loaded, path);
  LoadedSolution result{path, *std::exchange(loaded.solution, {}), std::ssize(loaded.mesh.points), {}, {}};
  result.mesh = std::move(loaded);
  return result;
}

}  // namespace

LoadedSolution read_solution(const std::string& path) {
  require_solution_suffix(path);
  const auto read_solution_alone = format_of(path)->read_solution;
  LoadedSolution result = read_solution_alone != nullptr ? read_solution_alone(path) : read_with_mesh(path);
  Field& solution = result.solution;
  std::vector<std::string*> names;
  append_names(solution, names);
  clean_names(names, path);
  solution.names = distinct_words(solution.names, path);
  solution.cells.names = distinct_words(solution.cells.names, path);
  require_usable(solution.names, solution.values, "node", path);
  require_usable(solution.cells.names, solution.cells.values, "cell", path);
  return result;
}

void require_solution_suffix(const std::string& path) {
  const FileFormat* format = format_of(path);
  if (format != nullptr && format->holds(Content::solution)) return;
  throw InputError(path + ": no solution is read from the format '" + suffix_of(path) + "'; give a " +
                   suffixes_for({Content::solution}) + " file");
}

std::string difference(const Mesh& found, const Mesh& whole) {
  std::string text = node_difference(std::ssize(found.points), found.points, whole);
  if (text.empty()) text = cell_difference("triangles", found.triangles, whole.triangles);
  if (text.empty()) text = cell_difference("quads", found.quads, whole.quads);
  return text;
}

void require_same_mesh(const LoadedSolution& solution, const Mesh& whole) {
  const std::string found = solution.mesh ? difference(solution.mesh->mesh, whole)
                                          : node_difference(solution.nodes, solution.points, whole);
  if (!found.empty()) throw InputError(solution.path + ": " + found);
}

}  // namespace quadloop
