#include "smoother/node/perturbation.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace quadloop::smoother {

namespace {

constexpr std::array<double, 4> steps{0.16, 0.08, 0.04, 0.01};  ///< in mean edge lengths of the node
constexpr int most_moves = 3;                                   ///< per visit

Point unit(Point v) {
  const double norm = length(v);
  return norm > 0 ? (1 / norm) * v : v;
}

/// Whether this is the corner of a cell at p; each cell has one.
bool is_own(const StarCorner& c) { return c.angle == CellAngle::all || c.angle == CellAngle::at_p; }

enum class Direction { normals, edges, axes };

std::vector<Point> directions_of(const Star& star, Point p, Direction kind) {
  if (kind == Direction::axes) return {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  std::vector<Point> directions;
  directions.reserve(star.corners().size());
  for (const StarCorner& c : star.corners()) {
    if (!is_own(c)) continue;
    const Point along = c.r - c.q;
    directions.push_back(unit(kind == Direction::edges ? c.q - p : Point{-along.y, along.x}));
  }
  return directions;
}

/// The best accepted step of this length, if any.
std::optional<Point> best_step(const Star& star, Point p, Objective objective, const Acceptance& acceptance,
                               const std::vector<Point>& directions, double step) {
  std::optional<Point> best;
  double lowest = 0;
  for (std::size_t begin = 0; begin < directions.size(); begin += Star::batch) {
    const int count = static_cast<int>(std::min<std::size_t>(Star::batch, directions.size() - begin));
    Star::Batch x = Star::Batch::Constant(p.x), y = Star::Batch::Constant(p.y);
    for (int k = 0; k < count; ++k) {
      x[k] += step * directions[begin + k].x;
      y[k] += step * directions[begin + k].y;
    }
    const auto cost = star.cost(x, y, objective);
    const int k = acceptance.best(cost, count);
    if (k < 0 || (best && cost.objective[k] >= lowest)) continue;
    best = Point{x[k], y[k]};
    lowest = cost.objective[k];
  }
  return best;
}

}  // namespace

std::optional<Point> Perturbation::improve(const Star& star, Point p, Objective objective) {
  std::optional<Point> found;
  const double edge = std::sqrt(star.reference(p));
  int moves = 0;
  std::size_t step = 0;
  while (step < steps.size() && moves < most_moves) {
    const Acceptance acceptance(star.cost(p, objective));
    std::optional<Point> better;
    for (const Direction kind : {Direction::normals, Direction::edges, Direction::axes}) {
      better = best_step(star, p, objective, acceptance, directions_of(star, p, kind), steps[step] * edge);
      if (better) break;
    }
    if (!better) {
      ++step;
      continue;
    }
    found = better;
    p = *better;
    ++moves;
  }
  return found;
}

}  // namespace quadloop::smoother
