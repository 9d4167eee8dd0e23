#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/geometry/measured_flow.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A quadtree cell (leaf) as stored in the tree file.
struct LeafRecord {
  std::int32_t tree_x = 0, tree_y = 0;  ///< column and row of its tree in the brick of trees
  std::int32_t x = 0, y = 0;            ///< lower left corner in its tree, whose edge is 2^30
  std::int8_t level = 0;                ///< edge = tree edge / 2^level
  std::int8_t wanted = 0;               ///< level requested by case, geometry and adaptation
  std::int16_t block = 0;               ///< block of its cells, from 1; 0: outside the domain
  std::int32_t triangles = 0, quads = 0;
  /// Bit l is set if adaptation requested to split the quadtree cell of level l that contains this cell.
  std::uint32_t adapted = 0;
};

/// Whether the quadtree cell has mesh cells. Those outside the domain have none, and no sensor value.
inline bool has_cells(const LeafRecord& leaf) { return leaf.triangles + leaf.quads > 0; }

/// Attributes in the tree file of the whole tree and of the mesh made from it.
struct TreeAttributes {
  double root_x = 0, root_y = 0, tree_edge = 0;
  std::int32_t trees_x = 1, trees_y = 1;
  double gradation = 1.5;
  std::uint64_t geometry_digest = 0, case_digest = 0;
  std::int64_t nodes = 0, triangles = 0, quads = 0;
  std::uint64_t coordinate_digest = 0;
  /// Upper right corner of the root, if it is not bitwise root + trees times edge.
  std::optional<Point> root_far = {};
};

/// Returns the root, bitwise.
inline Box root_box(const TreeAttributes& a) {
  const Point low{a.root_x, a.root_y};
  return {low, a.root_far.value_or(low + Point{a.trees_x * a.tree_edge, a.trees_y * a.tree_edge})};
}

/// Consecutive triangles or quads of one block, in the order of the quadtree cells.
struct BlockRun {
  std::int64_t corners = 3;  ///< of each cell: 3 or 4
  std::int64_t block = 0;    ///< index of the block
  std::int64_t cells = 0;
};

/// One rank's quadtree cells, in the order of the space-filling curve; ranks are ordered along it.
struct TreeRecord {
  TreeAttributes attributes;
  std::vector<LeafRecord> leaves;
  MeasuredFlow measured = {};  ///< what layers follow; all of it on every rank
  /// The blocks of all mesh cells, triangles, then quads: files store the cells block by block. Empty if the
  /// domain is one block; all of it on every rank.
  std::vector<BlockRun> block_runs = {};
};

}  // namespace quadloop
