#pragma once

#include <cstdint>
#include <limits>

namespace quadloop {

/// What is to become of a leaf's wanted level.
enum class Mark : std::int8_t { coarsen = -1, keep = 0, refine = 1 };

/// A leaf is refined where its indicator is above `refine`; else coarsened where it is below `coarsen`. The
/// defaults mark nothing.
struct Thresholds {
  double refine = std::numeric_limits<double>::infinity();
  double coarsen = 0;
};

}  // namespace quadloop
