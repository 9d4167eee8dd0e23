#include "io/solution_file.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/model/distribute.hpp"
#include "io/text/clean_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/check/compare_meshes.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

void require_values(const LoadedMesh& loaded, const std::string& path) {
  if (loaded.solution && !loaded.solution->empty()) return;
  throw InputError(path + ": holds a mesh without a solution; " + format_of(path)->without_values);
}

/// Values must be finite, and so small that differences, squares and integrals over the mesh are finite too.
/// The first row has the number `first`, from 1.
void require_usable(const std::vector<std::string>& names, std::span<const double> values, std::int64_t first,
                    const std::string& place, const std::string& path) {
  constexpr double largest = 1e150;
  const std::size_t width = names.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (std::fabs(value) <= largest) continue;
    const std::string fault = std::isfinite(value) ? fmt::format("is beyond {}", largest) : "is not finite";
    throw InputError(fmt::format("{}: {} {} at {} {}: {}", path, names[i % width], fault, place,
                                 first + static_cast<std::int64_t>(i / width), value));
  }
}

/// Throws the error of the lowest rank. *Collective.*
void require_usable(const Communicator& comm, const std::vector<std::string>& names,
                    std::span<const double> values, std::int64_t before, const std::string& place,
                    const std::string& path) {
  const std::int64_t width = std::max<std::int64_t>(1, std::ssize(names)),
                     first = before + 1 + comm.exclusive_sum(std::ssize(values) / width);
  comm.together([&] { require_usable(names, values, first, place, path); });
}

/// *Collective.*
LoadedSolution read_with_mesh(const Communicator& comm, const std::string& path) {
  LoadedMesh loaded = read_mesh(comm, path);
  require_values(loaded, path);
  LoadedSolution result{path, *std::exchange(loaded.solution, {}), comm.sum(loaded.mesh.owned_nodes), {}, {}};
  result.mesh = std::move(loaded);
  return result;
}

/// Returns the solution, and its mesh, whole on the root. *Collective.*
LoadedSolution gathered(const Communicator& comm, const LoadedSolution& part) {
  LoadedSolution whole{part.path, {}, part.nodes, {}, gather_at_root(comm, part.points)};
  if (part.mesh) whole.mesh = gathered(comm, *part.mesh);
  return whole;
}

std::string difference_of(const LoadedSolution& solution, const Mesh& whole) {
  return solution.mesh ? difference(solution.mesh->mesh, whole)
                       : node_difference(solution.nodes, solution.points, whole);
}

}  // namespace

LoadedSolution read_solution(const Communicator& comm, const std::string& path) {
  comm.together([&] { require_solution_suffix(path); });
  const auto read_alone = format_of(path)->read_solution;
  LoadedSolution result = read_alone != nullptr ? read_alone(comm, path) : read_with_mesh(comm, path);
  Field& solution = result.solution;
  std::vector<std::string*> names;
  append_names(solution, names);
  clean_names(names, path);
  comm.together([&] {
    solution.names = distinct_words(solution.names, path);
    solution.cells.names = distinct_words(solution.cells.names, path);
  });
  require_usable(comm, solution.names, solution.values, 0, "node", path);
  const std::size_t of_triangles = result.mesh ? result.mesh->mesh.triangles.size() * solution.cells.width()
                                               : solution.cells.values.size();
  const std::span<const double> cells(solution.cells.values);
  require_usable(comm, solution.cells.names, cells.first(of_triangles), 0, "cell", path);
  require_usable(comm, solution.cells.names, cells.subspan(of_triangles),
                 result.mesh ? comm.sum(std::ssize(result.mesh->mesh.triangles)) : 0, "cell", path);
  return result;
}

LoadedSolution read_solution(const std::string& path) {
  return read_solution(Communicator(MPI_COMM_SELF), path);
}

void require_solution_suffix(const std::string& path) {
  const FileFormat* format = format_of(path);
  if (format != nullptr && format->holds(Content::solution) && format->is_read()) return;
  throw InputError(path + ": no solution is read from the format '" + suffix_of(path) + "'; give a " +
                   read_suffixes_for({Content::solution}) + " file");
}

void require_same_mesh(const Communicator& comm, const LoadedSolution& solution, const Mesh& mesh) {
  const bool same = solution.mesh ? is_same_mesh(comm, solution.mesh->mesh, mesh)
                                  : has_same_nodes(comm, solution.nodes, solution.points, mesh);
  if (same) return;
  const LoadedSolution whole = gathered(comm, solution);  // the message names the first difference
  const Mesh wanted = gather_whole(comm, mesh);
  comm.together([&] {
    const std::string found = comm.is_root() ? difference_of(whole, wanted) : std::string();
    if (!found.empty()) throw InputError(solution.path + ": " + found);
  });
}

void require_same_mesh(const LoadedSolution& solution, const Mesh& whole) {
  require_same_mesh(Communicator(MPI_COMM_SELF), solution, whole);
}

}  // namespace quadloop::io
