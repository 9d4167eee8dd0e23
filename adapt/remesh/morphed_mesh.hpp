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

/// How far cells may be taken along, and what is known of the outlines.
struct MorphWish {
  double least_quality = 0;  ///< of the worst cell outside layers
  std::string file;          ///< of the new outline, for messages
  /// The outline that the solved mesh was made on, where it is at hand, and its file: OutlineChange.
  const Geometry* from = nullptr;
  std::string from_file = {};
  /// What boundaries are asked for now and were not by the case that the mesh was made for, for messages;
  /// empty: nothing, or it is not known.
  std::string changed = {};
};

/// Morphs the solved mesh to the input's outline if that is another than the tree's. It is taken if its worst
/// cell outside layers has at least the quality wished for and it is valid. The tree stays, for the mesh as
/// it is now; so the next mesh that is made anew is made as if nothing had been morphed. *Collective.*
MorphedMesh morph_solved(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                         const MorphWish& wish);

/// What a user is to be told where a mesh was not morphed as wished.
std::string why_anew(const MorphWish& wish, const std::string& refusal);

/// The solved mesh on the input's outline with its flow, and no leaf marked: the mesh itself where it is of
/// this outline and case; morphed, if that is wished and allowed; else made anew by the tree as it stands,
/// the flow carried over. Why it is made anew joins the warnings of the mesh's report, and where cells are
/// kept that other settings made, that. *Collective.*
CarriedMesh continued_mesh(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                           const std::optional<MorphWish>& wish, TransferKind transfer);

}  // namespace quadloop
