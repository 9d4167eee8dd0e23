#include "io/model/mesh3d_faces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "io/model/cell_faces.hpp"

namespace quadloop::io {

namespace {

/// Calls `visit(nodes, owner, number)` for each face of a cell and of a patch.
template <class Visit>
void for_each_mention(const FileMesh& mesh, const Visit& visit) {
  for_each_cell(mesh,
                [&]<std::size_t width>(const std::array<std::int32_t, width>& nodes, std::int64_t cell) {
                  std::int32_t number = 0;
                  for (const LocalFace& local : CellFaces<width>::faces)
                    visit(face_of(nodes, local), static_cast<std::int32_t>(cell), number++);
                });
  for (std::size_t p = 0; p < mesh.boundaries.size(); ++p) {
    std::int32_t number = 0;
    for (const FileBoundary::Face& face : mesh.boundaries[p].faces)
      visit(face, -1 - static_cast<std::int32_t>(p), number++);
  }
}

}  // namespace

void for_each_face(const FileMesh& mesh,
                   const std::function<void(std::int32_t lowest, std::span<const FaceMention>)>& visit) {
  std::vector<std::int64_t> ends(mesh.points.size() + 1, 0);  // mentions are grouped by lowest node
  for_each_mention(mesh, [&](const FileBoundary::Face& face, std::int32_t, std::int32_t) {
    ++ends[std::ranges::min(corners_of(face))];
  });
  std::int64_t total = 0;
  for (std::int64_t& end : ends) total += std::exchange(end, total);
  std::vector<FaceMention> mentions(total);
  for_each_mention(mesh, [&](FileBoundary::Face face, std::int32_t owner, std::int32_t number) {
    if (is_triangle(face)) {
      std::sort(face.begin(), face.begin() + 3);
    } else {
      std::sort(face.begin(), face.end());
    }
    mentions[ends[face[0]]++] = {{face[1], face[2], face[3]}, owner, number};
  });
  std::int64_t begin = 0;
  for (std::size_t node = 0; node < mesh.points.size(); ++node) {
    const std::span<FaceMention> here = std::span(mentions).subspan(begin, ends[node] - begin);
    std::ranges::sort(here);
    for (std::size_t i = 0; i < here.size();) {
      std::size_t end = i;
      while (end < here.size() && here[end].others == here[i].others) ++end;
      visit(static_cast<std::int32_t>(node), here.subspan(i, end - i));
      i = end;
    }
    begin = ends[node];
  }
}

}  // namespace quadloop::io
