#pragma once

#include <fmt/format.h>

#include <string>

#include "flow/quantities/history.hpp"
#include "flow/quantities/wall_table.hpp"
#include "io/formats.hpp"
#include "io/tree/tree_file.hpp"

namespace quadloop {

/// Of a cycle's folder, in the folder of its run.
inline std::string cycle_name(int cycle) { return fmt::format("cycle_{:02}", cycle); }

/// Where the files stand that quadloop writes in a cycle's folder.
struct CyclePaths {
  static constexpr const char* mesh_stem = "mesh";

  std::string folder;

  /// The mesh with its flow, in the format of this name: in the folder.
  static std::string mesh_name(const std::string& format) { return mesh_stem + ("." + format); }
  std::string mesh(const std::string& format) const { return folder + "/" + mesh_name(format); }
  /// What the names of all of them begin with.
  std::string stem() const { return folder + "/" + mesh_stem; }
  /// The one that a run goes on from.
  std::string native_mesh() const { return mesh(native_format().name); }
  std::string tree() const { return folder + "/" + mesh_stem + tree_suffix; }
  /// The outline as it was meshed, where a design cycle is to go on from it.
  std::string outline() const { return stem() + ".geom"; }
  std::string walls() const { return folder + "/" + mesh_stem + wall_table_suffix; }
  std::string history() const { return folder + "/" + mesh_stem + history_suffix; }
  /// Interpolation error and wanted size of each cell.
  std::string estimate() const { return stem() + ".estimate.vtu"; }
  std::string record() const { return folder + "/record.json"; }
  std::string log() const { return folder + "/log.txt"; }
};

}  // namespace quadloop
