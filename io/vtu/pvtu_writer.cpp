#include <filesystem>
#include <span>

#include "io/text/text_output.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "io/vtu/vtu_text.hpp"
#include "mesher/mesh/layer_nodes.hpp"

namespace quadloop {

namespace {

std::string piece_path(const std::string& path) {
  std::filesystem::path piece = path;
  const std::string stem = piece.extension() == ".pvtu" ? piece.stem() : piece.filename();
  return piece.replace_filename(stem + "_0.vtu").string();
}

std::string tag_of(const std::string& type, const std::string& name, int components = 1) {
  std::string tag = "<PDataArray type=\"" + type + "\" Name=\"" + xml_escaped(name) + "\"";
  if (components > 1) tag += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  return tag + "/>\n";
}

/// What all pieces have in them, and where they are.
void write_list(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution,
                bool has_blocks) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid "
      "GhostLevel=\"0\">\n<PPoints>\n" +
      tag_of("Float64", "Points", 3) + "</PPoints>\n<PPointData>\n";
  if (solution != nullptr) {
    for (const std::string& name : solution->names) text += tag_of("Float64", name);
  }
  if (has_layers(mesh)) {
    for (const char* name : {vtu_layer_height_asked, vtu_layer_height}) text += tag_of("Float64", name);
  }
  text += "</PPointData>\n<PCellData>\n" + tag_of("Int32", "boundary");
  if (has_blocks) text += tag_of("Int32", "block");
  if (solution != nullptr) {
    for (const std::string& name : solution->cells.names) text += tag_of("Float64", name);
  }
  const std::string piece = std::filesystem::path(piece_path(path)).filename();
  text += "</PCellData>\n<Piece Source=\"" + xml_escaped(piece) + "\"/>\n</PUnstructuredGrid>\n</VTKFile>\n";
  TextOutput file(outputs, path);
  file.write(text);
  file.close();
}

}  // namespace

void write_pvtu(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution) {
  write_list(outputs, mesh, path, solution, false);
  write_vtu(outputs, mesh, piece_path(path), solution);
}

void write_pvtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  write_list(outputs, whole.mesh, path, whole.solution ? &*whole.solution : nullptr, whole.blocks > 1);
  write_vtu(outputs, whole, piece_path(path));
}

}  // namespace quadloop
