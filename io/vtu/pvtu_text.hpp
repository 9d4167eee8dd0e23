#pragma once

#include <string>
#include <vector>

namespace quadloop::io {

/// Contents of a parallel VTK file: arrays of each piece, and the pieces' files.
struct PvtuList {
  std::vector<std::string> point_data;                 ///< reals
  std::vector<std::string> cell_flags = {"boundary"};  ///< integers
  std::vector<std::string> cell_data;                  ///< reals
  std::vector<std::string> sources;
};

/// Returns the text of a .pvtu file.
std::string pvtu_text(const PvtuList& list);

/// Returns the piece of a .pvtu file with one piece: "NAME_0.vtu" for "NAME.pvtu".
std::string pvtu_piece_path(const std::string& path);

}  // namespace quadloop::io
