#include "smoother/node/newton.hpp"

#include <array>
#include <cmath>

namespace quadloop::smoother {

namespace {

constexpr int most_newton_moves = 3;  ///< per visit
constexpr double newton_reach =
    0.08;  ///< longest step in mean edge lengths of the node; longer ones give worse cells
constexpr double least_gain = 1e-4;    ///< relative gain of the objective that Acceptance requires
constexpr double further_gain = 0.05;  ///< predicted gain required for a further move in one visit
constexpr double flattest = 1e-3;      ///< ratio of curvatures below which a gradient step is taken
constexpr double cotangent_of_32 = 1.600334529041051;  ///< stars with smaller angles justify a longer search
/// Trial points for a refused step, as fractions along the step and to its left; evaluated together.
constexpr std::array<Point, Star::batch> ways{
    {{0.6, 0}, {0.3, 0}, {0.1, 0}, {0.03, 0}, {0.3, 0.25}, {0.3, -0.25}, {0.05, 0.14}, {0.05, -0.14}}};

struct NewtonMove {
  Point by;
  double gain = 0;  ///< relative decrease of the sum of cubes predicted by the quadratic model
};

/// Steps to the minimum of a quadratic model of the cube root of the sum of cubes, which is closer to
/// quadratic than the sum itself. Up to a factor its second derivatives are those of the sum minus 2/3 of the
/// squared gradient over the sum. Steps against the gradient where the model has no minimum.
NewtonMove newton_step(const StarModel& m) {
  const Point g = m.gradient;
  const double longest = newton_reach * std::sqrt(m.reference), share = 2 / (3 * m.cubes);
  const double xx = m.xx - share * g.x * g.x, xy = m.xy - share * g.x * g.y, yy = m.yy - share * g.y * g.y;
  const double determinant = xx * yy - xy * xy, trace = xx + yy;
  const bool is_bowl = trace > 0 && determinant > flattest * trace * trace;
  Point by = is_bowl ? (-1 / determinant) * Point{yy * g.x - xy * g.y, xx * g.y - xy * g.x} : -1.0 * g;
  const double norm = length(by);
  if (!(norm > 0)) return {};
  if (!is_bowl || norm > longest) by = (longest / norm) * by;
  const double bend = xx * by.x * by.x + 2 * xy * by.x * by.y + yy * by.y * by.y;
  return {by, (-dot(g, by) - 0.5 * std::max(bend, 0.0)) / m.cubes};
}

/// The best accepted point along and beside the step, before its end.
std::optional<Point> short_of(const Star& star, Point p, Point by, const Acceptance& acceptance) {
  Star::Batch x, y;
  for (int k = 0; k < Star::batch; ++k) {
    x[k] = p.x + ways[k].x * by.x - ways[k].y * by.y;
    y[k] = p.y + ways[k].x * by.y + ways[k].y * by.x;
  }
  const int best = acceptance.best(star.cost(x, y, Objective::power), Star::batch);
  if (best < 0) return std::nullopt;
  return Point{x[best], y[best]};
}

}  // namespace

std::optional<Point> Newton::improve(const Star& star, Point p, Objective objective) {
  if (objective != Objective::power) return perturbation_.improve(star, p, objective);
  StarModel now = star.model(p);
  std::optional<Point> found;
  for (int move = 0; move < most_newton_moves; ++move) {
    const NewtonMove step = newton_step(now);
    if (!(step.gain > (found ? further_gain : least_gain))) break;
    const Acceptance acceptance(now.cost);
    const StarModel then = star.model(p + step.by);
    if (!acceptance.accepts(then.cost, 0)) {
      if (!found) found = short_of(star, p, step.by, acceptance);
      break;
    }
    found = p = p + step.by;
    now = then;
  }
  const bool is_sharp = now.cost.largest_cotangent[0] > cotangent_of_32;
  return found || !is_sharp ? found : perturbation_.improve(star, p, objective);
}

}  // namespace quadloop::smoother
