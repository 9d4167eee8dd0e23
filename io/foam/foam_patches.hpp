#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadloop {

/// A patch of a polyMesh.
struct FoamPatch {
  std::string name, type;
  std::int64_t first_face = -1, faces = -1;  ///< -1 where the file does not tell it
  std::vector<std::int32_t> cells = {};      ///< of its faces, by foam_patch_cells()
};

/// The patches that a file `boundary` lists. Throws InputError.
std::vector<FoamPatch> read_foam_boundary(const std::string& path);

/// The cell that each face belongs to, or that is behind it: the files `owner` and `neighbour`; each is below
/// `end`. Throws InputError.
std::vector<std::int32_t> read_foam_labels(const std::string& path, std::int64_t end);

/// A zone of cells.
struct FoamZone {
  std::string name;
  std::vector<std::int32_t> cells;
};

/// The zones that a file `cellZones` lists; their cells are below `end`. Throws InputError.
std::vector<FoamZone> read_foam_zones(const std::string& path, std::int64_t end);

/// The patches of the polyMesh in a folder, of so many cells, with the cells at their faces. On the calling
/// rank alone. Throws InputError.
std::vector<FoamPatch> read_foam_patches(const std::string& folder, std::int64_t cells);

}  // namespace quadloop
