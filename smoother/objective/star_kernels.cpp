#include "smoother/objective/star_kernels.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace quadloop::smoother {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double flattest_squared = flattest_sine * flattest_sine;

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed to inlined functions only
/// Inlined into functions that are compiled for wider vectors than the rest of the program.
#define QUADLOOP_INLINED [[gnu::always_inline]] inline

/// A vector of `width` doubles.
template <int width>
struct Vector {
  using Type [[gnu::vector_size(8 * width)]] = double;
};
template <>
struct Vector<1> {
  using Type = double;
};
template <int width>
using Values = typename Vector<width>::Type;

template <int width>
QUADLOOP_INLINED Values<width> load(const double* from) {
  Values<width> values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

template <int width>
QUADLOOP_INLINED void store(const Values<width>& values, double* to) {
  std::memcpy(to, &values, sizeof values);
}

template <class Some>
QUADLOOP_INLINED Some larger(const Some& a, const Some& b) {
  return a < b ? b : a;
}

template <class Some>
QUADLOOP_INLINED Some smaller(const Some& a, const Some& b) {
  return b < a ? b : a;
}

/// One number of each corner from the `begin`-th on, padded with the last corner's.
template <int width, class Number>
QUADLOOP_INLINED Values<width> column(std::span<const StarCorner> corners, std::size_t begin,
                                      const Number& number) {
  const auto of_lane = [&](std::size_t lane) __attribute__((always_inline)) {
    return number(corners[std::min(begin + lane, corners.size() - 1)]);
  };
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) __attribute__((always_inline)) {
    return Values<width>{of_lane(lane)...};
  }
  (std::make_index_sequence<width>());
}

/// The terms of some corners.
template <int width>
struct Terms {
  std::array<double, width> squares, cubes, gradient_x, gradient_y, xx, xy, yy, edges, defects, cotangents,
      soundness;
};

/// The largest cotangent of the counted angles of the triangles, times J.
template <int width>
QUADLOOP_INLINED Values<width> counted_dots(std::span<const StarCorner> corners, std::size_t begin,
                                            const Values<width>& at_p, const Values<width>& at_q,
                                            const Values<width>& at_r) {
  using Many = Values<width>;
  const auto all = [](const StarCorner& c) { return c.angle == CellAngle::all; };
  if (std::all_of(corners.begin(), corners.end(), all)) return larger<Many>(larger<Many>(at_p, at_q), at_r);
  const auto unless = [&](CellAngle angle) __attribute__((always_inline)) {
    return column<width>(corners, begin, [&](const StarCorner& c) {
      return c.angle == CellAngle::all || c.angle == angle ? 0 : -infinity;
    });
  };
  return larger<Many>(larger<Many>(at_p + unless(CellAngle::at_p), at_q + unless(CellAngle::at_q)),
                      at_r + unless(CellAngle::at_r));
}

/// A corner's inverse condition number is r = J / F, where J is linear in p and F is quadratic with curvature
/// 2 s in all directions, so F grad grad r = -(grad r grad F + grad F grad r) - 2 s r. The corner adds (1 -
/// r)^3.
template <int width>
QUADLOOP_INLINED void find_terms(std::span<const StarCorner> corners, std::size_t begin, Point p,
                                 Terms<width>& terms) {
  using Many = Values<width>;
#define QUADLOOP_COLUMN(number) column<width>(corners, begin, [](const StarCorner& c) { return c.number; })
  const Many qx = QUADLOOP_COLUMN(q.x), qy = QUADLOOP_COLUMN(q.y), rx = QUADLOOP_COLUMN(r.x),
             ry = QUADLOOP_COLUMN(r.y), g11 = QUADLOOP_COLUMN(target.g11), g12 = QUADLOOP_COLUMN(target.g12),
             g22 = QUADLOOP_COLUMN(target.g22);
#undef QUADLOOP_COLUMN
  const Many ux = qx - p.x, uy = qy - p.y, vx = rx - p.x, vy = ry - p.y;
  const Many uu = ux * ux + uy * uy, uv = ux * vx + uy * vy, vv = vx * vx + vy * vy,
             jacobian = ux * vy - uy * vx;
  const Many form = g11 * uu + 2 * g12 * uv + g22 * vv, at_u = g11 + g12, at_v = g12 + g22;
  const Many inverse = 1 / form, ratio = jacobian / form, defect = 1 - ratio, cost = defect * defect;
  const Many fx = -2.0 * (at_u * ux + at_v * vx), fy = -2.0 * (at_u * uy + at_v * vy);
  const Many x = inverse * ((qy - ry) - ratio * fx), y = inverse * ((rx - qx) - ratio * fy);
  const Many slope = -3 * cost, bend = 6 * defect, curvature = slope * inverse,
             same = 2 * (at_u + at_v) * ratio;
  store<width>(cost * cost, terms.squares.data());
  store<width>(cost * defect, terms.cubes.data());
  store<width>(slope * x, terms.gradient_x.data());
  store<width>(slope * y, terms.gradient_y.data());
  store<width>(bend * x * x - curvature * (2 * x * fx + same), terms.xx.data());
  store<width>(bend * x * y - curvature * (x * fy + y * fx), terms.xy.data());
  store<width>(bend * y * y - curvature * (2 * y * fy + same), terms.yy.data());
  store<width>(uu, terms.edges.data());
  store<width>(defect, terms.defects.data());
  store<width>(counted_dots<width>(corners, begin, uv, uu - uv, vv - uv) / jacobian, terms.cotangents.data());
  store<width>(smaller<Many>(jacobian, jacobian * jacobian - flattest_squared * uu * vv),
               terms.soundness.data());
}

template <int width>
QUADLOOP_INLINED void add(const Terms<width>& terms, std::size_t lane, StarDerivatives& sums) {
  sums.squares += terms.squares[lane];
  sums.cubes += terms.cubes[lane];
  sums.gradient.x += terms.gradient_x[lane];
  sums.gradient.y += terms.gradient_y[lane];
  sums.xx += terms.xx[lane];
  sums.xy += terms.xy[lane];
  sums.yy += terms.yy[lane];
  sums.edges += terms.edges[lane];
  sums.defects = larger(sums.defects, terms.defects[lane]);
  sums.cotangents = larger(sums.cotangents, terms.cotangents[lane]);
  sums.soundness = smaller(sums.soundness, terms.soundness[lane]);
}

template <int width>
QUADLOOP_INLINED StarDerivatives find_derivatives(std::span<const StarCorner> corners, Point p) {
  StarDerivatives sums;
  sums.cotangents = -infinity;
  for (std::size_t begin = 0; begin < corners.size(); begin += width) {
    Terms<width> terms;
    find_terms<width>(corners, begin, p, terms);
    const std::size_t count = std::min<std::size_t>(width, corners.size() - begin);
    for (std::size_t lane = 0; lane < count; ++lane) add(terms, lane, sums);
  }
  return sums;
}

/// The largest cotangent of the counted angles of a triangle, times J.
template <class Some>
QUADLOOP_INLINED Some counted_dot(CellAngle angle, const Some& uu, const Some& uv, const Some& vv) {
  switch (angle) {
    case CellAngle::at_p: return uv;
    case CellAngle::at_q: return uu - uv;
    case CellAngle::at_r: return vv - uv;
    case CellAngle::all: break;
  }
  return larger<Some>(larger<Some>(uv, uu - uv), vv - uv);
}

/// The sums at `width` positions from the `begin`-th on.
template <int width, int places>
QUADLOOP_INLINED void find_sums(std::span<const StarCorner> corners, const double* x, const double* y,
                                std::size_t begin, StarSums<places>& sums) {
  using Many = Values<width>;
  const Many px = load<width>(x + begin), py = load<width>(y + begin);
  Many costs{}, squares{}, defects{}, cotangents = Many{} - infinity, soundness = Many{} + 1;
  for (const StarCorner& c : corners) {
    const Many ux = c.q.x - px, uy = c.q.y - py, vx = c.r.x - px, vy = c.r.y - py;
    const Many uu = ux * ux + uy * uy, uv = ux * vx + uy * vy, vv = vx * vx + vy * vy,
               jacobian = ux * vy - uy * vx;
    soundness =
        smaller<Many>(smaller<Many>(soundness, jacobian), jacobian * jacobian - flattest_squared * uu * vv);
    const Many defect = 1 - jacobian / (c.target.g11 * uu + 2 * c.target.g12 * uv + c.target.g22 * vv);
    const Many corner = defect * defect;
    costs += corner;
    squares += corner * corner;
    defects = larger<Many>(defects, defect);
    cotangents = larger<Many>(cotangents, counted_dot<Many>(c.angle, uu, uv, vv) / jacobian);
  }
  store<width>(costs, &sums.costs[begin]);
  store<width>(squares, &sums.squares[begin]);
  store<width>(defects, &sums.defects[begin]);
  store<width>(cotangents, &sums.cotangents[begin]);
  store<width>(soundness, &sums.soundness[begin]);
}

template <int width>
QUADLOOP_INLINED StarSums<StarKernels::batch> find_sums_of_batch(std::span<const StarCorner> corners,
                                                                 const double* x, const double* y) {
  StarSums<StarKernels::batch> sums;
  for (std::size_t begin = 0; begin < StarKernels::batch; begin += width)
    find_sums<width>(corners, x, y, begin, sums);
  return sums;
}

/// Defines kernels with this name for vectors of `width` doubles; the last arguments are the target
/// attributes.
#define QUADLOOP_KERNELS(name, width, ...)                                                                   \
  __VA_ARGS__ StarDerivatives name##_derivatives(std::span<const StarCorner> corners, Point p) {             \
    return find_derivatives<width>(corners, p);                                                              \
  }                                                                                                          \
  __VA_ARGS__ StarSums<StarKernels::batch> name##_sums(std::span<const StarCorner> corners, const double* x, \
                                                       const double* y) {                                    \
    return find_sums_of_batch<width>(corners, x, y);                                                         \
  }                                                                                                          \
  constexpr StarKernels name { name##_derivatives, name##_sums }

QUADLOOP_KERNELS(of_any, 2, );
#ifdef __x86_64__
QUADLOOP_KERNELS(of_avx2, 4, [[gnu::target("avx2")]]);
QUADLOOP_KERNELS(of_avx512, 8, [[gnu::target("avx512f")]]);
#endif

}  // namespace

StarSums<1> star_sums(std::span<const StarCorner> corners, Point p) {
  StarSums<1> sums;
  find_sums<1>(corners, &p.x, &p.y, 0, sums);
  return sums;
}

std::vector<StarKernels> star_kernels() {
  std::vector<StarKernels> kernels{of_any};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) kernels.push_back(of_avx2);
  if (__builtin_cpu_supports("avx512f")) kernels.push_back(of_avx512);
#endif
  return kernels;
}

}  // namespace quadloop::smoother
