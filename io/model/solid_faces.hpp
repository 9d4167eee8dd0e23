#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <span>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// A face where a cell has it, or a patch, known by its nodes whatever their order.
struct FaceMention {
  std::array<std::int32_t, 3> others;  ///< its nodes without the lowest one, ascending; the last is none in a
                                       ///< triangle
  std::int32_t owner;                  ///< the cell, numbered as for_each_cell() does, or -1 - patch
  std::int32_t number;                 ///< which of that cell's, or patch's, faces it is

  friend auto operator<=>(const FaceMention&, const FaceMention&) = default;
};

/// Calls `visit` once for each face, with its lowest node and whoever has it: patches first, then cells
/// ascending. Faces come by ascending lowest node. The nodes that cells and patches name must exist.
/// O(n log n).
void for_each_face(const FileMesh& mesh,
                   const std::function<void(std::int32_t lowest, std::span<const FaceMention>)>& visit);

}  // namespace quadloop
