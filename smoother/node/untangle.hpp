#pragma once

#include <optional>
#include <vector>

#include "smoother/node/node_solver.hpp"

namespace quadloop {

/// Whether a star with inverted corners is better with its node elsewhere: no sound corner is lost, and the
/// sum of -J over the inverted ones falls. Of two such places the better one is that of the smaller sum or,
/// by the thesis's objective, of the smaller cost by Eq. 3.4.
class UntanglingRule {
 public:
  UntanglingRule(const Star& star, Point p, Objective objective);
  bool accepts(Point to) const;
  bool prefers(Point a, Point b) const;
  /// What falls: the sum of -J, then the number of inverted corners.
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

/// A better place for a node whose star has inverted corners, the best of some by UntanglingRule; none if no
/// candidate is.
std::optional<Point> untangle(const Star& star, Point p, Objective objective);

/// The place where the smallest distance from the lines through the opposite edges, to their left, is
/// largest: inside all corners if any place is (Freitag and Plassmann 2000). The star must go all round its
/// node.
Point deepest_point(const Star& star, Point p);

/// The acceptable ones among a batch of places, the best first: by Acceptance where the star is valid at p,
/// else by UntanglingRule.
std::vector<int> ranked_places(const Star& star, Point p, Objective objective, const Star::Batch& x,
                               const Star::Batch& y);

}  // namespace quadloop
