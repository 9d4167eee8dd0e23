#include "smoother/node/nlopt_solver.hpp"

#include <cmath>
#include <nlopt.hpp>

#include "mesher/base/ids.hpp"

namespace quadloop::smoother {

namespace {

/// Rowan's subplex: the fastest of twelve NLopt algorithms compared, and none gives better cells
/// (docs/notes/smoothing-studies.md).
constexpr nlopt::algorithm algorithm = nlopt::LN_SBPLX;

constexpr int most_evaluations = 20;
constexpr double tolerance = 1e-3;  ///< relative, of the cost
/// Search range in mean edge lengths of the node, in both directions along each axis.
constexpr double search_reach = 0.5;

struct Problem {
  const Star* star = nullptr;
  Objective objective = Objective::power;
  double edge = 1;
  Point centre;
};

/// The cost, and the gradient if requested, at x: the offset from the present position in mean edge lengths.
double cost_of(unsigned, const double* x, double* slope, void* data) {
  const Problem& problem = *static_cast<const Problem*>(data);
  const Point p = problem.centre + problem.edge * Point{x[0], x[1]};
  const StarCost<1> cost = problem.star->cost(p, problem.objective);
  if (!cost.valid[0]) {  // a barrier as high as any cost (see Objective), with its gradient away from the
                         // node's present position
    const double barrier = size32(problem.star->corners());
    if (slope != nullptr) {
      slope[0] = x[0];
      slope[1] = x[1];
    }
    return barrier + 0.5 * (x[0] * x[0] + x[1] * x[1]);
  }
  Point gradient;
  const double value =
      slope == nullptr ? cost.objective[0] : problem.star->cost_and_gradient(p, problem.objective, gradient);
  if (slope != nullptr) {
    slope[0] = problem.edge * gradient.x;
    slope[1] = problem.edge * gradient.y;
  }
  return value;
}

}  // namespace

struct NloptSolver::Impl {
  Problem problem;
  nlopt::opt optimiser{algorithm, 2};
  std::vector<double> x{0, 0};
};

NloptSolver::NloptSolver() : impl_{std::make_unique<Impl>()} {
  nlopt::opt& o = impl_->optimiser;
  o.set_min_objective(cost_of, &impl_->problem);
  o.set_lower_bounds(-search_reach);
  o.set_upper_bounds(search_reach);
  o.set_ftol_rel(tolerance);
  o.set_maxeval(most_evaluations);
  o.set_initial_step(0.1);
}

NloptSolver::~NloptSolver() = default;

std::optional<Point> NloptSolver::improve(const Star& star, Point p, Objective objective) {
  Problem& problem = impl_->problem;
  problem = {&star, objective, std::sqrt(star.reference(p)), p};
  std::vector<double>& x = impl_->x;
  x.assign(2, 0.0);
  double value = 0;
  try {
    impl_->optimiser.optimize(x, value);
  } catch (const std::runtime_error&) {
    // the library stopped because of rounding: the best point so far is checked like any other
  }
  const Acceptance acceptance(star.cost(p, objective));
  for (int halving = 0; halving < 4; ++halving) {
    const Point candidate = p + problem.edge * Point{x[0], x[1]};
    if (acceptance.accepts(star.cost(candidate, objective), 0)) return candidate;
    x[0] *= 0.5;
    x[1] *= 0.5;
  }
  return std::nullopt;
}

}  // namespace quadloop::smoother
