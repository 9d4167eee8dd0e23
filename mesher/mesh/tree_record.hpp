#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/geometry/measured_wall.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// One leaf as the tree file keeps it.
struct LeafRecord {
  std::int32_t tree_x = 0, tree_y = 0;  ///< its tree's column and row in the brick
  std::int32_t x = 0, y = 0;            ///< its lower left corner in its tree, a tree's edge being 2^30
  std::int8_t level = 0;                ///< edge = tree edge / 2^level
  std::int8_t wanted = 0;               ///< the level that case, geometry and adaptation ask for
  std::int16_t block = 0;               ///< of its cells, from 1 on; 0: outside the domain
  std::int32_t triangles = 0, quads = 0;
  std::uint32_t adapted = 0;  ///< bit l: adaptation asked to split the quadrant of level l that holds it
};

/// Whether a leaf has cells; those outside the domain have none, and sensors say nothing of them.
inline bool has_cells(const LeafRecord& leaf) { return leaf.triangles + leaf.quads > 0; }

/// What the tree file says of the whole tree and of the mesh made from it.
struct TreeAttributes {
  double root_x = 0, root_y = 0, tree_edge = 0;
  std::int32_t trees_x = 1, trees_y = 1;
  double gradation = 1.5;
  std::uint64_t geometry_digest = 0, case_digest = 0;
  std::int64_t nodes = 0, triangles = 0, quads = 0;
  std::uint64_t coordinate_digest = 0;
  /// The root's upper right corner where it is not root + trees times edge, to the bit.
  std::optional<Point> root_far = {};
};

/// The root, to the bit.
inline Box root_box(const TreeAttributes& a) {
  const Point low{a.root_x, a.root_y};
  return {low, a.root_far.value_or(low + Point{a.trees_x * a.tree_edge, a.trees_y * a.tree_edge})};
}

/// One rank's leaves, in the order of the space-filling curve; ranks follow each other along it.
struct TreeRecord {
  TreeAttributes attributes;
  std::vector<LeafRecord> leaves;
  MeasuredWall measured_wall = {};  ///< that first heights of layers follow; all of it on every rank
};

}  // namespace quadloop
