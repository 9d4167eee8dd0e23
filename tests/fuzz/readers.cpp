// Readers of files: an input is written to a folder and read back. The name of the target is that of the
// file.
#include <string>
#include <variant>
#include <vector>

#include "io/gis/gis_formats.hpp"
#include "io/input/case_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/mesh_file.hpp"
#include "io/model/check_mesh3d.hpp"
#include "io/model/tidy_mesh.hpp"
#include "io/solution_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/input_files.hpp"
#include "tests/fuzz/tree_text.hpp"

namespace quadloop::fuzz {

namespace {

/// What `check` does with a mesh, and `smooth` before it begins.
void read_and_look(const std::string& path) {
  io::MeshOfFile mesh = io::read_mesh_file(path);
  if (io::LoadedMesh* loaded = std::get_if<io::LoadedMesh>(&mesh)) {
    validate(loaded->mesh, {loaded->blocks, loaded->triangle_to_block, loaded->quad_to_block});
    io::tidy_mesh(*loaded, path);
  } else {
    io::check_mesh3d(std::get<io::FileMesh>(mesh));
  }
}

void read_case_file(const std::string& path) { io::read_case(path).values({}); }

void read_outline_file(const std::string& path) {
  std::vector<std::string> warnings;
  io::add_gis_formats();
  io::read_outline(path, warnings);
}

bool has_one_of(std::string_view name, std::initializer_list<std::string_view> suffixes) {
  for (const std::string_view suffix : suffixes) {
    if (name.ends_with(suffix)) return true;
  }
  return false;
}

}  // namespace

void read_file(std::string_view name, std::string_view input) {
  static const Folder folder;
  const std::string path = folder.file(name);
  if (name.ends_with(io::tree_suffix)) {
    folder.clear();
    write_tree_of_text(input, path);
    io::read_tree(Communicator(MPI_COMM_SELF), path);
    return;
  }
  write_input(folder, name, input);
  if (name.starts_with("solution.")) {
    io::read_solution(path);
  } else if (name.ends_with(".toml")) {
    read_case_file(path);
  } else if (has_one_of(name, {".geom", ".dat", ".dxf", ".stp", ".geojson"})) {
    read_outline_file(path);
  } else {
    read_and_look(path);
  }
}

}  // namespace quadloop::fuzz
