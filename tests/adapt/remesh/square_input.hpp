#pragma once

#include "mesher/generate/generate.hpp"

namespace quadloop::test {

/// The unit square, its boundary "side" a wall, in leaves of one size.
inline MeshInput square_input(double size) {
  MeshInput input{{{{"side", 0, 30, "wall"}},
                   {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                   {0, 4},
                   std::vector<BoundaryId>(4, BoundaryId{0})},
                  {},
                  {},
                  0};
  input.mesh.size.min = input.mesh.size.max = size;
  return input;
}

}  // namespace quadloop::test
