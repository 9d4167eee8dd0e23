#include "io/vtu/pvtu_text.hpp"

#include <filesystem>

#include "io/vtu/vtu_text.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

std::string pvtu_text(const PvtuList& list) {
  const auto arrays = [](const char* type, const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
      text += std::string("<PDataArray type=\"") + type + "\" Name=\"" + xml_escaped(name) + "\"/>\n";
    return text;
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n"
      "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n"
      "<PPointData>\n" +
      arrays("Float64", list.point_data) + "</PPointData>\n<PCellData>\n" + arrays("Int32", list.cell_flags) +
      arrays("Float64", list.cell_data) + "</PCellData>\n";
  for (const std::string& source : list.sources) text += "<Piece Source=\"" + xml_escaped(source) + "\"/>\n";
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string pvtu_piece_path(const std::string& path) {
  std::filesystem::path piece = path;
  const std::string stem = suffix_of(path) == ".pvtu" ? piece.stem() : piece.filename();
  return piece.replace_filename(stem + "_0.vtu").string();
}

}  // namespace quadloop::io
