#pragma once

// Inside io/vtu only: what tells the boundaries of a VTK file apart.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_document.hpp"

namespace quadloop {

/// A number for each cell, by which the elements of boundaries belong to one of them.
struct VtuBoundaryNumbers {
  std::vector<std::int64_t> of_cells;  ///< empty where the file has none
  bool is_ours = false;                ///< the cell data "boundary": 0 is no number
  std::string warning;                 ///< without the file's name; empty where there is none
};

/// The cell data "boundary", or else those by which meshio, Gmsh and others number physical groups, where
/// they differ on elements of the types from `first_type` to `last_type`. A warning says what was taken, or
/// that nothing tells several such elements apart.
VtuBoundaryNumbers find_boundary_numbers(const VtuDocument& document, const VtuNumbers& numbers,
                                         const std::vector<std::int64_t>& types, std::int64_t first_type,
                                         std::int64_t last_type);

/// The name of a boundary by such a number: that of the field data which meshio keeps for a physical group of
/// this dimension, else "boundary_<number>".
std::string vtu_group_name(const VtuDocument& document, const VtuNumbers& numbers, std::int64_t number,
                           std::int64_t dimension);

}  // namespace quadloop
