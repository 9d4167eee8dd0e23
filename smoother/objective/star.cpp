#include "smoother/objective/star.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop::smoother {

double nodal_cost(double largest, double mean) {
  if (largest > 1) return largest * largest;
  const double blend = (std::tanh(5 * (largest - 1)) + 1) / 2;
  return blend * largest + (1 - blend) * mean;
}

namespace {

constexpr const char* no_cost = "an objective without a cost";
constexpr double no_cotangent = -std::numeric_limits<double>::infinity();

const StarKernels& widest() {
  static const StarKernels kernels = star_kernels().back();
  return kernels;
}

}  // namespace

template <int places>
StarCost<places> Star::cost_of(const StarSums<places>& sums, Objective objective) const {
  using Values = Eigen::Map<const Eigen::Array<double, places, 1>>;
  StarCost<places> cost;
  cost.valid = Values(sums.soundness.data()) > 0;
  cost.largest_defect = Values(sums.defects.data());
  cost.largest_cotangent = Values(sums.cotangents.data());
  if (!angles_count_) cost.largest_cotangent = no_cotangent;
  switch (objective) {
    case Objective::power: cost.objective = Values(sums.squares.data()); return cost;
    case Objective::thesis:
      for (std::size_t k = 0; k < places; ++k)
        cost.objective[k] = smoother::nodal_cost(sums.defects[k] * sums.defects[k],
                                                 sums.costs[k] / static_cast<double>(corners_.size()));
      return cost;
  }
  QUADLOOP_REQUIRE(false, no_cost);
  return cost;
}

StarCost<Star::batch> Star::cost(const Batch& x, const Batch& y, Objective objective) const {
  return cost_of(widest().sums(corners_, x.data(), y.data()), objective);
}

StarCost<1> Star::cost(Point p, Objective objective) const {
  return cost_of(star_sums(corners_, p), objective);
}

namespace {

struct CostSlope {
  double cost = 0;
  Point gradient;
};

/// The cost of a valid corner and its derivative with respect to p.
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

StarModel Star::model(Point p) const {
  const StarDerivatives sums = widest().derivatives(corners_, p);
  StarModel model;
  model.cost.objective[0] = sums.squares;
  model.cost.largest_defect[0] = sums.defects;
  model.cost.largest_cotangent[0] = angles_count_ ? sums.cotangents : no_cotangent;
  model.cost.valid[0] = sums.soundness > 0;
  model.cubes = sums.cubes;
  model.gradient = sums.gradient;
  model.xx = sums.xx;
  model.xy = sums.xy;
  model.yy = sums.yy;
  model.reference = sums.edges / static_cast<double>(corners_.size());
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
  return smoother::nodal_cost(largest, sum / count);
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
  return smoother::nodal_cost(largest, sum / static_cast<double>(corners_.size()));
}

double Star::inversion(Point p, double reference) const {
  double sum = 0;
  for (const StarCorner& c : corners_) {
    const double jacobian = cross(c.q - p, c.r - p);
    if (jacobian < 0) sum -= jacobian / reference;  // the condition avoids 0 / 0 for a star that is one point
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

}  // namespace quadloop::smoother
