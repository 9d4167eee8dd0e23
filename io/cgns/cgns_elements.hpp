#pragma once

// For io/cgns only.
#include <cstddef>

#include "io/cgns/cgns_handle.hpp"
#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// CGNS element type of a kind of cells; the node order is that of FileMesh.
template <CellKind kind>
inline constexpr ElementType_t cgns_type_of = kind == CellKind::triangle      ? TRI_3
                                              : kind == CellKind::quad        ? QUAD_4
                                              : kind == CellKind::tetrahedron ? TETRA_4
                                              : kind == CellKind::pyramid     ? PYRA_5
                                              : kind == CellKind::prism       ? PENTA_6
                                                                              : HEXA_8;

/// Number of nodes and dimension of an element.
struct CgnsShape {
  std::size_t width = 0;
  int dimension = 0;
};

/// Returns width 0 for elements that are neither bars nor supported cells.
inline CgnsShape shape_of_cgns(int type) {
  if (type == BAR_2) return {2, 1};
  CgnsShape shape;
  for_each_kind([&]<CellKind kind>() {
    if (type == cgns_type_of<kind>) shape = {cell_width<kind>, kind <= CellKind::quad ? 2 : 3};
  });
  return shape;
}

}  // namespace quadloop::io
