#pragma once

// Inside io/cgns only.
#include <cstddef>

#include "io/cgns/cgns_handle.hpp"
#include "io/model/file_mesh.hpp"

namespace quadloop {

/// The elements of a kind of cells; their nodes are in the order of FileMesh.
template <CellKind kind>
inline constexpr ElementType_t cgns_type_of = kind == CellKind::triangle      ? TRI_3
                                              : kind == CellKind::quad        ? QUAD_4
                                              : kind == CellKind::tetrahedron ? TETRA_4
                                              : kind == CellKind::pyramid     ? PYRA_5
                                              : kind == CellKind::prism       ? PENTA_6
                                                                              : HEXA_8;

/// The number of nodes of an element, and its dimensions.
struct CgnsShape {
  std::size_t width = 0;
  int dimension = 0;
};

/// None (width 0) of elements that are no bars and no cells of ours.
inline CgnsShape shape_of_cgns(int type) {
  if (type == BAR_2) return {2, 1};
  CgnsShape shape;
  for_each_kind([&]<CellKind kind>() {
    if (type == cgns_type_of<kind>) shape = {cell_width<kind>, kind <= CellKind::quad ? 2 : 3};
  });
  return shape;
}

}  // namespace quadloop
