#include "smoother/objective/condition_number.hpp"

#include <numbers>

namespace quadloop {

CornerTarget corner_target(Point w1, Point w2) {
  const double twice = 2 * cross(w1, w2);  // G = adj(W) adj(W)^T / (2 det W)
  return {dot(w2, w2) / twice, -dot(w1, w2) / twice, dot(w1, w1) / twice};
}

CornerTarget equilateral_target() {
  return {1 / std::numbers::sqrt3, -0.5 / std::numbers::sqrt3, 1 / std::numbers::sqrt3};
}
CornerTarget right_angle_target() { return {0.5, 0, 0.5}; }

CornerTarget seen_from_next(const CornerTarget& t) {
  // From q the edges are e1 = r - q and e2 = p - q; the old ones are q - p = -e2 and r - p = e1 - e2.
  return {t.g22, -(t.g12 + t.g22), t.g11 + 2 * t.g12 + t.g22};
}

double condition_number(const CornerForm& corner, const CornerTarget& target) {
  return 1 / inverse_condition(corner, target);
}

template <>
std::array<CornerTarget, 3> ideal_targets<3>() {
  return {equilateral_target(), equilateral_target(), equilateral_target()};
}

template <>
std::array<CornerTarget, 4> ideal_targets<4>() {
  return {right_angle_target(), right_angle_target(), right_angle_target(), right_angle_target()};
}

template <>
std::array<CornerTarget, 3> stretched_targets<3>(Point w1, Point w2) {
  const CornerTarget first = corner_target(w1, w2), second = seen_from_next(first);
  return {first, second, seen_from_next(second)};
}

template <>
std::array<CornerTarget, 4> stretched_targets<4>(Point w1, Point w2) {
  const Point back1 = -1.0 * w1, back2 = -1.0 * w2;
  return {corner_target(w1, w2), corner_target(w2, back1), corner_target(back1, back2),
          corner_target(back2, w1)};
}

template <std::size_t width>
double cell_cost(const std::array<Point, width>& cell, const std::array<CornerTarget, width>& targets) {
  double reference = 0, worst = 0;
  std::array<CornerForm, width> forms;
  for (std::size_t k = 0; k < width; ++k) {
    forms[k] = corner_form(cell[k], cell[(k + 1) % width], cell[(k + width - 1) % width]);
    reference += forms[k].uu / width;
  }
  for (std::size_t k = 0; k < width; ++k)
    worst = std::max(worst, corner_cost(forms[k], targets[k], reference));
  return worst;
}

template double cell_cost<3>(const std::array<Point, 3>&, const std::array<CornerTarget, 3>&);
template double cell_cost<4>(const std::array<Point, 4>&, const std::array<CornerTarget, 4>&);

}  // namespace quadloop
