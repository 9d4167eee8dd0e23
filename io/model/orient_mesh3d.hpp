#pragma once

#include <cstdint>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// Reverses inverted cells, e.g. from programs that number a prism's nodes in another order, such that two
/// cells have a common face in opposite directions, and the signed volumes of each component (cells connected
/// by faces of two cells) have a positive sum. The orientation of a cell is thus consistent with its
/// neighbours: one that was inverted by moved nodes remains inverted. Components without a consistent
/// orientation are unchanged; check_mesh3d() reports them. Returns the number of reversed cells. The nodes of
/// cells and patches must exist. O(n log n); linear if all volumes are positive.
std::int64_t orient_mesh3d(FileMesh& mesh);

}  // namespace quadloop::io
