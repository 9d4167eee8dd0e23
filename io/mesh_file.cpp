#include "io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>

#include "io/cgns_file.hpp"
#include "io/cgns_names.hpp"
#include "io/msh_file.hpp"
#include "io/native_file.hpp"
#include "io/su2_file.hpp"
#include "io/vtu_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

std::string suffix_of(const std::string& path) { return std::filesystem::path(path).extension(); }

bool is_known(const std::string& suffix) {
  return suffix == ".mesh" || suffix == ".cgns" || suffix == ".vtu" || suffix == ".su2" || suffix == ".msh";
}

/// The boundaries' names as a file of the suffix has them.
std::vector<std::string> names_in_file(const std::vector<std::string>& names, const std::string& suffix) {
  if (suffix == ".su2") return su2_marker_names(names);
  if (suffix == ".cgns") return cgns_boundary_names(names);
  std::vector<std::string> written = names;
  if (suffix == ".msh") std::transform(names.begin(), names.end(), written.begin(), msh_group_name);
  return written;
}

}  // namespace

void require_readable_suffix(const std::string& path) {
  if (is_known(suffix_of(path))) return;
  if (std::filesystem::exists(path + ".mesh")) throw InputError(path + ": is no mesh file; do you mean '" + path + ".mesh'?");
  throw InputError(path + ": no mesh is read from the format '" + suffix_of(path) + "'; give a .mesh, .cgns, .vtu, .su2 or .msh file");
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
  if (is_known(suffix_of(path))) return;
  throw InputError(path + ": no mesh is written in the format '" + suffix_of(path) + "'; name a .mesh, .cgns, .vtu, .su2 or .msh file");
}

void write_mesh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".mesh") write_native(outputs, whole, path);
  if (suffix == ".cgns") write_cgns(outputs, whole.mesh, path, whole.solution ? &*whole.solution : nullptr);
  if (suffix == ".vtu") write_vtu(outputs, whole, path);
  if (suffix == ".su2") write_su2(outputs, whole.mesh, path);
  if (suffix == ".msh") write_msh(outputs, whole, path);
}

void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Solution* solution) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".mesh") write_native(outputs, mesh, path, solution);
  if (suffix == ".cgns") write_cgns(outputs, mesh, path, solution);
  if (suffix == ".vtu") write_vtu(outputs, mesh, path, solution);
  if (suffix == ".su2") write_su2(outputs, mesh, path);
  if (suffix == ".msh") write_msh(outputs, mesh, path);
}

std::vector<std::string> renames_in(const Mesh& mesh, const std::string& path) {
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) names.push_back(boundary.name);
  const std::vector<std::string> written = names_in_file(names, suffix_of(path));
  const auto first = std::mismatch(names.begin(), names.end(), written.begin());
  if (first.first == names.end()) return {};
  const auto kept = std::inner_product(names.begin(), names.end(), written.begin(), std::ptrdiff_t{0}, std::plus<>(), std::equal_to<>());
  const std::ptrdiff_t renamed = static_cast<std::ptrdiff_t>(names.size()) - kept;
  return {fmt::format("{}: {} boundar{} renamed, as this format cannot hold every name; the first, '{}', is '{}' there", path, renamed,
                      renamed == 1 ? "y is" : "ies are", *first.first, *first.second)};
}

std::vector<std::string> losses_in(const LoadedMesh& whole, const std::string& path) {
  const std::string suffix = suffix_of(path);
  std::vector<std::string> losses = renames_in(whole.mesh, path);
  if (whole.solution && (suffix == ".su2" || suffix == ".msh"))
    losses.push_back(path + ": this format has no place for the solution, which is left out");
  if (whole.solution && (suffix == ".cgns" || suffix == ".vtu") && !whole.solution->constants.empty()) {
    losses.push_back(path + ": this format has no place for the solution's constants, which are left out");
  }
  if (whole.blocks > 1 && (suffix == ".su2" || suffix == ".cgns")) losses.push_back(path + ": the blocks are written as one");
  return losses;
}

}  // namespace quadloop
