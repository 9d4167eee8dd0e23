#include "io/foam/foam_parts.hpp"
#include "io/model/cell_faces.hpp"
#include "io/stream/held_faces.hpp"

namespace quadloop {

namespace {

void put_face(TextRows& text, const FileBoundary::Face& face) {
  if (is_triangle(face)) {
    put_foam_face(text, std::array{face[0], face[1], face[2]});
  } else {
    put_foam_face(text, face);
  }
}

class FoamHeldWriter {
 public:
  FoamHeldWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : stream_{stream},
        mesh_{*stream.held()},
        faces_{mesh_, path},
        blocks_{stream},
        staged_{outputs.stage_folder(path, foam_files(blocks_))} {}

  void write() {
    write_foam_points(stream_, staged_[0]);
    write_faces();
    write_labels(
        staged_[2], "owner", [](const HeldFaces::Inner& face) { return face.owner; }, true);
    write_labels(
        staged_[3], "neighbour", [](const HeldFaces::Inner& face) { return face.neighbour; }, false);
    std::vector<std::string> types;
    for (const FileBoundary& patch : mesh_.boundaries)
      types.push_back(patch.is_empty ? "empty" : foam_patch_type(patch.condition));
    write_foam_boundary(stream_.communicator(), staged_[4], stream_.patches(), types,
                        std::ssize(faces_.internal()));
    if (blocks_.several()) write_foam_zones(stream_, blocks_, staged_[5]);
  }

 private:
  std::int64_t all_faces() const {
    return std::ssize(faces_.internal()) + stream_.patch_triangles() + stream_.patch_quads();
  }

  void write_faces() {
    TextOutput file(stream_.communicator(), staged_[1]);
    file.write(foam_head("faceList", "faces") + std::to_string(all_faces()) + "\n(\n");
    file.write_rows(std::ssize(faces_.internal()), 5, [&](TextRows& text, std::int64_t i) {
      put_face(text, faces_.nodes(faces_.internal()[i]));
    });
    for (std::size_t p = 0; p < mesh_.boundaries.size(); ++p) {
      file.write_rows(std::ssize(mesh_.boundaries[p].faces), 5,
                      [&](TextRows& text, std::int64_t i) { put_face(text, faces_.patch_nodes(p, i)); });
    }
    file.write(")\n");
    file.close();
  }

  template <class Label>
  void write_labels(const StagedFile& staged, const std::string& name, const Label& label, bool of_patches) {
    TextOutput file(stream_.communicator(), staged);
    const std::int64_t internal = std::ssize(faces_.internal());
    file.write(foam_head("labelList", name, foam_counts_note(stream_.counts(), all_faces(), internal)) +
               std::to_string(of_patches ? all_faces() : internal) + "\n(\n");
    file.write_rows(internal, 1,
                    [&](TextRows& text, std::int64_t i) { text.put(label(faces_.internal()[i]), '\n'); });
    for (std::size_t p = 0; of_patches && p < mesh_.boundaries.size(); ++p) {
      const std::vector<std::int32_t>& cells = faces_.cells_at(p);
      file.write_rows(std::ssize(cells), 1,
                      [&](TextRows& text, std::int64_t i) { text.put(cells[i], '\n'); });
    }
    file.write(")\n");
    file.close();
  }

  const MeshStream& stream_;
  const FileMesh& mesh_;
  HeldFaces faces_;
  const StreamBlocks blocks_;
  std::vector<StagedFile> staged_;
};

}  // namespace

void write_foam_held(OutputSet& outputs, const MeshStream& stream, const std::string& path) {
  FoamHeldWriter(outputs, stream, path).write();
}

}  // namespace quadloop
