#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/node/method.hpp"
#include "smoother/objective/condition_number.hpp"
#include "smoother/objective/objective.hpp"

namespace quadloop {

/// How a mesh is smoothed.
struct SmoothOptions {
  int sweeps = 20;  ///< at most; fewer where nothing moves any more
  Objective objective = Objective::power;
  Method method = Method::perturb;
  /// Nodes of cells that cost no more stay, unless they share a cell with a node of one that does.
  double threshold = 0.05;
  /// First moves lines where squares of two sizes meet, which lifts 26.6 degrees to 29.7.
  bool level_lines = true;
  double bad = 0.072;  ///< nodes of parallelograms stay unless a cell that costs more is near; one below 28
                       ///< degrees does
  const Geometry* geometry = nullptr;  ///< the outline that boundary nodes slide along; without it they slide
                                       ///< where the mesh's own is straight
  /// For each segment of the geometry on which layers end the height of the last one, 0 for others; or none
  /// at all. Nodes there are spread evenly, and the cells beside them brought to a height near it.
  std::vector<double> front_heights;
  NodeFlags pinned;                        ///< a flag for each owned node that must stay, or none at all
  std::function<TieRank(Point)> delaunay;  ///< if set, the mesh is Delaunay under this order of nodes, and is
                                           ///< made so again by flips in the end
  /// Of each own triangle, or none: flips keep edges between two blocks.
  std::vector<std::int32_t> triangle_to_block;
  bool keep_slots = true;  ///< triangles made by flips take the slots in the order that become free, else
                           ///< those beside them; not with blocks
  std::optional<MirrorAxis> mirror;  ///< the mesh is its own mirror image in this axis, and stays so
  std::vector<CellTarget> targets;  ///< the shape of each own cell, triangles, then quads; or none at all for
                                    ///< ideal ones; with any, angles may get smaller. Not with `delaunay`
};

}  // namespace quadloop
