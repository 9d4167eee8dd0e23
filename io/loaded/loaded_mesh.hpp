#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What a solver keeps at the nodes of a mesh: `values` holds one row of names.size() numbers for each owned
/// node.
struct Solution {
  std::vector<double>
      constants;  ///< iteration, time, Mach number: whatever the solver keeps; the same on all ranks
  std::vector<std::string> names;
  std::vector<double> values;
};

/// A whole mesh as a file gives it, on one rank: every node is owned.
struct LoadedMesh {
  Mesh mesh;
  std::int32_t blocks = 1;
  std::vector<std::int32_t> triangle_to_block, quad_to_block;  ///< from 0; a block's cells follow each other
  std::vector<std::string> block_names;
  std::optional<Solution> solution;
  std::vector<std::string> warnings;  ///< what the reader turned round or left out, with the file's name
};

/// The cells of one block, which follow each other.
template <class Cell>
std::span<const Cell> cells_of_block(const std::vector<Cell>& cells,
                                     const std::vector<std::int32_t>& cell_to_block, std::int32_t block) {
  const auto [first, last] = std::equal_range(cell_to_block.begin(), cell_to_block.end(), block);
  return std::span(cells).subspan(static_cast<std::size_t>(first - cell_to_block.begin()),
                                  static_cast<std::size_t>(last - first));
}

}  // namespace quadloop
