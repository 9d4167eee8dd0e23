#include "mesher/geometry/assemble/naca_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr double base_thickness = 0.2;  // of the coefficients of all sections

[[noreturn]] void refuse_code(const std::string& code) {
  throw InputError(
      fmt::format("'{}' is not the code of a NACA section; give four digits (2412), four digits modified "
                  "(0012-64) or five digits (23012)",
                  code));
}

int number_of(char digit) { return digit - '0'; }

}  // namespace

NacaSection::NacaSection(const std::string& given, bool sharp) : sharp_{sharp} {
  const std::string code = given.starts_with("naca") ? given.substr(4) : given;
  const auto are_digits = [](const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return '0' <= c && c <= '9'; });
  };
  const std::string digits = code.substr(0, code.find('-')), modified = code.substr(digits.size());
  if (!are_digits(digits)) refuse_code(code);
  if (digits.size() == 4)
    set_four_digits(digits);
  else if (digits.size() == 5 && modified.empty())
    set_five_digits(digits);
  else
    refuse_code(code);
  if (thickness_ == 0) throw InputError(fmt::format("NACA {}: the section has no thickness", code));
  if (modified.empty()) return;
  if (modified.size() != 3 || !are_digits(modified.substr(1))) refuse_code(code);
  const int nose = number_of(modified[1]), tenths = number_of(modified[2]);
  if (tenths < 2 || tenths > 6)
    throw InputError(fmt::format("NACA {}: the largest thickness is at 2 to 6 tenths of the chord, not at {}",
                                 code, tenths));
  set_modified(nose, tenths);
}

void NacaSection::set_four_digits(const std::string& code) {
  camber_ = number_of(code[0]) / 100.0;
  camber_place_ = number_of(code[1]) / 10.0;
  thickness_ = (10 * number_of(code[2]) + number_of(code[3])) / 100.0;
  if ((camber_ > 0) != (camber_place_ > 0))
    throw InputError(fmt::format(
        "NACA {}: a cambered section needs a place of the largest camber, and only a cambered one has it",
        code));
}

void NacaSection::set_five_digits(const std::string& code) {
  struct Line {
    double m, k1, k2_by_k1;
  };
  // For a design lift coefficient of 0.3, with the largest camber at 5, 10, ... percent of the chord.
  constexpr std::array<Line, 5> simple{
      {{.0580, 361.400, 0}, {.1260, 51.640, 0}, {.2025, 15.957, 0}, {.2900, 6.643, 0}, {.3910, 3.230, 0}}};
  constexpr std::array<Line, 4> reflexed{
      {{.1300, 51.990, .000764}, {.2170, 15.793, .00677}, {.3180, 6.520, .0303}, {.4410, 3.191, .1355}}};
  const int lift = number_of(code[0]), place = number_of(code[1]), reflex = number_of(code[2]);
  const bool known = reflex == 0 ? 1 <= place && place <= 5 : reflex == 1 && 2 <= place && place <= 5;
  if (lift == 0 || !known) refuse_code(code);
  const Line line = reflex == 1 ? reflexed[place - 2] : simple[place - 1];
  reflexed_ = reflex == 1;
  m_ = line.m;
  k1_ = line.k1 * lift / 2.0;
  k2_by_k1_ = line.k2_by_k1;
  thickness_ = (10 * number_of(code[3]) + number_of(code[4])) / 100.0;
}

/// Two polynomials that meet at the largest thickness with equal curvature; the first has the nose radius,
/// the second the height and slope of the trailing edge.
void NacaSection::set_modified(int nose, int tenths) {
  constexpr std::array<double, 5> slopes{.200, .234, .315, .465, .700};  // at the trailing edge
  constexpr double usual_nose = 0.2969, index_of_usual_nose = 6, sharpest_nine = 10.3933;
  const double t = tenths / 10.0, rest = 1 - t, top = base_thickness / 2;
  const double d0 = sharp_ ? 0 : 0.002, d1 = slopes[tenths - 2], rise = top - d0;
  place_ = t;
  d_[0] = d0;
  d_[1] = d1;
  d_[2] = (3 * rise - 2 * d1 * rest) / (rest * rest);
  d_[3] = (-2 * rise + d1 * rest) / (rest * rest * rest);
  const double radius = rest * rest / (6 * rise - 2 * d1 * rest);  // of curvature at the largest thickness
  const double a0 =
      usual_nose * (nose < 9 ? nose / index_of_usual_nose : sharpest_nine / index_of_usual_nose);
  a_[0] = a0;
  a_[1] = 3 * top / t - 15.0 / 8 * a0 / std::sqrt(t) - t / (2 * radius);
  a_[2] = -3 * top / (t * t) + 1.25 * a0 / (t * std::sqrt(t)) + 1 / radius;
  a_[3] = top / (t * t * t) - 0.375 * a0 / (t * t * std::sqrt(t)) - 1 / (2 * radius * t);
}

NacaSection::Camber NacaSection::camber_at(double x) const {
  if (camber_ > 0) {
    const double p = camber_place_, part = x < p ? p : 1 - p, factor = camber_ / (part * part);
    const double height = x < p ? x * (2 * p - x) : (1 - x) * (1 + x - 2 * p);
    return {factor * height, 2 * factor * (p - x)};
  }
  if (k1_ == 0) return {};
  const double m = m_, factor = k1_ / 6, cube = m * m * m, behind = x - m;
  if (!reflexed_) {
    if (x >= m) return {factor * cube * (1 - x), -factor * cube};
    return {factor * x * (x * x - 3 * m * x + m * m * (3 - m)),
            factor * (3 * x * x - 6 * m * x + m * m * (3 - m))};
  }
  const double rest = 1 - m, linear = k2_by_k1_ * rest * rest * rest + cube;
  const double bend = x < m ? 1 : k2_by_k1_;
  return {factor * (bend * behind * behind * behind - linear * x + cube),
          factor * (3 * bend * behind * behind - linear)};
}

double NacaSection::half_thickness(double x) const {
  if (sharp_ && x == 1) return 0;  // the formulas leave a rounding error
  const double scale = thickness_ / base_thickness;
  if (place_ == 0) {
    const double last = sharp_ ? -0.1036 : -0.1015;
    return scale * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 + x * last))));
  }
  const double r = 1 - x;
  if (x > place_) return scale * (d_[0] + r * (d_[1] + r * (d_[2] + r * d_[3])));
  return scale * (a_[0] * std::sqrt(x) + x * (a_[1] + x * (a_[2] + x * a_[3])));
}

Point NacaSection::point_at(double x, int side) const {
  const Camber camber = camber_at(x);
  const double half = side * half_thickness(x), along = std::hypot(1, camber.slope);
  return {x - half * camber.slope / along, camber.height + half / along};
}

std::vector<Point> NacaSection::surface(int side, double from, double to, int points) const {
  // Angles from -90 degrees at the leading to 90 degrees at the trailing edge.
  const auto angle_of = [](double x) { return std::asin(2 * x - 1); };
  const int steps = points - 1;
  const double step = std::numbers::pi / steps, first = angle_of(from), last = angle_of(to);
  std::vector<Point> surface{point_at(from, side)};
  for (int i = 1; i < steps; ++i) {
    const double angle = (i - 0.5 * steps) * step;
    if (angle - first > 0.5 * step && last - angle > 0.5 * step)
      surface.push_back(point_at(0.5 * (1 + std::sin(angle)), side));
  }
  surface.push_back(point_at(to, side));
  return surface;
}

}  // namespace quadloop
