#include <algorithm>
#include <tuple>

#include "io/foam/foam_parts.hpp"
#include "mesher/base/error.hpp"
#include "mesher/solid/cell_faces.hpp"
#include "mesher/solid/solid_faces.hpp"

namespace quadloop {

namespace {

/// A face between two cells, or of a cell and a patch; `local` is which of its owner's faces it is.
struct OwnedFace {
  std::int32_t owner, neighbour;
  std::int32_t local;
};

/// The faces of a mesh that one rank holds, in OpenFOAM's order: those inside by owner and neighbour (upper
/// triangular), then those of each patch as the patch has them.
class FoamFaces {
 public:
  FoamFaces(const SolidMesh& mesh, const std::string& path) : mesh_{mesh}, path_{path} {
    for (const SolidPatch& patch : mesh.patches) {
      of_patch_.emplace_back(patch.faces.size(), -1);
      local_of_patch_.emplace_back(patch.faces.size(), -1);
    }
    for_each_face(mesh, [this](std::int32_t, std::span<const FaceMention> same) { take(same); });
    std::ranges::sort(internal_, [](const OwnedFace& a, const OwnedFace& b) {
      return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
    });
    for (const std::vector<std::int32_t>& cells : of_patch_) {
      if (std::ranges::count(cells, -1) > 0) refuse();
    }
  }

  const std::vector<OwnedFace>& internal() const { return internal_; }
  /// The cell of each face of a patch.
  const std::vector<std::int32_t>& cells_at(std::size_t patch) const { return of_patch_[patch]; }

  /// The nodes of a cell's face, counter-clockwise as seen from outside it.
  SolidPatch::Face nodes(std::int32_t cell, std::int32_t local) const {
    SolidPatch::Face face{};
    std::int64_t row = cell;
    for_each_kind_of_cell([&]<std::size_t width>() {
      const auto& cells = cells_of<width>(mesh_);
      if (row >= 0 && row < std::ssize(cells)) {
        face = face_of(cells[row], CellFaces<width>::faces[local]);
        row = -1;
      } else if (row >= 0) {
        row -= std::ssize(cells);
      }
    });
    return face;
  }
  /// The same for a face of a patch, whose own order of nodes says nothing.
  SolidPatch::Face patch_nodes(std::size_t patch, std::size_t number) const {
    return nodes(of_patch_[patch][number], local_of_patch_[patch][number]);
  }

 private:
  [[noreturn]] void refuse() const {
    throw OutputError(
        path_ +
        ": a polyMesh needs each face between two cells or on one patch, and this mesh has others; "
        "`quadloop check` says where");
  }

  void take(std::span<const FaceMention> same) {
    const FaceMention& first = same.front();
    if (same.size() != 2 || same[1].owner < 0) refuse();
    if (first.owner >= 0) {
      internal_.push_back({first.owner, same[1].owner, first.number});
      return;
    }
    of_patch_[-1 - first.owner][first.number] = same[1].owner;
    local_of_patch_[-1 - first.owner][first.number] = same[1].number;
  }

  const SolidMesh& mesh_;
  std::string path_;
  std::vector<OwnedFace> internal_;
  std::vector<std::vector<std::int32_t>> of_patch_, local_of_patch_;
};

void put_face(TextRows& text, const SolidPatch::Face& face) {
  if (is_triangle(face)) {
    put_foam_face(text, std::array{face[0], face[1], face[2]});
  } else {
    put_foam_face(text, face);
  }
}

class FoamHeldWriter {
 public:
  FoamHeldWriter(OutputSet& outputs, const SolidStream& stream, const std::string& path)
      : stream_{stream},
        mesh_{*stream.held()},
        faces_{mesh_, path},
        staged_{outputs.stage_folder(path, foam_files)} {}

  void write() {
    write_foam_points(stream_, staged_[0]);
    write_faces();
    write_labels(
        staged_[2], "owner", [](const OwnedFace& face) { return face.owner; }, true);
    write_labels(
        staged_[3], "neighbour", [](const OwnedFace& face) { return face.neighbour; }, false);
    std::vector<std::string> types;
    for (const SolidPatch& patch : mesh_.patches)
      types.push_back(patch.is_empty ? "empty" : foam_patch_type(patch.condition));
    write_foam_boundary(stream_.communicator(), staged_[4], stream_.patches(), types,
                        std::ssize(faces_.internal()));
  }

 private:
  std::int64_t all_faces() const {
    return std::ssize(faces_.internal()) + stream_.patch_triangles() + stream_.patch_quads();
  }

  void write_faces() {
    TextOutput file(stream_.communicator(), staged_[1]);
    file.write(foam_head("faceList", "faces") + std::to_string(all_faces()) + "\n(\n");
    file.write_rows(std::ssize(faces_.internal()), 5, [&](TextRows& text, std::int64_t i) {
      put_face(text, faces_.nodes(faces_.internal()[i].owner, faces_.internal()[i].local));
    });
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      file.write_rows(std::ssize(mesh_.patches[p].faces), 5,
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
    for (std::size_t p = 0; of_patches && p < mesh_.patches.size(); ++p) {
      const std::vector<std::int32_t>& cells = faces_.cells_at(p);
      file.write_rows(std::ssize(cells), 1,
                      [&](TextRows& text, std::int64_t i) { text.put(cells[i], '\n'); });
    }
    file.write(")\n");
    file.close();
  }

  const SolidStream& stream_;
  const SolidMesh& mesh_;
  FoamFaces faces_;
  std::vector<StagedFile> staged_;
};

}  // namespace

void write_foam_held(OutputSet& outputs, const SolidStream& stream, const std::string& path) {
  FoamHeldWriter(outputs, stream, path).write();
}

}  // namespace quadloop
