#pragma once

// For io/vtu only: identifies the boundaries of a VTK file.
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_document.hpp"

namespace quadloop::io {

/// A number for each cell that assigns boundary elements to boundaries.
struct VtuBoundaryNumbers {
  std::vector<std::int64_t> of_cells;  ///< empty if the file has none
  bool is_ours = false;                ///< whether it is the cell data "boundary", where 0 means none
  std::string warning;                 ///< without the file's name; empty if there is none
  /// For other programs' numbers: meshio stores the names of physical groups as field data.
  std::unordered_map<std::int64_t, std::string> names = {};

  /// Returns the name for another program's number; "boundary_<number>" if the file has none.
  std::string name_of(std::int64_t number) const;
};

/// Finds the cell data "boundary", or else those in which meshio, Gmsh and others store physical groups, if
/// they differ on elements of the types from `first_type` to `last_type`. The warning says which were used,
/// or that several such elements cannot be distinguished.
VtuBoundaryNumbers find_boundary_numbers(const VtuDocument& document, const VtuNumbers& numbers,
                                         const std::vector<std::int64_t>& types, std::int64_t first_type,
                                         std::int64_t last_type);

}  // namespace quadloop::io
