#include "io/foam/foam_file.hpp"
#include "io/foam/foam_parts.hpp"
#include "io/foam/foam_plane_file.hpp"
#include "io/stream/extruded_faces.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

class FoamWriter {
 public:
  FoamWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : comm_{outputs.communicator()},
        stream_{stream},
        mesh_{*stream.extruded()},
        blocks_{stream},
        staged_{outputs.stage_folder(path, foam_files(blocks_))},
        faces_{comm_, mesh_} {
    all_faces_ = faces_.internal();
    for (const StreamedPatch& patch : stream_.patches()) all_faces_ += patch.faces();
  }

  void write() {
    write_foam_points(stream_, staged_[0]);
    write_faces();
    write_owner();
    write_neighbour();
    write_boundary();
    if (blocks_.several()) write_foam_zones(stream_, blocks_, staged_[5]);
  }

 private:
  void write_faces() {
    TextOutput file(comm_, staged_[1]);
    file.write(foam_head("faceList", "faces") + std::to_string(all_faces_) + "\n(\n");
    faces_.write_internal(file, 5, [](TextRows& text, const auto& nodes, std::int64_t, std::int64_t) {
      put_foam_face(text, nodes);
    });
    write_patch_faces(file);
    file.write(")\n");
    file.close();
  }

  void write_patch_faces(TextOutput& file) const {
    file.write_boundaries(
        *stream_.boundaries(), 5 * mesh_.layers(), [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer)
            put_foam_face(text, mesh_.side(GlobalNodeId{edge[0]}, GlobalNodeId{edge[1]}, layer));
        });
    for (const bool front : {false, true})
      faces_.write_end(file, 5, front,
                       [](TextRows& text, const auto& nodes, std::int64_t) { put_foam_face(text, nodes); });
  }

  std::string counts_note() const {
    return foam_counts_note(stream_.counts(), all_faces_, faces_.internal());
  }

  /// Of the face's cells that with the lower number.
  void write_owner() {
    TextOutput file(comm_, staged_[2]);
    file.write(foam_head("labelList", "owner", counts_note()) + std::to_string(all_faces_) + "\n(\n");
    faces_.write_internal(file, 1, [](TextRows& text, const auto&, std::int64_t owner, std::int64_t) {
      text.put(owner, '\n');
    });
    file.write_boundaries(
        faces_.owners_along_sides(), mesh_.layers(), [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer)
            text.put(edge[0] * mesh_.layers() + layer, '\n');
        });
    for (const bool front : {false, true})
      faces_.write_end(file, 1, front,
                       [](TextRows& text, const auto&, std::int64_t owner) { text.put(owner, '\n'); });
    file.write(")\n");
    file.close();
  }

  void write_neighbour() {
    TextOutput file(comm_, staged_[3]);
    file.write(foam_head("labelList", "neighbour", counts_note()) + std::to_string(faces_.internal()) +
               "\n(\n");
    faces_.write_internal(file, 1, [](TextRows& text, const auto&, std::int64_t, std::int64_t neighbour) {
      text.put(neighbour, '\n');
    });
    file.write(")\n");
    file.close();
  }

  void write_boundary() {
    std::vector<std::string> types;
    for (const StreamedPatch& patch : stream_.patches()) types.push_back(foam_patch_type(patch.condition));
    for (std::size_t end = stream_.side_patches(); end < types.size(); ++end)
      types[end] = mesh_.layers() == 1 ? "empty" : "symmetryPlane";
    write_foam_boundary(comm_, staged_[4], stream_.patches(), types, faces_.internal());
  }

  const Communicator& comm_;
  const MeshStream& stream_;
  const ExtrudedMesh& mesh_;
  const StreamBlocks blocks_;
  std::vector<StagedFile> staged_;
  ExtrudedFaces faces_;
  std::int64_t all_faces_ = 0;
};

}  // namespace

std::vector<std::string> foam_patch_names(const std::vector<std::string>& names) {
  return plain_words(names);
}

void write_foam(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  if (mesh.is_plane()) return write_foam_plane(outputs, mesh, path);
  if (mesh.held() != nullptr) return write_foam_held(outputs, mesh, path);
  FoamWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
