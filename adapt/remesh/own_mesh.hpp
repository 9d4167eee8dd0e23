#pragma once

#include <string>

#include "adapt/remesh/demands/solved_mesh.hpp"

namespace quadloop::adapt {

/// Throws InputError unless the mesh has as many nodes and cells as the tree records. `shown` names the mesh,
/// `tree` the tree.
void require_counts(const MeshCounts& of_mesh, const TreeAttributes& of_tree, const std::string& shown,
                    const std::string& tree);

/// Whether a mesh, of which each rank has an even share, is bitwise the one that the tree was saved with.
/// *Collective.*
bool is_mesh_of_tree(const Communicator& comm, const Mesh& mesh, const TreeAttributes& tree);

/// Throws InputError on all ranks unless the mesh can be the one that the tree was saved with: equal numbers
/// of nodes and cells, and either all nodes in place (as for a morphed mesh), or each quadtree cell's mesh
/// cells within two cell sizes of it, which holds after snapping, flips and smoothing. Cells in layers are
/// exempt, as they belong to quadtree cells at the outer edge. Other file formats may round coordinates.
/// `shown` names the mesh, `tree` the tree. *Collective.*
void require_own_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                      const std::string& tree);

/// The same, but every node must be bitwise in place: for native files. *Collective.*
void require_untouched_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown,
                            const std::string& tree);

}  // namespace quadloop::adapt
