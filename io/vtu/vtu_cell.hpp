#pragma once

#include <cstdint>

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

}  // namespace quadloop
