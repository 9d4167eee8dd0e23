#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What a .qmesh file says of itself in its head, lines of text; its numbers follow as raw bytes.
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
  };

  std::int64_t nodes = 0;
  std::int64_t node_bytes = 4;  ///< of a node's number: 4 or 8
  std::vector<Block> blocks;
  std::vector<BoundaryHead> boundaries;
  std::int64_t constants = 0;
  std::vector<std::string> variables, cell_variables;
  std::string strips = {};  ///< the comments that a .mesh has for them

  std::int64_t triangles() const;
  std::int64_t quads() const;
  std::int64_t edges() const;
  /// Of all that follows the head.
  std::int64_t bytes_of_numbers() const;
};

/// The first line of every such file, its line end included; behind it "header N": the bytes of all lines.
inline constexpr std::string_view binary_first_line = "quadloop binary mesh 1\n";

/// Where nodes are too many for 32 bits, node_bytes says so.
std::int64_t node_bytes_for(std::int64_t nodes);

/// The head as a file has it. Line ends and other control characters in names become "_".
std::string text_of(const BinaryHeader& header);

/// The way back, from the lines of a file of `size` bytes. Throws InputError "path:line: ..." where a line
/// is not what it should be, and where the numbers of which it tells are not as many bytes as the file has.
BinaryHeader header_of_text(const std::string& text, std::int64_t size, const std::string& path);

}  // namespace quadloop
