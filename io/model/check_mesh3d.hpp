#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// Rules that every 3D mesh satisfies.
enum class Mesh3dRule {
  indices,    ///< cells and faces refer to existing nodes, without repetition; coordinates are finite
  positive,   ///< volumes are positive
  conforming  ///< each face of a cell belongs to one other cell, or to exactly one patch
};
const char* name_of(Mesh3dRule rule);

/// A violated rule with its location.
struct Mesh3dFault {
  Mesh3dRule rule;
  std::string what;
  Point3 place;
};

struct PatchStatistics {
  std::string name;
  std::int64_t faces = 0;
  double area = 0;
};

struct BlockStatistics {
  std::string name;
  std::int64_t cells = 0;
  double volume = 0;
};

struct Mesh3dStatistics {
  double volume = 0;
  double least_volume = 0;  ///< of a cell; 0 without cells
  Point3 least_place;       ///< centre of that cell
  std::vector<PatchStatistics> patches;
  std::vector<BlockStatistics> blocks;  ///< if there are several
  std::vector<Mesh3dFault> faults;      ///< the first few of each rule
  std::int64_t all_faults = 0;
};

/// Checks a 3D mesh. Volumes are those within flat faces, quads split along a diagonal. If connectivity or
/// coordinates are invalid, the later rules are skipped. Linear in time and memory.
Mesh3dStatistics check_mesh3d(const FileMesh& mesh);

}  // namespace quadloop::io
