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

/// Options of smoothing.
struct SmoothOptions {
  int sweeps = 20;  ///< maximum number; fewer if nothing moves any more
  Objective objective = Objective::power;
  Method method = Method::perturb;
  /// Cost threshold: a node moves only if it, or a node of one of its cells, belongs to a cell above it, and
  /// only within three rings of the cells that are above it at the start.
  double threshold = 0.05;
  /// First moves lines where squares of two sizes meet, which raises angles of 26.6 degrees to 29.7.
  bool level_transitions = true;
  double bad = 0.072;  ///< nodes of parallelograms stay unless a cell that costs more (an angle below 28
                       ///< degrees) is near
  /// Boundary nodes slide along it; without it along straight parts of the mesh boundary.
  const Geometry* geometry = nullptr;
  /// Height of the last layer at each segment of the geometry where layers end, 0 for other segments; may be
  /// empty. Nodes there are spread evenly, and the adjacent cells are fitted to this height.
  std::vector<double> front_heights;
  NodeFlags pinned;                        ///< flags the owned nodes that must stay; may be empty
  std::function<TieRank(Point)> delaunay;  ///< if set, the mesh is Delaunay under this order of nodes, and
                                           ///< flips restore this at the end
  /// Block of each owned triangle (empty: one block); edges between blocks are not flipped.
  std::vector<std::int32_t> triangle_to_block;
  /// A slot is the position of a triangle in the global order. True: triangles made by flips take the slots
  /// of removed ones, one each, in the order of the slots. False: they are stored next to a removed triangle
  /// with the same first node, so a slot may hold none or several; not with blocks.
  bool keep_slots = true;
  std::optional<MirrorAxis> mirror;  ///< the mesh is mirror-symmetric in this axis, and stays so
  /// Target shape of each owned cell, triangles first, then quadrilaterals; empty: ideal shapes. With targets
  /// angles may decrease. Not with `delaunay`.
  std::vector<CellTarget> targets;
};

}  // namespace quadloop
