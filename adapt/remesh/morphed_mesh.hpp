#pragma once

#include <optional>
#include <string>

#include "adapt/morph/morph_mesh.hpp"
#include "adapt/remesh/remesh.hpp"

namespace quadloop {

/// What became of the wish to keep a mesh's cells on a changed outline.
struct MorphedMesh {
  std::optional<CarriedMesh> carried;  ///< the old cells on the input's outline, values with their nodes
  std::string refusal;                 ///< why there is none; empty where the outline has not changed
};

/// Morphs the solved mesh to the input's outline, `file` in messages, if that is another than the tree's. It
/// is taken if its worst cell outside layers has at least the quality `least_quality` and it is valid. The
/// tree stays, for the mesh as it is now; so the next mesh that is made anew is made as if nothing had been
/// morphed. *Collective.*
MorphedMesh morph_solved(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                         double least_quality, const std::string& file);

}  // namespace quadloop
