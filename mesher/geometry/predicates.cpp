#include "mesher/geometry/predicates.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "mesher/geometry/integer_points.hpp"

namespace quadloop {

namespace {

namespace mp = boost::multiprecision;
template <unsigned bits>
using Fixed = mp::number<mp::cpp_int_backend<bits, bits, mp::signed_magnitude, mp::unchecked, void>>;

template <class Integer>
int orientation_in(const IntegerPoints& p) {
  const Integer left = p.dx<Integer>(0, 2) * p.dy<Integer>(1, 2),
                right = p.dy<Integer>(0, 2) * p.dx<Integer>(1, 2);
  return left.compare(right);
}

template <class Integer>
int in_circle_in(const IntegerPoints& p) {
  std::array<Integer, 3> x, y, lift;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = p.dx<Integer>(i, 3);
    y[i] = p.dy<Integer>(i, 3);
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  Integer determinant = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += lift[i] * (x[j] * y[k] - y[j] * x[k]);
  }
  return determinant.sign();
}

/// Fast path: four corners of an axis-parallel rectangle, frequent in quadtrees.
bool is_rectangle(Point a, Point b, Point c, Point d) {
  const auto is = [d](Point above, Point beside, Point opposite) {
    return above.x == d.x && beside.y == d.y && opposite.x == beside.x && opposite.y == above.y;
  };
  return is(a, b, c) || is(a, c, b) || is(b, a, c) || is(b, c, a) || is(c, a, b) || is(c, b, a);
}

int exact_in_circle(Point a, Point b, Point c, Point d) {
  const IntegerPoints points({a, b, c, d});  // with n bits the determinant needs 4 (n + 1) + 4
  if (points.bits() <= 29) return in_circle_in<Fixed<127>>(points);
  if (points.bits() <= 126) return in_circle_in<Fixed<512>>(points);
  return in_circle_in<mp::cpp_int>(points);
}

/// Returns 0 if rounding hides the sign. The bound is that of Shewchuk's paper (see the header) for this sum,
/// plus a tenth for products that underflow: with lifts below 2^100 they lose less than 2^-960.
template <class Real>
int rounded_in_circle(Point a, Point b, Point c, Point d) {
  constexpr Real unit = std::numeric_limits<Real>::epsilon() / 2, bound = 11 * unit;
  constexpr Real no_underflow = 0x1p-850, no_overflow = 0x1p100;
  const auto ax = Real(a.x) - Real(d.x), ay = Real(a.y) - Real(d.y), bx = Real(b.x) - Real(d.x),
             by = Real(b.y) - Real(d.y), cx = Real(c.x) - Real(d.x), cy = Real(c.y) - Real(d.y);
  const Real lift_a = ax * ax + ay * ay, lift_b = bx * bx + by * by, lift_c = cx * cx + cy * cy;
  const Real bxcy = bx * cy, bycx = by * cx, cxay = cx * ay, cyax = cy * ax, axby = ax * by, aybx = ay * bx;
  const Real determinant = lift_a * (bxcy - bycx) + lift_b * (cxay - cyax) + lift_c * (axby - aybx);
  const Real sum = lift_a * (std::abs(bxcy) + std::abs(bycx)) + lift_b * (std::abs(cxay) + std::abs(cyax)) +
                   lift_c * (std::abs(axby) + std::abs(aybx));
  const bool sure =
      lift_a + lift_b + lift_c < no_overflow && sum > no_underflow && std::abs(determinant) > bound * sum;
  return !sure ? 0 : determinant > 0 ? 1 : -1;
}

}  // namespace

int exact_orientation(Point a, Point b, Point c) {
  const int left = sign(a.x - c.x) * sign(b.y - c.y), right = sign(a.y - c.y) * sign(b.x - c.x);
  if (left != right) return left > right ? 1 : -1;
  if (left == 0) return 0;
  const IntegerPoints points({a, b, c, c});  // with n bits the products need 2 (n + 1)
  if (points.bits() <= 62) return orientation_in<Fixed<127>>(points);
  return orientation_in<mp::cpp_int>(points);
}

int in_circle(Point a, Point b, Point c, Point d) {
  if (const int side = rounded_in_circle<double>(a, b, c, d); side != 0) return side;
  if (is_rectangle(a, b, c, d)) return 0;
  if (const int side = rounded_in_circle<long double>(a, b, c, d); side != 0) return side;
  return exact_in_circle(a, b, c, d);
}

bool on_segment(Point p, Point a, Point b) { return box_of(a, b).contains(p) && orientation(a, b, p) == 0; }

bool segments_meet(Point a, Point b, Point c, Point d) {
  if (!box_of(a, b).meets(box_of(c, d))) return false;
  const int abc = orientation(a, b, c), abd = orientation(a, b, d);
  const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return on_segment(c, a, b) || on_segment(d, a, b) || on_segment(a, c, d) || on_segment(b, c, d);
}

}  // namespace quadloop
