#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// The numbers by which VTK names kinds of cells.
enum VtkCell : std::uint8_t {
  vtk_vertex = 1,
  vtk_poly_vertex = 2,
  vtk_line = 3,
  vtk_triangle = 5,
  vtk_polygon = 7,
  vtk_pixel = 8,
  vtk_quad = 9,
  vtk_tetrahedron = 10,
  vtk_voxel = 11,
  vtk_hexahedron = 12,
  vtk_wedge = 13,
  vtk_pyramid = 14
};

/// The number of a kind of cells.
template <CellKind kind>
inline constexpr VtkCell vtk_type_of = kind == CellKind::triangle      ? vtk_triangle
                                       : kind == CellKind::quad        ? vtk_quad
                                       : kind == CellKind::tetrahedron ? vtk_tetrahedron
                                       : kind == CellKind::pyramid     ? vtk_pyramid
                                       : kind == CellKind::prism       ? vtk_wedge
                                                                       : vtk_hexahedron;

/// The nodes of a prism in VTK's order, which SU2 shares, from the order of FileMesh (that of CGNS), and
/// back: the first triangle of a VTK wedge looks outwards (documentation of vtkWedge).
template <class Node>
std::array<Node, 6> vtk_wedge_order(const std::array<Node, 6>& n) {
  return {n[0], n[2], n[1], n[3], n[5], n[4]};
}

/// The nodes of any cell in VTK's order.
template <class Node, std::size_t width>
std::array<Node, width> in_vtk_order(const std::array<Node, width>& nodes) {
  if constexpr (width == 6) return vtk_wedge_order(nodes);
  return nodes;
}

/// "12 (hexahedron)"; of cells of higher order "22 (triangle of second order)", and "205 (triangle of order
/// 3)" in the numbers that SU2 has for those.
std::string vtk_cell_name(std::int64_t type);

}  // namespace quadloop
