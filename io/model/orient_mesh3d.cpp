#include "io/model/orient_mesh3d.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "io/model/cell_faces.hpp"
#include "io/model/mesh3d_faces.hpp"
#include "mesher/base/parity_sets.hpp"

namespace quadloop::io {

namespace {

/// Returns the volume of each cell, numbered over all kinds.
std::vector<double> volumes_of(const FileMesh& mesh) {
  std::vector<double> volumes;
  for_each_cell(mesh, [&](const auto& nodes, std::int64_t) { volumes.push_back(cell_volume(mesh, nodes)); });
  return volumes;
}

/// Whether a face is traversed from its lowest node to the lower of that node's two neighbours.
bool runs_to_lower(const FileBoundary::Face& face) {
  const auto corners = corners_of(face);
  const std::size_t width = corners.size(), lowest = std::ranges::min_element(corners) - corners.begin();
  return corners[(lowest + 1) % width] < corners[(lowest + width - 1) % width];
}

/// Returns the direction of each face of each cell: six bits per cell.
std::vector<std::uint8_t> directions_of(const FileMesh& mesh) {
  std::vector<std::uint8_t> directions;
  for_each_cell(mesh, [&]<std::size_t width>(const std::array<std::int32_t, width>& nodes, std::int64_t) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < CellFaces<width>::faces.size(); ++k)
      bits |= runs_to_lower(face_of(nodes, CellFaces<width>::faces[k])) ? 1U << k : 0U;
    directions.push_back(static_cast<std::uint8_t>(bits));
  });
  return directions;
}

ParitySets mesh3d_pieces(const FileMesh& mesh, std::size_t cells) {
  const std::vector<std::uint8_t> directions = directions_of(mesh);
  const auto direction = [&](const FaceMention& face) {
    return (directions[face.owner] >> static_cast<std::uint32_t>(face.number)) & 1U;
  };
  ParitySets pieces(cells);
  for_each_face(mesh, [&](std::int32_t, std::span<const FaceMention> same) {
    const auto of_cells =
        same.last(std::ranges::count_if(same, [](const FaceMention& f) { return f.owner >= 0; }));
    if (of_cells.size() != 2 || of_cells[0].owner == of_cells[1].owner) return;
    pieces.join(of_cells[0].owner, of_cells[1].owner, direction(of_cells[0]) == direction(of_cells[1]));
  });
  return pieces;
}

/// Returns the same cell with the opposite orientation.
std::array<std::int32_t, 4> turned(const std::array<std::int32_t, 4>& n) { return {n[0], n[2], n[1], n[3]}; }
std::array<std::int32_t, 5> turned(const std::array<std::int32_t, 5>& n) {
  return {n[0], n[3], n[2], n[1], n[4]};
}
std::array<std::int32_t, 6> turned(const std::array<std::int32_t, 6>& n) {
  return {n[0], n[2], n[1], n[3], n[5], n[4]};
}
std::array<std::int32_t, 8> turned(const std::array<std::int32_t, 8>& n) {
  return {n[0], n[3], n[2], n[1], n[4], n[7], n[6], n[5]};
}

}  // namespace

std::int64_t orient_mesh3d(FileMesh& mesh) {
  const std::vector<double> volumes = volumes_of(mesh);
  if (std::ranges::none_of(volumes, [](double volume) { return volume < 0; })) return 0;
  ParitySets pieces = mesh3d_pieces(mesh, volumes.size());
  std::vector<double> of_piece(volumes.size(), 0);  // for each root, with the orientation in the file
  for (std::size_t cell = 0; cell < volumes.size(); ++cell) {
    const auto [root, opposed] = pieces.member_of(cell);
    of_piece[root] += opposed ? -volumes[cell] : volumes[cell];
  }
  std::int64_t count = 0;
  std::size_t cell = 0;
  for_each_kind_of_cell([&]<std::size_t width>() {
    for (auto& nodes : cells_of<width>(mesh)) {
      const auto [root, opposed] = pieces.member_of(cell++);
      const double volume = opposed ? -of_piece[root] : of_piece[root];
      if (!(volume < 0) || pieces.is_torn(root)) continue;
      nodes = turned(nodes);
      ++count;
    }
  });
  return count;
}

}  // namespace quadloop::io
