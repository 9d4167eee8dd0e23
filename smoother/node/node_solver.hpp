#pragma once

#include <memory>
#include <optional>

#include "smoother/node/method.hpp"
#include "smoother/objective/star.hpp"

namespace quadloop {

/// The cost of a star as it is, which a new place must better: the largest corner cost and the smallest angle
/// no worse, the cost of the node lower.
class Acceptance {
 public:
  Acceptance(const StarCost<1>& now) : now_{now} {}

  template <int places>
  bool accepts(const StarCost<places>& cost, int place) const {
    return cost.valid[place] && cost.largest_defect[place] <= now_.largest_defect[0] &&
           cost.largest_cotangent[place] <= now_.largest_cotangent[0] &&
           cost.objective[place] < worthwhile * now_.objective[0];
  }
  /// The accepted place of the lowest cost among the first `count`; -1 if there is none. Of equal ones the
  /// first.
  template <int places>
  int best(const StarCost<places>& cost, int count) const {
    int best = -1;
    for (int k = 0; k < count; ++k) {
      if (accepts(cost, k) && (best < 0 || cost.objective[k] < cost.objective[best])) best = k;
    }
    return best;
  }

 private:
  static constexpr double worthwhile = 1 - 1e-4;  ///< a smaller gain is not worth the neighbours' new visits
  StarCost<1> now_;
};

/// Finds a better place for a node whose star is valid.
class NodeSolver {
 public:
  virtual ~NodeSolver() = default;
  /// A place that Acceptance takes, or none. A function of its arguments alone.
  virtual std::optional<Point> improve(const Star& star, Point p, Objective objective) = 0;
};

std::unique_ptr<NodeSolver> make_node_solver(Method method);

}  // namespace quadloop
