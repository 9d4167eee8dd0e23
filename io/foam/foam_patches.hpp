#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

/// A patch of a polyMesh.
struct FoamPatch {
  std::string name, type;
  std::string physical_type = {};            ///< empty if not specified in the file
  std::int64_t first_face = -1, faces = -1;  ///< -1 if not specified in the file
  std::vector<std::int32_t> cells = {};      ///< of its faces, by foam_patch_cells()
};

/// Returns the condition of patches of a type: "none" for those that OpenFOAM's field files specify.
BoundaryCondition condition_of_foam_type(std::string_view type);

/// Reads the patches in a file `boundary`. Throws InputError.
std::vector<FoamPatch> read_foam_boundary(const std::string& path);

/// Reads the cell of each face in a file `owner` or `neighbour`; cells must be below `end`. Throws
/// InputError.
std::vector<std::int32_t> read_foam_labels(const std::string& path, std::int64_t end);

/// A cell zone.
struct FoamZone {
  std::string name;
  std::vector<std::int32_t> cells;
};

/// Reads the zones in a file `cellZones`; their cells must be below `end`. Throws InputError.
std::vector<FoamZone> read_foam_zones(const std::string& path, std::int64_t end);

/// Reads the patches of the polyMesh in a folder, for this number of cells, with the cells at their faces. On
/// the calling rank only. Throws InputError.
std::vector<FoamPatch> read_foam_patches(const std::string& folder, std::int64_t cells);

}  // namespace quadloop::io
