#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// One rank's part of a solution from a file, with what the file contains of its mesh: an even share of the
/// rows of nodes, in the order of the file, and the cells of the mesh. Names are words (distinct_words()), to
/// be found by variable().
struct LoadedSolution {
  std::string path;
  Field solution;
  std::int64_t nodes = 0;          ///< of all ranks
  std::optional<LoadedMesh> mesh;  ///< mesh of the file, without its solution; empty for a table of values
  std::vector<Point> points;       ///< of the rows of such a table, if it has coordinates
};

}  // namespace quadloop::io
