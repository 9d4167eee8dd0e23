#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/foam/foam_cyclic.hpp"
#include "io/foam/foam_file.hpp"
#include "io/foam/foam_patches.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_faces.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

namespace {

/// Returns the names of the inner lines of a mesh that is written, by the indices of boundaries.
std::map<std::int64_t, std::string> names_of_lines(const MeshStream& stream) {
  std::map<std::int64_t, std::string> names;
  if (stream.held() != nullptr) return names;
  const std::vector<BoundaryEdges>& boundaries = stream.extruded()->plane.boundaries;
  for (std::int64_t b = 0; b < std::ssize(boundaries); ++b) {
    if (boundaries[b].inner_line) names.emplace(b, boundaries[b].name);
  }
  return names;
}

/// Returns the files of a polyMesh: the five mandatory ones, the cell zones of several blocks and the face
/// zones of inner lines.
std::vector<std::string> foam_files(const MeshStream& stream, const StreamBlocks& blocks) {
  std::vector<std::string> files{"points", "faces", "owner", "neighbour", "boundary"};
  if (blocks.several()) files.emplace_back("cellZones");
  if (!names_of_lines(stream).empty()) files.emplace_back("faceZones");
  return files;
}

std::string foam_head(const std::string& type, const std::string& object, const std::string& note = {}) {
  std::string head =
      "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + type + ";\n";
  if (!note.empty()) head += "    note        \"" + note + "\";\n";
  return head + "    location    \"constant/polyMesh\";\n    object      " + object + ";\n}\n\n";
}

/// Returns the patch type for Boundary::condition.
std::string foam_patch_type(BoundaryCondition condition) {
  if (condition.is_wall()) return "wall";
  return condition == BoundaryCondition::symmetry ? "symmetry" : "patch";
}

/// Returns the entry for a condition that the patch type does not determine; empty for others.
std::string foam_physical_type(BoundaryCondition condition, const std::string& type) {
  if (condition_of_foam_type(type) == condition) return {};
  return std::string("        physicalType    ") + condition.word() + ";\n";
}

/// A face needs space for one number more than it has nodes.
template <class Node, std::size_t width>
void put_foam_face(TextRows& text, const std::array<Node, width>& nodes) {
  text.put(width, '(');
  for (std::size_t i = 0; i < width; ++i) text.put(nodes[i], i + 1 < width ? ' ' : ')');
  text.mark('\n');
}

class FoamWriter {
 public:
  FoamWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : outputs_{outputs},
        comm_{outputs.communicator()},
        stream_{stream},
        faces_{stream, StreamFaces::CellNumbers::as_streamed, path},
        blocks_{stream},
        staged_{outputs.stage_folder(path, foam_files(stream, blocks_))} {}

  void write() {
    write_points();
    write_faces();
    write_owner();
    write_neighbour();
    write_boundary();
    if (blocks_.several()) write_cell_zones();
    if (!names_of_lines(stream_).empty()) write_face_zones();
  }

 private:
  void write_points() {
    TextOutput file(outputs_, staged_[0]);
    file.write(foam_head("vectorField", "points") + std::to_string(stream_.counts().nodes) + "\n(\n");
    file.write_rows(stream_.point_rows(), 4, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.mark('(');
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(p.z, ')');
      text.mark('\n');
    });
    finish(file);
  }

  void write_faces() {
    TextOutput file(outputs_, staged_[1]);
    file.write(foam_head("faceList", "faces") + std::to_string(faces_.all()) + "\n(\n");
    faces_.write_internal(file, 5, [](TextRows& text, const auto& nodes, std::int64_t, std::int64_t) {
      put_foam_face(text, nodes);
    });
    faces_.write_patches(file, 5, no_head,
                         [&](TextRows& text, std::size_t n, auto nodes, std::int64_t, std::int64_t) {
                           if (is_image(n)) std::ranges::rotate(nodes, nodes.begin() + 1);
                           put_foam_face(text, nodes);
                         });
    finish(file);
  }

  std::string counts_note() const {
    return "nPoints:" + std::to_string(stream_.counts().nodes) +
           "  nCells:" + std::to_string(stream_.counts().cells()) +
           "  nFaces:" + std::to_string(faces_.all()) +
           "  nInternalFaces:" + std::to_string(faces_.internal());
  }

  /// Writes the cell of lower number of each face.
  void write_owner() {
    TextOutput file(outputs_, staged_[2]);
    file.write(foam_head("labelList", "owner", counts_note()) + std::to_string(faces_.all()) + "\n(\n");
    faces_.write_internal(file, 1, [](TextRows& text, const auto&, std::int64_t owner, std::int64_t) {
      text.put(owner, '\n');
    });
    faces_.write_patches(file, 1, no_head,
                         [](TextRows& text, std::size_t, const auto&, std::int64_t owner, std::int64_t) {
                           text.put(owner, '\n');
                         });
    finish(file);
  }

  void write_neighbour() {
    TextOutput file(outputs_, staged_[3]);
    file.write(foam_head("labelList", "neighbour", counts_note()) + std::to_string(faces_.internal()) +
               "\n(\n");
    faces_.write_internal(file, 1, [](TextRows& text, const auto&, std::int64_t, std::int64_t neighbour) {
      text.put(neighbour, '\n');
    });
    finish(file);
  }

  /// Writes the patches, whose faces follow the inner ones.
  void write_boundary() {
    const std::vector<StreamedPatch>& patches = stream_.patches();
    const std::vector<std::string> names = foam_patch_names(stream_.patch_names());
    TextOutput file(outputs_, staged_[4]);
    std::string text = foam_head("polyBoundaryMesh", "boundary") + std::to_string(names.size()) + "\n(\n";
    std::int64_t start = faces_.internal();
    for (std::size_t n = 0; n < names.size(); ++n) {
      const std::string type = type_of(n);
      text += "    " + names[n] + "\n    {\n        type            " + type + ";\n" + neighbour_entry(n) +
              foam_physical_type(patches[n].condition, type) + "        nFaces          " +
              std::to_string(patches[n].faces()) + ";\n        startFace       " + std::to_string(start) +
              ";\n    }\n";
      start += patches[n].faces();
    }
    file.write(text);
    finish(file);
  }

  /// The pair of a patch, or null.
  const PeriodicPair* pair_of(std::size_t patch) const {
    if (stream_.held() != nullptr || patch >= stream_.side_patches()) return nullptr;
    const std::vector<PeriodicPair>& pairs = stream_.extruded()->plane.pairs;
    const std::string& name = stream_.patches()[patch].name;
    const auto at =
        std::ranges::find_if(pairs, [&](const PeriodicPair& p) { return p.from == name || p.to == name; });
    return at == pairs.end() ? nullptr : &*at;
  }
  /// Whether faces are the images of those of another patch: point 0 of either is the partner of the other.
  bool is_image(std::size_t patch) const {
    const PeriodicPair* const pair = pair_of(patch);
    return pair != nullptr && pair->to == stream_.patches()[patch].name;
  }
  /// Returns the entry that names the other patch of a pair; empty without one.
  std::string neighbour_entry(std::size_t patch) const {
    const PeriodicPair* const pair = pair_of(patch);
    if (pair == nullptr) return {};
    const std::vector<std::string> all = stream_.patch_names(), names = foam_patch_names(all);
    const auto other = std::ranges::find(all, is_image(patch) ? pair->from : pair->to) - all.begin();
    return "        neighbourPatch  " + names[other] + ";\n";
  }

  std::string type_of(std::size_t patch) const {
    if (pair_of(patch) != nullptr) return "cyclic";
    if (const FileMesh* held = stream_.held(); held != nullptr && held->boundaries[patch].is_empty)
      return "empty";
    if (stream_.held() == nullptr && patch >= stream_.side_patches())
      return stream_.layers() == 1 ? "empty" : "symmetryPlane";
    return foam_patch_type(stream_.patches()[patch].condition);
  }

  /// Writes the file `cellZones`: a zone for each block.
  void write_cell_zones() {
    TextOutput file(outputs_, staged_[5]);
    const std::vector<std::string> names = foam_patch_names(blocks_.names());
    file.write(foam_head("regIOobject", "cellZones") + std::to_string(names.size()) + "\n(\n");
    for (std::int32_t block = 0; block < blocks_.count(); ++block) {
      std::int64_t cells = 0, before = 0;
      for_each_kind([&]<CellKind kind>() { cells += comm_.sum(blocks_.rows<kind>(block).size()); });
      file.write(names[block] + "\n{\n    type cellZone;\n    cellLabels      List<label>\n" +
                 std::to_string(cells) + "\n(\n");
      for_each_kind([&]<CellKind kind>() {
        const BlockRows rows = blocks_.rows<kind>(block);
        const std::int64_t first = before + comm_.exclusive_sum(stream_.cell_rows<kind>());
        file.write_rows(rows.size(), 1,
                        [&](TextRows& text, std::int64_t i) { text.put(first + rows[i], '\n'); });
        before += stream_.counts().of(kind);
      });
      file.write(")\n;\n}\n");
    }
    finish(file);
  }

  /// Writes the file `faceZones`: a zone for each inner line. A face is flipped if its owner is on the right.
  void write_face_zones() {
    TextOutput file(outputs_, staged_.back());
    const std::map<std::int64_t, std::string> lines = names_of_lines(stream_);
    const std::vector<StreamFaces::LineFace> faces = faces_.inner_line_faces();
    std::vector<std::string> names;
    for (const auto& [line, name] : lines) names.push_back(name);
    names = foam_patch_names(names);
    file.write(foam_head("regIOobject", "faceZones") + std::to_string(names.size()) + "\n(\n");
    auto name = names.begin();
    for (const auto& [line, unused] : lines) {
      const auto own = std::ranges::equal_range(faces, line, {}, &StreamFaces::LineFace::line);
      const std::string count = std::to_string(own.size());
      file.write(*name++ + "\n{\n    type faceZone;\n    faceLabels      List<label>\n" + count + "\n(\n");
      file.write_root_rows(std::ssize(own), 1,
                           [&](TextRows& text, std::int64_t i) { text.put(own[i].face, '\n'); });
      file.write(")\n;\n    flipMap         List<bool>\n" + count + "\n(\n");
      file.write_root_rows(std::ssize(own), 1,
                           [&](TextRows& text, std::int64_t i) { text.put(own[i].turned ? 1 : 0, '\n'); });
      file.write(")\n;\n}\n");
    }
    finish(file);
  }

  static void finish(TextOutput& file) {
    file.write(")\n");
    file.close();
  }
  static std::string no_head(std::size_t) { return {}; }

  OutputSet& outputs_;
  const Communicator& comm_;
  const MeshStream& stream_;
  StreamFaces faces_;
  const StreamBlocks blocks_;
  std::vector<StagedFile> staged_;
};

/// Returns the mesh without the edges of interfaces, which have cells on both sides. *Collective.*
Mesh without_interfaces(const Communicator& comm, const Mesh& mesh) {
  Mesh result = mesh;
  const std::vector<std::int64_t> right = cells_right_of_boundaries(comm, mesh);
  auto at = right.begin();
  for (BoundaryEdges& boundary : result.boundaries)
    std::erase_if(boundary.edges,
                  [&](const auto&) { return *at++ != EdgeCells::none && !boundary.inner_line; });
  return result;
}

}  // namespace

std::vector<std::string> foam_patch_names(const std::vector<std::string>& names) {
  return plain_words(names);
}

void write_foam(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  if (mesh.extruded() != nullptr && !mesh.is_plane() && !mesh.extruded()->plane.pairs.empty()) {
    const ExtrudedMesh& given = *mesh.extruded();
    Mesh plane = given.plane;
    order_edges_of_pairs(outputs.communicator(), plane);
    const ExtrudedMesh ordered{plane,       given.heights,  given.axis,  given.back,
                               given.front, given.solution, given.blocks};
    return FoamWriter(outputs, MeshStream(outputs.communicator(), ordered), path).write();
  }
  if (!mesh.is_plane()) return FoamWriter(outputs, mesh, path).write();
  Mesh plane = without_interfaces(outputs.communicator(), mesh.extruded()->plane);
  order_edges_of_pairs(outputs.communicator(), plane);
  ExtrudedMesh layer = extruded(plane, even_heights(1, 1), ExtrusionAxis::z);
  layer.blocks = mesh.extruded()->blocks;
  FoamWriter(outputs, MeshStream(outputs.communicator(), layer), path).write();
}

}  // namespace quadloop::io
