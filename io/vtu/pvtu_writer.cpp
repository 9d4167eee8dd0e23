#include <filesystem>

#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "io/text/text_output.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/pvtu_text.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::io {

void write_pvtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  PvtuList list;
  list.point_data = mesh.variables();
  list.cell_data = StreamCellValues(mesh).names();
  if (mesh.is_plane() && has_layers(mesh.extruded()->plane)) {
    for (const char* name : {vtu_layer_height_asked, vtu_layer_height}) list.point_data.emplace_back(name);
  }
  if (StreamBlocks(mesh).are_named()) list.cell_flags.emplace_back("block");
  list.sources = {std::filesystem::path(pvtu_piece_path(path)).filename()};
  TextOutput file(outputs, path);
  file.write(pvtu_text(list));
  file.close();
  write_vtu(outputs, mesh, pvtu_piece_path(path));
}

}  // namespace quadloop::io
