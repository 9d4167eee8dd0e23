#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/solid/point3.hpp"

namespace quadloop {

/// Faces of the outside under one name.
struct SolidPatch {
  static constexpr std::int32_t no_node = -1;
  using Face = std::array<std::int32_t, 4>;  ///< in turn; the last is no_node in a triangle

  std::string name, condition = "none";
  std::vector<Face> faces;
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
  std::vector<std::string> warnings;  ///< what the reader left out, with the file's name
};

}  // namespace quadloop
