#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// Arguments of the commands that generate a mesh.
struct CaseArguments {
  io::CaseSource source;
  std::vector<std::string> assignments;  ///< of --set
  std::string geometry;                  ///< replaces the case's geometry files; empty: the case's
  std::optional<TreeAttributes> saved;   ///< of the tree of a restart, whose root is kept
};

/// The settings of a case, with its geometry assembled.
struct CaseInput {
  Settings settings;  ///< on other ranks than the first, without what the geometry files change in it
  std::optional<MeshInput> mesh;
  std::vector<FileExtent> extents;        ///< of the geometry files; on the first rank only
  std::vector<std::string> part_formats;  ///< of partitions, if the case requests them
};

/// Reads the case on every rank, and its geometry on the first one; the ranks of a node share its memory.
/// Throws InputError; `warnings` then contains, on the first rank, the warnings issued before the error.
/// *Collective.*
CaseInput load_case(const Communicator& comm, const CaseArguments& arguments, Warnings& warnings);

/// Returns the limit on mesh size: `max_cells` if given, else free memory. *Collective.*
MeshLimit mesh_limit(const Communicator& comm, const std::optional<double>& max_cells);

}  // namespace quadloop
