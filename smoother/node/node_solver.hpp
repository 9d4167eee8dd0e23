#pragma once

#include <memory>
#include <optional>

#include "smoother/node/method.hpp"
#include "smoother/objective/star.hpp"

namespace quadloop::smoother {

/// The present cost of a star and the rule for accepting a new position: the largest corner cost and the
/// smallest angle must not get worse, and the node's cost must fall.
class Acceptance {
 public:
  Acceptance(const StarCost<1>& now) : now_{now} {}

  template <int places>
  bool accepts(const StarCost<places>& cost, int place) const {
    return cost.valid[place] && cost.largest_defect[place] <= now_.largest_defect[0] &&
           cost.largest_cotangent[place] <= now_.largest_cotangent[0] &&
           cost.objective[place] < worthwhile * now_.objective[0];
  }
  /// Index of the accepted position with the lowest cost among the first `count`, the first of equal ones; -1
  /// if there is none.
  template <int places>
  int best(const StarCost<places>& cost, int count) const {
    int best = -1;
    for (int k = 0; k < count; ++k) {
      if (accepts(cost, k) && (best < 0 || cost.objective[k] < cost.objective[best])) best = k;
    }
    return best;
  }

 private:
  /// A smaller gain does not justify new visits to the neighbours.
  static constexpr double worthwhile = 1 - 1e-4;
  StarCost<1> now_;
};

/// Searches for a better position for a node whose star is valid.
class NodeSolver {
 public:
  virtual ~NodeSolver() = default;
  /// A position that passes Acceptance, or none. Depends on its arguments only.
  virtual std::optional<Point> improve(const Star& star, Point p, Objective objective) = 0;
};

std::unique_ptr<NodeSolver> make_node_solver(Method method);

}  // namespace quadloop::smoother
