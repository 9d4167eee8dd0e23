#pragma once

#include "smoother/node/node_solver.hpp"

namespace quadloop::smoother {

/// The perturbations of Section 3.7 of the thesis: steps along the normals of the opposite edges, then along
/// the node's own edges, then along the axes. If none improves the node, the step length is reduced.
class Perturbation : public NodeSolver {
 public:
  std::optional<Point> improve(const Star& star, Point p, Objective objective) override;
};

}  // namespace quadloop::smoother
