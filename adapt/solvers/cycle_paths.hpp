#pragma once

#include <fmt/format.h>

#include <string>

#include "flow/postprocess/history.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "io/formats.hpp"
#include "io/tree/tree_file.hpp"

namespace quadloop::adapt {

/// Returns the name of a cycle's folder, in the folder of its run.
inline std::string cycle_name(int cycle) { return fmt::format("cycle_{:02}", cycle); }

/// Paths of the files in a cycle's folder.
struct CyclePaths {
  static constexpr const char* mesh_stem = "mesh";

  std::string folder;

  /// Name, in the folder, of the mesh with its solution in this format.
  static std::string mesh_name(const std::string& format) { return mesh_stem + ("." + format); }
  std::string mesh(const std::string& format) const { return folder + "/" + mesh_name(format); }
  /// Common prefix of these paths.
  std::string stem() const { return folder + "/" + mesh_stem; }
  /// The restart file.
  std::string native_mesh() const { return mesh(io::native_format().name); }
  std::string tree() const { return folder + "/" + mesh_stem + io::tree_suffix; }
  /// The geometry of the mesh, for a later design cycle.
  std::string outline() const { return stem() + ".geom"; }
  std::string walls() const { return folder + "/" + mesh_stem + flow::wall_table_suffix; }
  std::string history() const { return folder + "/" + mesh_stem + flow::history_suffix; }
  /// Interpolation error and target size of each cell.
  std::string estimate() const { return stem() + ".estimate.vtu"; }
  std::string record() const { return folder + "/record.json"; }
  std::string log() const { return folder + "/log.txt"; }
};

}  // namespace quadloop::adapt
