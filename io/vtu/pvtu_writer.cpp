#include <filesystem>

#include "io/solid/solid_blocks.hpp"
#include "io/solid/solid_cell_values.hpp"
#include "io/text/text_output.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/pvtu_text.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

namespace {

/// With its one piece.
void write_list(OutputSet& outputs, PvtuList list, const std::string& path) {
  list.sources = {std::filesystem::path(pvtu_piece_path(path)).filename()};
  TextOutput file(outputs, path);
  file.write(pvtu_text(list));
  file.close();
}

PvtuList list_of(const Mesh& mesh, const Field* solution, bool has_blocks) {
  PvtuList list;
  if (solution != nullptr) {
    list.point_data = solution->names;
    list.cell_data = solution->cells.names;
  }
  if (has_layers(mesh)) {
    for (const char* name : {vtu_layer_height_asked, vtu_layer_height}) list.point_data.emplace_back(name);
  }
  if (has_blocks) list.cell_marks.emplace_back("block");
  return list;
}

}  // namespace

void write_pvtu(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution) {
  write_list(outputs, list_of(mesh, solution, false), path);
  write_vtu(outputs, mesh, pvtu_piece_path(path), solution);
}

void write_pvtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  write_list(outputs,
             list_of(whole.mesh, whole.solution ? &*whole.solution : nullptr, has_named_blocks(whole)), path);
  write_vtu(outputs, whole, pvtu_piece_path(path));
}

void write_pvtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  PvtuList list;
  list.point_data = mesh.variables();
  list.cell_data = SolidCellValues(mesh).names();
  if (SolidBlocks(mesh).several()) list.cell_marks.emplace_back("block");
  write_list(outputs, list, path);
  write_vtu_solid(outputs, mesh, pvtu_piece_path(path));
}

}  // namespace quadloop
