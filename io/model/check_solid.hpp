#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// What every 3D mesh obeys.
enum class SolidRule {
  indices,    ///< cells and faces name existing nodes, none twice; coordinates are finite
  positive,   ///< volumes are positive
  conforming  ///< each face of a cell is that of one other cell, or on exactly one patch
};
const char* name_of(SolidRule rule);

/// One broken rule at one place.
struct SolidFault {
  SolidRule rule;
  std::string what;
  Point3 place;
};

struct PatchFigures {
  std::string name;
  std::int64_t faces = 0;
  double area = 0;
};

struct BlockFigures {
  std::string name;
  std::int64_t cells = 0;
  double volume = 0;
};

struct SolidFigures {
  double volume = 0;
  double least_volume = 0;  ///< of a cell; 0 without cells
  Point3 least_place;       ///< the middle of that cell
  std::vector<PatchFigures> patches;
  std::vector<BlockFigures> blocks;  ///< where there are several
  std::vector<SolidFault> faults;    ///< the first few of each rule
  std::int64_t all_faults = 0;
};

/// Volumes are those within flat faces, quads cut along a diagonal. Where connectivity or coordinates make no
/// sense the later rules are not looked at. Linear in time and memory.
SolidFigures check_solid(const FileMesh& mesh);

}  // namespace quadloop
