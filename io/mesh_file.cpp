#include "io/mesh_file.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <system_error>

#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/msh/msh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

std::string suffix_of(const std::string& path) { return std::filesystem::path(path).extension(); }

/// The boundaries' names as a file of the format has them.
std::vector<std::string> names_in_file(const std::vector<std::string>& names, const std::string& format) {
  if (format == "su2") return su2_marker_names(names);
  if (format == "cgns") return cgns_boundary_names(names);
  std::vector<std::string> written = names;
  if (format == "msh") std::transform(names.begin(), names.end(), written.begin(), msh_group_name);
  return written;
}

}  // namespace

const std::vector<std::string>& mesh_formats() {
  static const std::vector<std::string> formats{"mesh", "cgns", "vtu", "su2", "msh"};
  return formats;
}

std::string mesh_format_of(const std::string& path) {
  const std::string suffix = suffix_of(path);
  const auto& formats = mesh_formats();
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const std::string& format) { return suffix == "." + format; });
  return found == formats.end() ? "" : *found;
}

void require_readable_suffix(const std::string& path) {
  if (!mesh_format_of(path).empty()) return;
  std::error_code no_such_file;
  if (std::filesystem::exists(path + ".mesh", no_such_file))
    throw InputError(path + ": is no mesh file; do you mean '" + path + ".mesh'?");
  throw InputError(path + ": no mesh is read from the format '" + suffix_of(path) +
                   "'; give a .mesh, .cgns, .vtu, .su2 or .msh file");
}

LoadedMesh read_mesh(const std::string& path) {
  require_readable_suffix(path);
  const std::string suffix = suffix_of(path);
  if (suffix == ".mesh") return read_native(path);
  if (suffix == ".cgns") return read_cgns(path);
  if (suffix == ".vtu") return read_vtu(path);
  if (suffix == ".su2") return read_su2(path);
  return read_msh(path);
}

void require_writable_suffix(const std::string& path) {
  if (!mesh_format_of(path).empty()) return;
  throw InputError(path + ": no mesh is written in the format '" + suffix_of(path) +
                   "'; name a .mesh, .cgns, .vtu, .su2 or .msh file");
}

bool holds_solution(const std::string& path) {
  const std::string format = mesh_format_of(path);
  return format == "mesh" || format == "cgns" || format == "vtu";
}

void write_mesh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path,
                const std::string& format) {
  const std::string name = format.empty() ? mesh_format_of(path) : format;
  if (name == "mesh") write_native(outputs, whole, path);
  if (name == "cgns") write_cgns(outputs, whole.mesh, path, whole.solution ? &*whole.solution : nullptr);
  if (name == "vtu") write_vtu(outputs, whole, path);
  if (name == "su2") write_su2(outputs, whole.mesh, path);
  if (name == "msh") write_msh(outputs, whole, path);
}

void write_mesh_of_root(const Communicator& comm, const LoadedMesh& whole, const std::string& path,
                        const std::string& format) {
  comm.together([&] {
    if (!comm.is_root()) return;
    const Communicator alone(MPI_COMM_SELF);
    OutputSet outputs(alone);
    write_mesh(outputs, whole, path, format);
    outputs.commit();
  });
}

void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Solution* solution,
                double gamma) {
  const std::string format = mesh_format_of(path);
  if (format == "mesh") write_native(outputs, mesh, path, solution);
  if (format == "cgns") write_cgns(outputs, mesh, path, solution);
  if (format == "vtu") write_vtu(outputs, mesh, path, solution);
  if (format == "su2") write_su2(outputs, mesh, path);
  if (format == "msh") write_msh(outputs, mesh, path);
  if (path.ends_with(".csv") && solution != nullptr) write_su2_csv(outputs, mesh, path, *solution, gamma);
}

std::vector<std::string> renames_in(const Mesh& mesh, const std::string& path, const std::string& format) {
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) names.push_back(boundary.name);
  const std::vector<std::string> written =
      names_in_file(names, format.empty() ? mesh_format_of(path) : format);
  const auto first = std::mismatch(names.begin(), names.end(), written.begin());
  if (first.first == names.end()) return {};
  const auto kept = std::inner_product(names.begin(), names.end(), written.begin(), std::ptrdiff_t{0},
                                       std::plus<>(), std::equal_to<>());
  const std::ptrdiff_t renamed = static_cast<std::ptrdiff_t>(names.size()) - kept;
  return {fmt::format(
      "{}: {} boundar{} renamed, as this format cannot hold every name; the first, '{}', is '{}' there", path,
      renamed, renamed == 1 ? "y is" : "ies are", *first.first, *first.second)};
}

std::vector<std::string> losses_in(const LoadedMesh& whole, const std::string& path,
                                   const std::string& format) {
  const std::string name = format.empty() ? mesh_format_of(path) : format;
  const auto& boundaries = whole.mesh.boundaries;
  std::vector<std::string> losses = renames_in(whole.mesh, path, name);
  if (whole.solution && (name == "su2" || name == "msh"))
    losses.push_back(path + ": this format has no place for the solution, which is left out");
  if (whole.solution && (name == "cgns" || name == "vtu") && !whole.solution->constants.empty()) {
    losses.push_back(path + ": this format has no place for the solution's constants, which are left out");
  }
  if (whole.blocks > 1 && (name == "su2" || name == "cgns"))
    losses.push_back(path + ": the blocks are written as one");
  if (name != "cgns" && std::any_of(boundaries.begin(), boundaries.end(),
                                    [](const BoundaryEdges& b) { return b.condition != "none"; }))
    losses.push_back(path + ": this format has no place for boundary conditions, which are left out");
  return losses;
}

}  // namespace quadloop
