#pragma once

#include <string>

#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// A mesh with its tree and what a solver left at its nodes. Cells stand in the order of the tree's leaves;
/// the shares of leaves, cells and nodes that a rank has need not meet.
struct SolvedMesh {
  Mesh mesh;
  TreeRecord tree;
  Field
      solution;  ///< a row for each owned node, for each cell; without variables where nothing is solved yet
  std::string file;  ///< where the solution was read, for messages
};

}  // namespace quadloop
