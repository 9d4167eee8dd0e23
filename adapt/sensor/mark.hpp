#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace quadloop {

/// What is to become of a leaf's wanted level.
enum class Mark : std::int8_t { coarsen = -1, keep = 0, refine = 1 };

/// A leaf is refined where its indicator is above `refine`; else coarsened where it is below `coarsen`. The
/// defaults mark nothing.
struct Thresholds {
  double refine = std::numeric_limits<double>::infinity();
  double coarsen = 0;
};

/// Of all ranks' leaves.
struct MarkReport {
  double mean = 0, deviation = 0;  ///< of log10 of the indicator, see IndicatorStatistics
  std::int64_t refined = 0, coarsened = 0;
  Thresholds thresholds;
};

/// One mark for each leaf of this rank's share.
struct MarkedLeaves {
  std::vector<Mark> marks;
  MarkReport report;
};

}  // namespace quadloop
