#include "io/parts/part_pvtu.hpp"

#include <algorithm>
#include <filesystem>

#include "io/vtu/vtu_layers.hpp"
#include "io/vtu/vtu_text.hpp"

namespace quadloop {

void write_part_pvtu(OutputSet& outputs, const PartIndex& index, const std::vector<std::string>& variables,
                     const std::string& prefix) {
  const auto array = [](const char* type, const std::string& name) {
    return std::string("<PDataArray type=\"") + type + "\" Name=\"" + xml_escaped(name) + "\"/>\n";
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n"
      "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n"
      "<PPointData>\n";
  for (const std::string& variable : variables) text += array("Float64", variable);
  if (std::ranges::any_of(index.boundaries, [](const BoundaryEdges& b) { return b.layers.count > 0; }))
    text += array("Float64", vtu_layer_height_asked) + array("Float64", vtu_layer_height);
  text += "</PPointData>\n<PCellData>\n" + array("Int32", "boundary");
  if (index.blocks.size() > 1) text += array("Int32", "block");
  text += "</PCellData>\n";
  const std::string beside = std::filesystem::path(prefix).filename();
  for (std::int32_t part = 0; part < index.parts; ++part)
    text += "<Piece Source=\"" + xml_escaped(part_path(beside, part, "vtu")) + "\"/>\n";
  OutputFile file(outputs.stage(prefix + ".pvtu"));
  file.write(text + "</PUnstructuredGrid>\n</VTKFile>\n");
  file.close();
}

}  // namespace quadloop
