#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "mesher/geometry/point.hpp"

namespace quadloop::smoother {

/// The target shape of the two edges e1, e2 leaving a corner, as the three numbers that the weighted
/// condition number needs. W is the matrix with the target edges as columns. With V = W^-1 and G = V V^T
/// det(W) / 2, Eq. 3.3 of the thesis becomes
///
///     CN = ||A W^-1|| ||W A^-1|| / 2 = (G11 e1.e1 + 2 G12 e1.e2 + G22 e2.e2) / J,
///     A = (e1 e2),   J = e1 x e2.
///
/// The target does not depend on size or orientation: W and any rotated multiple of it are equivalent.
struct CornerTarget {
  double g11 = 0, g12 = 0, g22 = 0;
};

/// The target shape of a cell: its edges from its first node to the second (w1) and to the last (w2). The
/// default is the ideal cell, equilateral or square.
struct CellTarget {
  Point w1, w2;
  bool ideal() const { return w1 == Point{} && w2 == Point{}; }
};

/// The target of a corner with the edges w1 (to the next node) and w2 (to the previous one). `w1` x `w2` must
/// be positive.
CornerTarget corner_target(Point w1, Point w2);

/// The target of an equilateral triangle, equal at all corners; the target of a right angle with equal legs.
constexpr CornerTarget equilateral_target() {
  return {1 / std::numbers::sqrt3, -0.5 / std::numbers::sqrt3, 1 / std::numbers::sqrt3};
}
constexpr CornerTarget right_angle_target() { return {0.5, 0, 0.5}; }

/// The target of triangle (p, q, r) seen from q, whose edges go to r and to p.
CornerTarget seen_from_next(const CornerTarget& target);

/// Products of the two edges at corner p of a counter-clockwise triangle p, q, r: u = q - p, v = r - p.
struct CornerForm {
  double uu = 0, uv = 0, vv = 0, jacobian = 0;
};
inline CornerForm corner_form(Point p, Point q, Point r) {
  const Point u = q - p, v = r - p;
  return {dot(u, u), dot(u, v), dot(v, v), cross(u, v)};
}

/// Eq. 3.3: 1 for the target shape, larger for any other. The corner must not be inverted.
double condition_number(const CornerForm& corner, const CornerTarget& target);
/// Numerator of Eq. 3.3.
inline double weighted_edges(const CornerForm& c, const CornerTarget& t) {
  return t.g11 * c.uu + 2 * t.g12 * c.uv + t.g22 * c.vv;
}
/// Inverse of Eq. 3.3; the cost needs no more.
inline double inverse_condition(const CornerForm& c, const CornerTarget& t) {
  return c.jacobian / weighted_edges(c, t);
}

/// Whether a corner counts as inverted: J <= 1e-12 |e1| |e2|.
inline constexpr double flattest_sine = 1e-12;
inline bool is_inverted(const CornerForm& c) {
  return !(c.jacobian > 0 && c.jacobian * c.jacobian > flattest_sine * flattest_sine * c.uu * c.vv);
}

/// Eq. 3.2: (1 - 1/CN)^2, between 0 and 1; for an inverted corner 1 - J / reference, at least 1. `reference`
/// is an area, the same for all compared corners; it is 0 if all nodes coincide, which costs the same as a
/// flat corner.
inline double corner_cost(const CornerForm& c, const CornerTarget& t, double reference) {
  if (is_inverted(c)) return c.jacobian < 0 ? 1 - c.jacobian / reference : 1;
  const double defect = 1 - inverse_condition(c, t);
  return defect * defect;
}

/// The ideal target of each corner of a cell with three (equilateral) or four nodes (square), seen from that
/// corner.
template <std::size_t width>
constexpr std::array<CornerTarget, width> ideal_targets() {
  std::array<CornerTarget, width> targets;
  targets.fill(width == 3 ? equilateral_target() : right_angle_target());
  return targets;
}

/// Same for a cell stretched like the parallelogram of w1 (to the second node) and w2 (to the last).
template <std::size_t width>
std::array<CornerTarget, width> stretched_targets(Point w1, Point w2);

/// The largest cost of a cell's corners; the three corners of a triangle have the same cost.
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

}  // namespace quadloop::smoother
