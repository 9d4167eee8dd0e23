#include "io/stream/held_faces.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "io/model/cell_faces.hpp"
#include "io/model/mesh3d_faces.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

HeldFaces::HeldFaces(const FileMesh& mesh, const std::string& path) : mesh_{mesh}, path_{path} {
  for (const FileBoundary& patch : mesh.boundaries) {
    of_patch_.emplace_back(patch.faces.size(), -1);
    local_of_patch_.emplace_back(patch.faces.size(), -1);
  }
  for_each_face(mesh, [this](std::int32_t, std::span<const FaceMention> same) {
    const FaceMention& first = same.front();
    if (same.size() != 2 || same[1].owner < 0) refuse();
    if (first.owner >= 0) {
      internal_.push_back({first.owner, same[1].owner, first.number});
      return;
    }
    of_patch_[-1 - first.owner][first.number] = same[1].owner;
    local_of_patch_[-1 - first.owner][first.number] = same[1].number;
  });
  std::ranges::sort(internal_, [](const Inner& a, const Inner& b) {
    return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
  });
  for (const std::vector<std::int32_t>& cells : of_patch_) {
    if (std::ranges::count(cells, -1) > 0) refuse();
  }
}

FileBoundary::Face HeldFaces::nodes(std::int32_t cell, std::int32_t local) const {
  FileBoundary::Face face{};
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

void HeldFaces::refuse() const {
  throw OutputError(path_ +
                    ": this format needs each face between two cells or on one patch, and this mesh has "
                    "others; `quadloop check` says where");
}

}  // namespace quadloop::io
