#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// The mesh that a tree was saved with, to the last bit: the tree keeps a digest of its coordinates. On the
/// root alone; `known` on every rank.
struct TreeMesh {
  bool known = false;
  Mesh whole;                         ///< empty where the solved mesh is the tree's own to the last bit
  const Geometry* outline = nullptr;  ///< that it was made for, where it is at hand: one of the inputs'
  bool is_solved = false;             ///< on the root alone
};

/// Whether a whole mesh is the one that the tree was saved with, to the last bit.
bool is_mesh_of_tree(const Mesh& whole, const TreeAttributes& tree);

/// Looks for it: first `solved`, the root's mesh that a solution came with, then what `find()` returns on the
/// root, as from files; else it is made anew from the tree and the one of the inputs that has the tree's
/// outline and case. Not known where none leads to it: case or outline has changed since. *Collective.*
TreeMesh mesh_of_tree(const Communicator& comm, const TreeRecord& tree, const Mesh& solved,
                      const std::function<std::optional<Mesh>()>& find, std::span<const MeshInput> inputs);

/// Settles on which mesh a solution counts. `loaded`, on the calling rank alone, is the mesh that the
/// solution's file `path` came with. Where the tree's mesh is known, the nodes of the file must be within
/// 1e-6 of a local edge of its own, and those take their place, with its cells; or they must be its own
/// smoothed (fault_of_smoothed()). Where it is not known the cells must be valid. Throws InputError that
/// names the file and the node, or the reason.
void settle_mesh(const TreeMesh& of_tree, Mesh& loaded, const std::string& path);

}  // namespace quadloop
