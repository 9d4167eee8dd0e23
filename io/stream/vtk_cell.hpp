#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// VTK's numbers of cell types.
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

/// Converts the nodes of a prism from the order of FileMesh (CGNS) to that of VTK and SU2, and back: the
/// normal of the first triangle of a VTK wedge points outwards (documentation of vtkWedge).
template <class Node>
std::array<Node, 6> vtk_wedge_order(const std::array<Node, 6>& n) {
  return {n[0], n[2], n[1], n[3], n[5], n[4]};
}

/// Returns the nodes of any cell in VTK's order.
template <class Node, std::size_t width>
std::array<Node, width> in_vtk_order(const std::array<Node, width>& nodes) {
  if constexpr (width == 6) return vtk_wedge_order(nodes);
  return nodes;
}

/// Returns "12 (hexahedron)"; for higher-order cells "22 (triangle of second order)", and "205 (triangle of
/// order 3)" for SU2's numbers of those.
std::string vtk_cell_name(std::int64_t type);

}  // namespace quadloop::io
