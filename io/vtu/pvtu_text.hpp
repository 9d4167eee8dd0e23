#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// What a parallel VTK file lists: arrays that each piece has, and the pieces' files.
struct PvtuList {
  std::vector<std::string> point_data;                 ///< reals
  std::vector<std::string> cell_marks = {"boundary"};  ///< whole numbers
  std::vector<std::string> cell_data;                  ///< reals
  std::vector<std::string> sources;
};

/// The text of a .pvtu file.
std::string pvtu_text(const PvtuList& list);

/// Of a .pvtu file with one piece, the piece's: "NAME_0.vtu" beside "NAME.pvtu".
std::string pvtu_piece_path(const std::string& path);

}  // namespace quadloop
