#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// A solution as a file gives it, whole on one rank, with what the file says of its mesh. Names are words
/// (distinct_words()); variable() finds one.
struct LoadedSolution {
  std::string path;
  Field solution;
  std::int64_t nodes = 0;          ///< rows of the solution
  std::optional<LoadedMesh> mesh;  ///< the file's, its solution taken out; none in a table of values alone
  std::vector<Point> points;       ///< of such a table, where it has coordinates
};

}  // namespace quadloop
