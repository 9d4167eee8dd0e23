#pragma once

// Inside io/vtu only: what tells the boundaries of a VTK file apart.
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_document.hpp"

namespace quadloop {

/// A number for each cell, by which the elements of boundaries belong to one of them.
struct VtuBoundaryNumbers {
  std::vector<std::int64_t> of_cells;  ///< empty where the file has none
  bool is_ours = false;                ///< the cell data "boundary": 0 is no number
  std::string warning;                 ///< without the file's name; empty where there is none
  /// Of other programs' numbers: meshio keeps the name of a physical group as field data.
  std::unordered_map<std::int64_t, std::string> names = {};

  /// Of another program's number; "boundary_<number>" where the file gives none.
  std::string name_of(std::int64_t number) const;
};

/// The cell data "boundary", or else those by which meshio, Gmsh and others number physical groups, where
/// they differ on elements of the types from `first_type` to `last_type`. A warning says what was taken, or
/// that nothing tells several such elements apart.
VtuBoundaryNumbers find_boundary_numbers(const VtuDocument& document, const VtuNumbers& numbers,
                                         const std::vector<std::int64_t>& types, std::int64_t first_type,
                                         std::int64_t last_type);

}  // namespace quadloop
