#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/mesh/field.hpp"
#include "mesher/solid/point3.hpp"

namespace quadloop {

/// Faces of the outside under one name.
struct SolidPatch {
  static constexpr std::int32_t no_node = -1;
  using Face = std::array<std::int32_t, 4>;  ///< in turn; the last is no_node in a triangle

  std::string name, condition = "none";
  std::vector<Face> faces;
  bool is_empty = false;     ///< an end of a plane mesh that is one cell thick ("empty" in OpenFOAM)
  bool is_periodic = false;  ///< its nodes have partners on another patch ("cyclic" in OpenFOAM)
};

/// A 3D mesh as a file gives it, whole on one rank. Nodes from 0; those of a cell in the order of CGNS: the
/// first three or four counter-clockwise as seen from the others, which follow in the same order.
struct SolidMesh {
  std::vector<Point3> points;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::vector<std::array<std::int32_t, 5>> pyramids;
  std::vector<std::array<std::int32_t, 6>> prisms;
  std::vector<std::array<std::int32_t, 8>> hexahedra;
  std::vector<SolidPatch> patches;
  std::optional<Field> solution;  ///< rows of cells stand in the order of the kinds above
  /// Where there are several blocks their names, and of each cell, in the order of the kinds above, its place
  /// among them; else empty.
  std::vector<std::string> block_names;
  std::vector<std::int32_t> cell_to_block;
  std::vector<std::string> warnings;  ///< what the reader left out, with the file's name
};

/// The cells with so many nodes: tetrahedra, pyramids, prisms or hexahedra.
template <std::size_t width, class SolidMeshOrConst>
auto& cells_of(SolidMeshOrConst& mesh) {
  static_assert(width == 4 || width == 5 || width == 6 || width == 8);
  if constexpr (width == 4) return mesh.tetrahedra;
  if constexpr (width == 5) return mesh.pyramids;
  if constexpr (width == 6) return mesh.prisms;
  if constexpr (width == 8) return mesh.hexahedra;
}

/// Calls `visit.operator()<width>()` for the four widths, in the order of the kinds above.
template <class Visit>
void for_each_kind_of_cell(const Visit& visit) {
  visit.template operator()<4>();
  visit.template operator()<5>();
  visit.template operator()<6>();
  visit.template operator()<8>();
}

}  // namespace quadloop
