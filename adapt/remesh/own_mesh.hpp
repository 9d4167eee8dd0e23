#pragma once

#include <string>

#include "adapt/remesh/demands/solved_mesh.hpp"

namespace quadloop {

/// Throws InputError unless a mesh has as many nodes and cells as the tree's. `shown` names the mesh, `tree`
/// the tree.
void require_counts(const MeshCounts& of_mesh, const TreeAttributes& of_tree, const std::string& shown,
                    const std::string& tree);

/// Whether a whole mesh is the one that the tree was saved with, to the last bit.
bool is_mesh_of_tree(const Mesh& whole, const TreeAttributes& tree);

/// Throws InputError on all ranks unless the mesh can be the one that the tree was saved with: as many nodes
/// and cells, and all nodes where they lay, as a morphed mesh has them, or each leaf's cells within two leaf
/// sizes of it, which snapping, flips and smoothing keep, but for cells in layers, which belong to leaves on
/// the front: other formats round. `shown` names the mesh, `tree` the tree. *Collective.*
void require_own_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                      const std::string& tree);

/// The same, and that every node lies where it lay, to the last bit: for native files of ours. *Collective.*
void require_untouched_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                            const std::string& tree);

}  // namespace quadloop
