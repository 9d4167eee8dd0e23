#pragma once

#include "smoother/node/perturbation.hpp"

namespace quadloop {

/// Newton's steps towards the least 3-norm of the corners' defects, for as long as they promise more than a
/// move is worth, each taken where Acceptance takes it; where the first one is refused, the best of eight
/// places on the way and beside it, and in stars with sharp angles perturbations. The norm is the third, not
/// the fourth, whose power Objective::power is: that leaves more cells good. Perturbations alone for the
/// thesis's objective, which has kinks.
class Newton : public NodeSolver {
 public:
  std::optional<Point> improve(const Star& star, Point p, Objective objective) override;

 private:
  Perturbation perturbation_;
};

}  // namespace quadloop
