#include "io/parts/part_pvtu.hpp"

#include <algorithm>
#include <filesystem>

#include "io/vtu/pvtu_text.hpp"
#include "io/vtu/vtu_layers.hpp"

namespace quadloop::io {

void write_part_pvtu(OutputSet& outputs, const PartIndex& index, const Field& field,
                     const std::string& prefix) {
  PvtuList list{.point_data = field.names, .cell_data = field.cells.names, .sources = {}};
  if (std::ranges::any_of(index.boundaries, [](const BoundaryEdges& b) { return b.layers.count > 0; })) {
    for (const char* name : {vtu_layer_height_asked, vtu_layer_height}) list.point_data.emplace_back(name);
  }
  if (index.blocks.size() > 1) list.cell_flags.emplace_back("block");
  const std::string beside = std::filesystem::path(prefix).filename();
  for (std::int32_t part = 0; part < index.parts; ++part)
    list.sources.push_back(part_path(beside, part, "vtu"));
  OutputFile file(outputs.stage(prefix + ".pvtu"));
  file.write(pvtu_text(list));
  file.close();
}

}  // namespace quadloop::io
