#pragma once

#include <string>

#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// A mesh with its quadtree and solution. The mesh cells are in the order of the quadtree cells. A mesh cell,
/// its quadtree cell and its nodes may be on different ranks.
struct SolvedMesh {
  Mesh mesh;
  TreeRecord tree;
  Field solution;  ///< values at owned nodes and, optionally, in cells; no variables if nothing is solved yet
  std::string file;  ///< file of the solution, for messages
};

}  // namespace quadloop::adapt
