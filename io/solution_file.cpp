#include "io/solution_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/check/compare_meshes.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

void require_values(const LoadedMesh& loaded, const std::string& path) {
  if (loaded.solution && !loaded.solution->empty()) return;
  throw InputError(path + ": holds a mesh without a solution; " + format_of(path)->without_values);
}

/// Values must be finite, and so small that differences, squares and integrals over the mesh are finite too.
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
  if (format != nullptr && format->holds(Content::solution) && format->is_read()) return;
  throw InputError(path + ": no solution is read from the format '" + suffix_of(path) + "'; give a " +
                   read_suffixes_for({Content::solution}) + " file");
}

void require_same_mesh(const LoadedSolution& solution, const Mesh& whole) {
  const std::string found = solution.mesh ? difference(solution.mesh->mesh, whole)
                                          : node_difference(solution.nodes, solution.points, whole);
  if (!found.empty()) throw InputError(solution.path + ": " + found);
}

}  // namespace quadloop::io
