#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"
#include "mesher/geometry/periodic_pair.hpp"

namespace quadloop {

/// A pair as the case requests it.
struct WantedPair {
  PeriodicPair pair;
  std::string where;  ///< "file:line" of its table, for messages

  friend bool operator==(const WantedPair&, const WantedPair&) = default;
};

/// Replaces the boundary `to` of each pair by the image of `from`, with its points and curves: afterwards the
/// two agree to rounding. The end points that `to` shares with other boundaries move with it. Warns if they
/// differed by more than rounding. Throws InputError with boundary, place, distance and remedy if they differ
/// by more than 1e-5 of the length of `from`, or if one of them is not a single open line.
void match_outlines(Outline& outline, const std::vector<WantedPair>& pairs,
                    std::vector<std::string>& warnings);

}  // namespace quadloop
