#include "smoother/objective/condition_number.hpp"

namespace quadloop::smoother {

CornerTarget corner_target(Point w1, Point w2) {
  const double twice = 2 * cross(w1, w2);  // G = adj(W) adj(W)^T / (2 det W)
  return {dot(w2, w2) / twice, -dot(w1, w2) / twice, dot(w1, w1) / twice};
}

CornerTarget seen_from_next(const CornerTarget& t) {
  // From q the edges are e1 = r - q and e2 = p - q; those from p are q - p = -e2 and r - p = e1 - e2.
  return {t.g22, -(t.g12 + t.g22), t.g11 + 2 * t.g12 + t.g22};
}

double condition_number(const CornerForm& corner, const CornerTarget& target) {
  return 1 / inverse_condition(corner, target);
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

}  // namespace quadloop::smoother
