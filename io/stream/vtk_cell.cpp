#include "io/stream/vtk_cell.hpp"

namespace quadloop::io {

namespace {

const char* vtk_first_order_name(std::int64_t type) {
  switch (type) {
    case vtk_vertex: return "vertex";
    case vtk_poly_vertex: return "vertices";
    case vtk_line: return "line";
    case 4: return "polyline";
    case vtk_triangle: return "triangle";
    case 6: return "strip of triangles";
    case vtk_polygon: return "polygon";
    case vtk_pixel: return "pixel";
    case vtk_quad: return "quadrilateral";
    case vtk_tetrahedron: return "tetrahedron";
    case vtk_voxel: return "voxel";
    case vtk_hexahedron: return "hexahedron";
    case vtk_wedge: return "prism";
    case vtk_pyramid: return "pyramid";
    case 42: return "polyhedron";
    default: return "";
  }
}

/// Returns the linear cell type of a higher-order one.
std::int64_t straight_type(std::int64_t type) {
  switch (type) {
    case 21:
    case 35:
    case 68:
    case 75: return vtk_line;
    case 22:
    case 34:
    case 69:
    case 76: return vtk_triangle;
    case 23:
    case 28:
    case 30:
    case 70:
    case 77: return vtk_quad;
    case 24:
    case 71:
    case 78: return vtk_tetrahedron;
    case 25:
    case 29:
    case 33:
    case 72:
    case 79: return vtk_hexahedron;
    case 26:
    case 31:
    case 32:
    case 73:
    case 80: return vtk_wedge;
    case 27:
    case 37:
    case 74:
    case 81: return vtk_pyramid;
    case 36: return vtk_polygon;
    default: return 0;
  }
}

}  // namespace

std::string vtk_cell_name(std::int64_t type) {
  std::string number = std::to_string(type);
  if (const std::string name = vtk_first_order_name(type); !name.empty()) return number + " (" + name + ")";
  if (const std::string name = vtk_first_order_name(straight_type(type)); !name.empty())
    return number + " (" + name + (type < 68 ? " of second order)" : " of higher order)");
  const std::string name = vtk_first_order_name(type % 100);
  if (type > 100 && type < 10000 && !name.empty())
    return number + " (" + name + " of order " + std::to_string(type / 100 + 1) + ")";
  return number;
}

}  // namespace quadloop::io
