#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/loaded/loaded_mesh.hpp"

namespace quadloop {

/// A solution as a file gives it, whole on one rank, with what the file says of its mesh. Names are words
/// (distinct_words()); variable() finds one.
struct LoadedSolution {
  std::string path;
  Field solution;
  std::int64_t nodes = 0;     ///< rows of the solution
  std::vector<Point> points;  ///< empty where the file has no coordinates
  bool has_cells = false;
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<std::array<NodeId, 4>> quads;
};

}  // namespace quadloop
