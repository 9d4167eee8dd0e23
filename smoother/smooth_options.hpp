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

namespace quadloop::smoother {

/// Options of smoothing.
struct SmoothOptions {
  int sweeps = 20;  ///< maximum number; fewer if nothing moves any more
  Objective objective = Objective::power;
  Method method = Method::perturb;
  /// Cost threshold: a node may move only if the node or a neighbour belongs to a cell whose cost exceeds it,
  /// and only within three rings of the cells that exceed it initially.
  double threshold = 0.05;
  /// First shifts the grid lines where cells of two quadtree levels meet; the angles of 26.6 degrees there
  /// become 29.7 degrees.
  bool level_transitions = true;
  double bad = 0.072;  ///< nodes of parallelograms are fixed unless a nearby cell has a cost above this value
                       ///< (an angle below 28 degrees)
  /// Boundary nodes slide along this geometry; if null, only along straight parts of the mesh boundary.
  const Geometry* geometry = nullptr;
  /// For each segment of the geometry that is the outer edge of layers: the height of the last layer; 0 for
  /// other segments; may be empty. Nodes on these segments are spaced evenly, and the adjacent cells are
  /// fitted to this height.
  std::vector<double> front_heights;
  NodeFlags pinned;                        ///< flags the owned nodes that must stay; may be empty
  std::function<TieRank(Point)> delaunay;  ///< if set, the mesh is Delaunay, with cocircular nodes ordered
                                           ///< by this rank; final flips restore this
  /// Block of each owned triangle (empty: one block); edges between blocks are not flipped.
  std::vector<std::int32_t> triangle_to_block;
  /// True: each triangle created by an edge flip takes the global position of a removed triangle. False: it
  /// is stored next to a removed triangle with the same first node, so one position may hold no or several
  /// triangles; this cannot be combined with `triangle_to_block`.
  bool keep_slots = true;
  std::optional<MirrorAxis>
      mirror;  ///< the mesh is symmetric about this axis; smoothing preserves the symmetry
  /// Target shape of each owned cell, triangles first, then quadrilaterals; empty: ideal shapes. With targets
  /// the smallest angle may decrease. Not with `delaunay`.
  std::vector<CellTarget> targets;
};

}  // namespace quadloop::smoother
