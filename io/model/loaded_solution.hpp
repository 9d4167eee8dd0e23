#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// A solution from a file, whole on one rank, with what the file contains of its mesh. Names are words
/// (distinct_words()), to be found by variable().
struct LoadedSolution {
  std::string path;
  Field solution;
  std::int64_t nodes = 0;          ///< rows of the solution
  std::optional<LoadedMesh> mesh;  ///< mesh of the file, without its solution; empty for a table of values
  std::vector<Point> points;       ///< of such a table, if it has coordinates
};

}  // namespace quadloop::io
