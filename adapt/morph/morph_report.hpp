#pragma once

#include <cstdint>
#include <string>

#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// Result of a morph, over all ranks.
struct MorphReport {
  /// quality_of() the worst cell outside layers, from 0 to 1 for the best shape; negative: inverted.
  double worst_before = 0, worst_after = 0;
  double largest_move = 0;  ///< of a node
  std::int64_t moved = 0;   ///< number of nodes
  bool smoothed = false;    ///< whether cells had to be smoothed; then the nodes have no derivative
  /// Fraction of the motion up to which no cell is inverted, or worse than the required quality, before
  /// smoothing.
  double possible_way = 1;
  Point worst_place;  ///< location of the first inversions if cells cannot follow: a node of the worst cell
  bool valid() const { return worst_after > 0; }
};

/// The fault of a morph that is not valid, with the location, for messages.
std::string text_of_inversion(const MorphReport& report);

/// Why nodes have no derivative on a geometry (its name, for messages) on which they were smoothed.
std::string text_of_smoothing(const std::string& geometry);

}  // namespace quadloop::adapt
