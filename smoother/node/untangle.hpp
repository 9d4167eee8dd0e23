#pragma once

#include <optional>
#include <vector>

#include "smoother/node/node_solver.hpp"

namespace quadloop::smoother {

/// Decides whether moving the node improves a star with inverted corners: no valid corner may become
/// inverted, and the sum of -J over the inverted ones must fall. Of two accepted positions the one with the
/// smaller sum is better or, with the thesis's objective, the one with the smaller cost by Eq. 3.4.
class UntanglingRule {
 public:
  UntanglingRule(const Star& star, Point p, Objective objective);
  bool accepts(Point to) const;
  bool prefers(Point a, Point b) const;
  /// The measure to be reduced: the sum of -J, then the number of inverted corners.
  struct Tangle {
    double inversion = 0;
    std::ptrdiff_t inverted = 0;
    friend auto operator<=>(const Tangle&, const Tangle&) = default;
  };
  Tangle tangle(Point p) const;

 private:
  const Star& star_;
  Objective objective_;
  double reference_;
  std::vector<char> sound_;
  Tangle now_;
};

/// The best of several candidate positions by UntanglingRule, for a node whose star has inverted corners;
/// none if no candidate is accepted.
std::optional<Point> untangle(const Star& star, Point p, Objective objective);

/// The position with the largest minimum distance to the left of the lines through the opposite edges. It is
/// inside all corners if any position is (Freitag and Plassmann 2000). The star must surround its node.
Point deepest_point(const Star& star, Point p);

/// Indices of the acceptable positions of a batch, the best first: by Acceptance if the star is valid at p,
/// else by UntanglingRule.
std::vector<int> ranked_places(const Star& star, Point p, Objective objective, const Star::Batch& x,
                               const Star::Batch& y);

}  // namespace quadloop::smoother
