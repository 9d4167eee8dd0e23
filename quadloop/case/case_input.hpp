#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// What a command that meshes is told.
struct CaseArguments {
  std::string case_path;
  std::vector<std::string> assignments;  ///< of --set
  std::string geometry;                  ///< takes the place of the case's files; empty: the case's
  std::optional<TreeAttributes> saved;   ///< of the tree that is restarted: its root stays
};

/// A case as it was read, with the geometry in place.
struct CaseInput {
  Settings settings;
  std::optional<MeshInput> mesh;
  std::vector<FileExtent> extents;  ///< of the geometry files
};

/// Reads case and geometry. On the calling rank alone. Throws InputError; `warnings` then has those that came
/// before.
CaseInput load_case(const CaseArguments& arguments, Warnings& warnings);

/// What a mesh may cost: so many cells, or what free memory holds. *Collective.*
MeshLimit mesh_limit(const Communicator& comm, const std::optional<double>& max_cells);

}  // namespace quadloop
