#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/morph/morph_mesh.hpp"
#include "adapt/remesh/remesh.hpp"

namespace quadloop::adapt {

/// Result of morphing a mesh to a changed geometry.
struct MorphedMesh {
  std::optional<RemeshedSolution>
      remeshed;         ///< old cells on the input's geometry, values moved with their nodes
  std::string refusal;  ///< reason for failure; empty if the geometry has not changed
};

/// Request to keep the cells of a mesh on a changed geometry.
struct MorphWish {
  double least_quality = 0;  ///< least quality of the worst cell outside layers
  std::string file;          ///< file of the new geometry, for messages
  /// Geometry of the solved mesh, if available, and its file (OutlineChange).
  const Geometry* from = nullptr;
  std::string from_file = {};
  /// The same as chains, for meshes with blocks or inner lines (OutlinePieces).
  const std::vector<Chain>* from_chains = nullptr;
  /// Boundary settings that have changed since the mesh was made, for messages; empty: none, or not known.
  std::string changed = {};
};

/// Morphs the solved mesh to the input's geometry if that differs from the tree's. The result is accepted if
/// it is valid and its worst cell outside layers has at least the requested quality. The tree is kept, for
/// the mesh as it is now; the next generated mesh does not depend on the morphing. *Collective.*
MorphedMesh morph_solved(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                         const MorphWish& wish);

/// Returns the warning for a mesh that could not be morphed as requested.
std::string why_anew(const MorphWish& wish, const std::string& refusal);

/// Returns the solved mesh on the input's geometry with its solution and no cell flagged: the mesh itself if
/// geometry and case are unchanged; morphed, if requested and possible; else generated from the tree, with
/// the solution transferred. The mesh report gains a warning that says why the mesh was generated again, or
/// that cells of other settings are kept. *Collective.*
RemeshedSolution continued_mesh(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                                const std::optional<MorphWish>& wish, TransferKind transfer);

}  // namespace quadloop::adapt
