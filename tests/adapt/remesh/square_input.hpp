#pragma once

#include "generate/generate.hpp"

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

/// The same as one tree: 1 / size leaves along each side.
inline MeshInput square_of_one_tree(double size) {
  MeshInput input = square_input(size);
  input.mesh.size.root = RootOptions{{0, 0}, 1, 1, 1};
  return input;
}

}  // namespace quadloop::test
