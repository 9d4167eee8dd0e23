#include "smoother/objective/star.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "mesher/base/error.hpp"

namespace quadloop {

double nodal_cost(double largest, double mean) {
  if (largest > 1) return largest * largest;
  const double blend = (std::tanh(5 * (largest - 1)) + 1) / 2;
  return blend * largest + (1 - blend) * mean;
}

namespace {

constexpr const char* no_cost = "an objective without a cost";
constexpr double no_cotangent = -std::numeric_limits<double>::infinity();

/// The largest cotangent of a triangle's angles that count, times J.
template <class Values>
Values counted_dot(CellAngle angle, const Values& uu, const Values& uv, const Values& vv) {
  switch (angle) {
    case CellAngle::at_p: return uv;
    case CellAngle::at_q: return uu - uv;
    case CellAngle::at_r: return vv - uv;
    case CellAngle::all: break;
  }
  if constexpr (std::is_same_v<Values, double>) {
    return std::max({uv, uu - uv, vv - uv});
  } else {
    return uv.max(uu - uv).max(vv - uv);
  }
}

}  // namespace

template <int places>
StarCost<places> Star::evaluate(const Eigen::Array<double, places, 1>& x,
                                const Eigen::Array<double, places, 1>& y, Objective objective) const {
  using Values = Eigen::Array<double, places, 1>;
  constexpr double flattest_squared = flattest_sine * flattest_sine;
  StarCost<places> cost;
  Values costs = Values::Zero(), squares = Values::Zero(), defects = Values::Zero();
  Values cotangents = Values::Constant(-std::numeric_limits<double>::infinity()),
         soundness = Values::Constant(1);
  for (const StarCorner& c : corners_) {
    const Values ux = c.q.x - x, uy = c.q.y - y, vx = c.r.x - x, vy = c.r.y - y;
    const Values uu = ux * ux + uy * uy, uv = ux * vx + uy * vy, vv = vx * vx + vy * vy,
                 jacobian = ux * vy - uy * vx;
    soundness = soundness.min(jacobian).min(jacobian * jacobian - flattest_squared * uu * vv);
    const Values defect = 1 - jacobian / (c.target.g11 * uu + 2 * c.target.g12 * uv + c.target.g22 * vv);
    const Values corner = defect * defect;
    costs += corner;
    squares += corner * corner;
    defects = defects.max(defect);
    cotangents = cotangents.max(counted_dot(c.angle, uu, uv, vv) / jacobian);
  }
  cost.valid = soundness > 0;
  cost.largest_defect = defects;
  cost.largest_cotangent = angles_count_ ? cotangents : Values::Constant(no_cotangent);
  switch (objective) {
    case Objective::power: cost.objective = squares; return cost;
    case Objective::thesis:
      for (int k = 0; k < places; ++k)
        cost.objective[k] =
            quadloop::nodal_cost(defects[k] * defects[k], costs[k] / static_cast<double>(corners_.size()));
      return cost;
  }
  QUADLOOP_REQUIRE(false, no_cost);
  return cost;
}

StarCost<Star::batch> Star::cost(const Batch& x, const Batch& y, Objective objective) const {
  return evaluate<batch>(x, y, objective);
}

StarCost<1> Star::cost(Point p, Objective objective) const {
  using One = Eigen::Array<double, 1, 1>;
  return evaluate<1>(One(p.x), One(p.y), objective);
}

namespace {

struct CostSlope {
  double cost = 0;
  Point gradient;
};

/// The cost of a corner that is not inverted, and how it changes with p.
CostSlope cost_slope(const StarCorner& c, Point p) {
  const CornerForm f = corner_form(p, c.q, c.r);
  const Point u = c.q - p, v = c.r - p;
  const double form = c.target.g11 * f.uu + 2 * c.target.g12 * f.uv + c.target.g22 * f.vv;
  const Point form_gradient = -2.0 * ((c.target.g11 + c.target.g12) * u + (c.target.g12 + c.target.g22) * v);
  const Point jacobian_gradient{c.q.y - c.r.y, c.r.x - c.q.x};
  const double ratio = f.jacobian / form, defect = 1 - ratio;
  return {defect * defect, (-2 * defect / form) * (jacobian_gradient - ratio * form_gradient)};
}

}  // namespace

double Star::power_and_gradient(Point p, Point& gradient) const {
  double value = 0;
  gradient = {};
  for (const StarCorner& c : corners_) {
    const auto [cost, slope] = cost_slope(c, p);
    value += cost * cost;
    gradient = gradient + 2 * cost * slope;
  }
  return value;
}

/// A corner's inverse condition number is r = J / F, J linear in p and F quadratic, with the same curvature
/// 2 s every way; so F grad grad r = -(grad r grad F + grad F grad r) - 2 s r. It adds (1 - r)^3.
StarModel Star::model(Point p) const {
  StarModel model;
  double squares = 0, defects = 0, cotangents = -std::numeric_limits<double>::infinity(), soundness = 1;
  for (const StarCorner& c : corners_) {
    const Point u = c.q - p, v = c.r - p;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), jacobian = cross(u, v);
    const double form = c.target.g11 * uu + 2 * c.target.g12 * uv + c.target.g22 * vv;
    soundness =
        std::min({soundness, jacobian, jacobian * jacobian - flattest_sine * flattest_sine * uu * vv});
    const double at_u = c.target.g11 + c.target.g12, at_v = c.target.g12 + c.target.g22;
    const double inverse = 1 / form, ratio = jacobian / form, defect = 1 - ratio, cost = defect * defect;
    const Point f = -2.0 * (at_u * u + at_v * v);
    const Point r = inverse * (Point{c.q.y - c.r.y, c.r.x - c.q.x} - ratio * f);
    const double slope = -3 * cost, bend = 6 * defect, curvature = slope * inverse,
                 same = 2 * (at_u + at_v) * ratio;
    squares += cost * cost;
    model.cubes += cost * defect;
    defects = std::max(defects, defect);
    cotangents = std::max(cotangents, counted_dot(c.angle, uu, uv, vv) / jacobian);
    model.gradient = model.gradient + slope * r;
    model.xx += bend * r.x * r.x - curvature * (2 * r.x * f.x + same);
    model.xy += bend * r.x * r.y - curvature * (r.x * f.y + r.y * f.x);
    model.yy += bend * r.y * r.y - curvature * (2 * r.y * f.y + same);
    model.reference += uu;
  }
  model.reference /= static_cast<double>(corners_.size());
  model.cost.objective[0] = squares;
  model.cost.largest_defect[0] = defects;
  model.cost.largest_cotangent[0] = angles_count_ ? cotangents : no_cotangent;
  model.cost.valid[0] = soundness > 0;
  return model;
}

double Star::thesis_and_gradient(Point p, Point& gradient) const {
  double sum = 0, largest = 0;
  Point sum_gradient, largest_gradient;
  for (const StarCorner& c : corners_) {
    const auto [cost, slope] = cost_slope(c, p);
    sum += cost;
    sum_gradient = sum_gradient + slope;
    if (cost <= largest) continue;
    largest = cost;
    largest_gradient = slope;
  }
  const double count = static_cast<double>(corners_.size()), t = std::tanh(5 * (largest - 1)),
               blend = (t + 1) / 2;
  const double blend_slope = 2.5 * (1 - t * t);
  gradient = (blend_slope * (largest - sum / count) + blend) * largest_gradient +
             ((1 - blend) / count) * sum_gradient;
  return quadloop::nodal_cost(largest, sum / count);
}

double Star::cost_and_gradient(Point p, Objective objective, Point& gradient) const {
  switch (objective) {
    case Objective::power: return power_and_gradient(p, gradient);
    case Objective::thesis: return thesis_and_gradient(p, gradient);
  }
  QUADLOOP_REQUIRE(false, no_cost);
  return 0;
}

double Star::worst_cost(Point p) const {
  const double area = reference(p);
  double worst = 0;
  for (const StarCorner& c : corners_)
    worst = std::max(worst, corner_cost(corner_form(p, c.q, c.r), c.target, area));
  return worst;
}

double Star::nodal_cost(Point p, double reference) const {
  double sum = 0, largest = 0;
  for (const StarCorner& c : corners_) {
    const double cost = corner_cost(corner_form(p, c.q, c.r), c.target, reference);
    sum += cost;
    largest = std::max(largest, cost);
  }
  return quadloop::nodal_cost(largest, sum / static_cast<double>(corners_.size()));
}

double Star::inversion(Point p, double reference) const {
  double sum = 0;
  for (const StarCorner& c : corners_) {
    const double jacobian = cross(c.q - p, c.r - p);
    if (jacobian < 0) sum -= jacobian / reference;  // so that 0 / 0 of a star that is one point adds nothing
  }
  return sum;
}

std::vector<char> Star::sound_corners(Point p) const {
  std::vector<char> sound;
  for (const StarCorner& c : corners_) sound.push_back(is_inverted(corner_form(p, c.q, c.r)) ? 0 : 1);
  return sound;
}

double Star::reference(Point p) const {
  double sum = 0;
  for (const StarCorner& c : corners_) sum += dot(c.q - p, c.q - p);
  return sum / static_cast<double>(corners_.size());
}

}  // namespace quadloop
