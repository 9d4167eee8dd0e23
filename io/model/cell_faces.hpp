#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// The faces of a cell as local node indices, each counter-clockwise as seen from outside; -1: a triangle.
template <std::size_t nodes>
struct CellFaces;

using LocalFace = std::array<std::int8_t, 4>;

template <>
struct CellFaces<4> {
  static constexpr const char* name = "tetrahedron";
  static constexpr std::array<LocalFace, 4> faces{
      {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}}};
};
template <>
struct CellFaces<5> {
  static constexpr const char* name = "pyramid";
  static constexpr std::array<LocalFace, 5> faces{
      {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
};
template <>
struct CellFaces<6> {
  static constexpr const char* name = "prism";
  static constexpr std::array<LocalFace, 5> faces{
      {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
};
template <>
struct CellFaces<8> {
  static constexpr const char* name = "hexahedron";
  static constexpr std::array<LocalFace, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
};

/// Calls `visit(nodes, number)` for each cell with its nodes and its number, from 0 over all kinds:
/// tetrahedra, pyramids, prisms, hexahedra.
template <class Visit>
void for_each_cell(const FileMesh& mesh, const Visit& visit) {
  std::int64_t number = 0;
  const auto visit_all = [&](const auto& cells) {
    for (const auto& nodes : cells) visit(nodes, number++);
  };
  visit_all(mesh.tetrahedra);
  visit_all(mesh.pyramids);
  visit_all(mesh.prisms);
  visit_all(mesh.hexahedra);
}

inline bool is_triangle(const FileBoundary::Face& face) { return face[3] == FileBoundary::no_node; }
inline std::span<const std::int32_t> corners_of(const FileBoundary::Face& face) {
  return std::span(face).first(is_triangle(face) ? 3 : 4);
}

/// Returns a cell's face with the mesh's node numbers.
template <std::size_t width>
FileBoundary::Face face_of(const std::array<std::int32_t, width>& cell, const LocalFace& local) {
  FileBoundary::Face face;
  for (std::size_t i = 0; i < 4; ++i) face[i] = local[i] < 0 ? FileBoundary::no_node : cell[local[i]];
  return face;
}

/// Returns the signed volume within flat faces, quads split along a diagonal: positive for the node order of
/// FileMesh.
template <std::size_t width>
double cell_volume(const FileMesh& mesh, const std::array<std::int32_t, width>& cell) {
  const Point3 origin = mesh.points[cell[0]];
  const auto six_times = [&](std::int8_t a, std::int8_t b, std::int8_t c) {
    return dot(mesh.points[cell[a]] - origin,
               cross(mesh.points[cell[b]] - origin, mesh.points[cell[c]] - origin));
  };
  double sum = 0;
  for (const LocalFace& face : CellFaces<width>::faces) {
    sum += six_times(face[0], face[1], face[2]);
    if (face[3] >= 0) sum += six_times(face[0], face[2], face[3]);
  }
  return sum / 6;
}

}  // namespace quadloop::io
