#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <span>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// An occurrence of a face in a cell or a patch; identified by its nodes in any order.
struct FaceMention {
  /// Its nodes without the lowest one, ascending; the last is no_node for a triangle.
  std::array<std::int32_t, 3> others;
  std::int32_t owner;   ///< cell, numbered as in for_each_cell(), or -1 - patch
  std::int32_t number;  ///< local number of the face in the cell or patch

  friend auto operator<=>(const FaceMention&, const FaceMention&) = default;
};

/// Calls `visit` once for each face, with its lowest node and all its occurrences: patches first, then cells
/// ascending. Faces are in ascending order of their lowest node. The nodes of cells and patches must exist.
/// O(n log n).
void for_each_face(const FileMesh& mesh,
                   const std::function<void(std::int32_t lowest, std::span<const FaceMention>)>& visit);

}  // namespace quadloop::io
