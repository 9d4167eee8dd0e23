#pragma once

#include <cstdint>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// Turns cells that are inside out, as files of other programs have them that number a prism's nodes in
/// another order: so that any two cells with a common face have it in opposite directions, and so that in
/// each piece (cells that hang together over faces of two cells) the signed volumes add up to more than zero.
/// A cell is therefore as its neighbours have it: one that moved nodes have inverted stays inverted. Pieces
/// that no directions suit stay as they are; check_solid() reports them. The number of cells turned. The
/// nodes that cells and patches name must exist. O(n log n); linear where all volumes are positive.
std::int64_t orient_solid(FileMesh& mesh);

}  // namespace quadloop
