#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/run_in_folder.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// What `adapt --from` begins with: a solved mesh with its tree, and the outline kept beside them.
struct FormerMesh {
  std::string mesh_file, tree_file;
  std::string outline_file;         ///< empty: there is none
  TreeRecord tree;                  ///< this rank's share
  std::optional<Geometry> outline;  ///< on every rank
  CaseSettings settings = {};       ///< of the case that it was made for; empty: not known
  std::vector<std::string> warnings = {};
};

/// Finds the files of `from`: the folder of a run, of which the last whole cycle counts, or of a cycle, or a
/// mesh beside its tree; reads the tree and the outline. Throws InputError. *Collective.*
FormerMesh find_former_mesh(const Communicator& comm, const std::string& from);

/// Reads the mesh and its flow. `former` must outlive what is returned; its tree is moved out. With
/// `morph_to` cells are to be kept on the outline in `file`, for messages, by a case with these settings.
/// Throws InputError where mesh and tree do not belong together. *Collective.*
DesignStart read_start(const Communicator& comm, FormerMesh& former, std::optional<double> morph_to,
                       const std::string& file, const CaseSettings& settings);

}  // namespace quadloop
