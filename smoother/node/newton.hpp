#pragma once

#include "smoother/node/perturbation.hpp"

namespace quadloop::smoother {

/// Takes Newton steps towards the minimum of the 3-norm of the corners' defects, while the predicted gain
/// justifies a move. Each step must pass Acceptance. If the first step is refused, it tries eight points
/// along and beside the step, and, in stars with sharp angles, perturbations. The 3-norm leaves more good
/// cells than the 4-norm, whose power is Objective::power. For the thesis's objective, which is not smooth,
/// only perturbations are used.
class Newton : public NodeSolver {
 public:
  std::optional<Point> improve(const Star& star, Point p, Objective objective) override;

 private:
  Perturbation perturbation_;
};

}  // namespace quadloop::smoother
