#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/run_in_folder.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Start of `adapt --from`: a solved mesh with its tree, and the geometry stored with them.
struct FormerMesh {
  std::string mesh_file, tree_file;
  std::string outline_file;         ///< empty if there is none
  TreeRecord tree;                  ///< this rank's part
  std::vector<Chain> chains;        ///< of the geometry, on every rank
  std::optional<Geometry> outline;  ///< their closed loops; none if they end on each other, as inner lines do
  adapt::CaseSettings settings = {};  ///< of the case that the mesh was made for; empty: not known
  std::vector<std::string> warnings = {};
};

/// Finds the files of `from`: the folder of a run (its last complete cycle is taken) or of a cycle, or a mesh
/// with its tree. Reads the tree and the geometry. Throws InputError. *Collective.*
FormerMesh find_former_mesh(const Communicator& comm, const std::string& from);

/// Reads the mesh and its solution. `former` must outlive the result; its tree is moved out. With `morph_to`,
/// the cells are to be kept on the changed geometry (`file`, for messages) by a case with these settings.
/// Throws InputError if mesh and tree do not belong together. *Collective.*
adapt::DesignStart read_start(const Communicator& comm, FormerMesh& former, std::optional<double> morph_to,
                              const std::string& file, const adapt::CaseSettings& settings);

}  // namespace quadloop
