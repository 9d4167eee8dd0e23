#include "io/mesh_file.hpp"

#include <filesystem>
#include <system_error>

#include "io/cgns_file.hpp"
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

}  // namespace

void require_readable_suffix(const std::string& path) {
  if (is_known(suffix_of(path))) return;
  std::error_code no_such_file;
  if (std::filesystem::exists(path + ".mesh", no_such_file)) throw InputError(path + ": is no mesh file; do you mean '" + path + ".mesh'?");
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

std::vector<std::string> losses_in(const LoadedMesh& whole, const std::string& path) {
  const std::string suffix = suffix_of(path);
  std::vector<std::string> losses;
  if (whole.solution && (suffix == ".su2" || suffix == ".msh"))
    losses.push_back(path + ": this format has no place for the solution, which is left out");
  if (whole.solution && (suffix == ".cgns" || suffix == ".vtu") && !whole.solution->constants.empty()) {
    losses.push_back(path + ": this format has no place for the solution's constants, which are left out");
  }
  if (whole.blocks > 1 && (suffix == ".su2" || suffix == ".cgns")) losses.push_back(path + ": the blocks are written as one");
  return losses;
}

}  // namespace quadloop
