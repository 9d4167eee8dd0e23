#pragma once

#include <memory>

#include "smoother/node/node_solver.hpp"

namespace quadloop {

/// Minimises the cost of the node with NLopt; what it finds is taken if it is acceptable.
class NloptSolver : public NodeSolver {
 public:
  NloptSolver();
  ~NloptSolver() override;
  std::optional<Point> improve(const Star& star, Point p, Objective objective) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadloop
