#include "mesher/geometry/crossing_point.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "mesher/geometry/integer_points.hpp"

namespace quadloop {

namespace {

using BigInteger = boost::multiprecision::cpp_int;

/// The double nearest to numerator / denominator * 2^exponent.
double nearest_quotient(BigInteger numerator, BigInteger denominator, int exponent) {
  const int sign = numerator.sign() * denominator.sign();
  if (sign == 0) return 0;
  numerator = abs(numerator);
  denominator = abs(denominator);
  // The quotient then has 63 or 64 binary digits, more than a double; its last digit is set if there is a
  // remainder.
  const int shift = 63 - static_cast<int>(msb(numerator)) + static_cast<int>(msb(denominator));
  if (shift > 0) numerator <<= static_cast<unsigned>(shift);
  if (shift < 0) denominator <<= static_cast<unsigned>(-shift);
  BigInteger quotient, remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  auto digits = static_cast<std::uint64_t>(quotient);
  if (!remainder.is_zero()) digits |= 1;
  return sign * std::ldexp(static_cast<double>(digits), exponent - shift);
}

}  // namespace

Point crossing_point(Point a, Point b, Point c, Point d) {
  const IntegerPoints p({a, b, c, d});
  const BigInteger bx = p.dx<BigInteger>(1, 0), by = p.dy<BigInteger>(1, 0);
  const BigInteger dx = p.dx<BigInteger>(3, 2), dy = p.dy<BigInteger>(3, 2);
  const BigInteger denominator = bx * dy - by * dx;
  const BigInteger share = p.dx<BigInteger>(2, 0) * dy - p.dy<BigInteger>(2, 0) * dx;
  return {nearest_quotient(p.x<BigInteger>(0) * denominator + share * bx, denominator, p.exponent()),
          nearest_quotient(p.y<BigInteger>(0) * denominator + share * by, denominator, p.exponent())};
}

}  // namespace quadloop
