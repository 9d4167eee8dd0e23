#pragma once

#include <cstdint>
#include <limits>

namespace quadloop::adapt {

/// Refinement flag of a leaf.
enum class RefinementFlag : std::int8_t { coarsen = -1, keep = 0, refine = 1 };

/// A leaf is refined if its indicator is above `refine`, else coarsened if it is below `coarsen`. The
/// defaults mark nothing.
struct Thresholds {
  double refine = std::numeric_limits<double>::infinity();
  double coarsen = 0;
};

}  // namespace quadloop::adapt
