#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// The header of a .qmesh file, lines of text, which is followed by numbers as raw bytes.
struct BinaryHeader {
  struct Block {
    std::string name;
    std::int64_t triangles = 0, quads = 0;
  };
  struct BoundaryHead {
    std::string name;
    BoundaryCondition condition;
    std::int64_t edges = 0;
    WallLayers layers = {};
    bool inner_line = false;
  };

  std::int64_t nodes = 0;
  std::int64_t node_bytes = 4;  ///< bytes of a node number: 4 or 8
  std::vector<Block> blocks;
  std::vector<BoundaryHead> boundaries;
  std::int64_t constants = 0;
  std::vector<std::string> variables, cell_variables;
  std::string comments = {};  ///< strips, pairs and named nodes as in a .mesh file

  std::int64_t triangles() const;
  std::int64_t quads() const;
  std::int64_t edges() const;
  /// Returns the size of everything after the header.
  std::int64_t bytes_of_numbers() const;
};

/// The first line of every such file, including its line end; it is followed by "header N", the size of all
/// lines in bytes.
inline constexpr std::string_view binary_first_line = "quadloop binary mesh 1\n";

/// Returns 8 if the nodes exceed 32-bit numbers, else 4.
std::int64_t node_bytes_for(std::int64_t nodes);

/// Returns the header as text. Line ends and other control characters in names become "_".
std::string text_of(const BinaryHeader& header);

/// Parses the lines of a file of `size` bytes. Throws InputError "path:line: ..." for an invalid line, and if
/// the size of the numbers does not match that of the file.
BinaryHeader header_of_text(const std::string& text, std::int64_t size, const std::string& path);

}  // namespace quadloop::io
