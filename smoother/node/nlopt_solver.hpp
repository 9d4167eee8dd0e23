#pragma once

#include <memory>

#include "smoother/node/node_solver.hpp"

namespace quadloop::smoother {

/// Minimises the node's cost with NLopt; the result is used if Acceptance passes it.
class NloptSolver : public NodeSolver {
 public:
  NloptSolver();
  ~NloptSolver() override;
  std::optional<Point> improve(const Star& star, Point p, Objective objective) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadloop::smoother
