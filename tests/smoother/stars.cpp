#include "tests/smoother/stars.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/mesh/check/quality.hpp"

namespace quadloop::test {

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Point random_direction(Random& random) {
  const double t = uniform(random, 0, 2 * std::numbers::pi);
  return {std::cos(t), std::sin(t)};
}

namespace {

/// Neighbours round the origin, counter-clockwise, none less than a third of a turn's even share after the
/// other.
std::vector<Point> random_ring(Random& random) {
  const int count = 4 + static_cast<int>(random() % 5);
  std::vector<Point> ring;
  for (int k = 0; k < count; ++k) {
    const double t = 2 * std::numbers::pi * (k + uniform(random, 0, 0.6)) / count,
                 radius = uniform(random, 0.5, 1.5);
    ring.push_back({radius * std::cos(t), radius * std::sin(t)});
  }
  return ring;
}

/// Edges of a cell of some stretching and turning; both of length one for an ideal cell.
std::array<Point, 2> random_target(Random& random, bool stretched) {
  if (!stretched) return {Point{1, 0}, Point{0, 1}};
  const Point along = random_direction(random), across{-along.y, along.x};
  return {uniform(random, 0.5, 2) * along,
          uniform(random, 0.5, 2) * across + uniform(random, -0.5, 0.5) * along};
}

}  // namespace

void add_quad(smoother::Star& star, Point a, Point b, Point c, Point w1, Point w2) {
  const auto targets = smoother::stretched_targets<4>(w1, w2);
  const auto seen_from_previous = [](const smoother::CornerTarget& t) {
    return smoother::seen_from_next(smoother::seen_from_next(t));
  };
  star.add({a, c, targets[0], smoother::CellAngle::at_p});
  star.add({a, b, seen_from_previous(targets[1]), smoother::CellAngle::at_q});
  star.add({b, c, smoother::seen_from_next(targets[3]), smoother::CellAngle::at_r});
}

smoother::Star random_star(Random& random, Cells cells, bool stretched) {
  smoother::Star star;
  const std::vector<Point> ring = random_ring(random);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], c = ring[(k + 1) % ring.size()];
    const auto [w1, w2] = random_target(random, stretched);
    const bool quad = cells == Cells::quads || (cells == Cells::mixed && random() % 2 == 0);
    if (quad) {
      add_quad(star, a, uniform(random, 0.7, 1.2) * (a + c), c, w1, w2);
    } else {
      star.add({a, c, stretched ? smoother::corner_target(w1, w2) : smoother::equilateral_target(),
                smoother::CellAngle::all});
    }
  }
  return star;
}

smoother::Star fan_of(const std::vector<Point>& polygon) {
  smoother::Star star;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    star.add({polygon[k], polygon[(k + 1) % polygon.size()], smoother::equilateral_target(),
              smoother::CellAngle::all});
  return star;
}

std::vector<Point> regular_polygon(int corners, Point centre, double radius) {
  std::vector<Point> polygon;
  for (int k = 0; k < corners; ++k) {
    const double t = 2 * std::numbers::pi * k / corners;
    polygon.push_back(centre + radius * Point{std::cos(t), std::sin(t)});
  }
  return polygon;
}

smoother::Star quad_patch() {
  smoother::Star star;
  Point a{1, 0};
  for (int k = 0; k < 4; ++k) {
    const Point c{-a.y, a.x};
    add_quad(star, a, a + c, c, {1, 0}, {0, 1});
    a = c;
  }
  return star;
}

double smallest_degrees(const smoother::Star& star, Point p) {
  double smallest = 180;
  for (const smoother::StarCorner& c : star.corners()) {
    const bool all = c.angle == smoother::CellAngle::all;
    if (all || c.angle == smoother::CellAngle::at_p)
      smallest = std::min(smallest, corner_degrees(c.r, p, c.q));
    if (all || c.angle == smoother::CellAngle::at_q)
      smallest = std::min(smallest, corner_degrees(p, c.q, c.r));
    if (all || c.angle == smoother::CellAngle::at_r)
      smallest = std::min(smallest, corner_degrees(c.q, c.r, p));
  }
  return smallest;
}

std::vector<double> corner_costs(const smoother::Star& star, Point p) {
  double squares = 0;
  for (const smoother::StarCorner& c : star.corners()) squares += dot(c.q - p, c.q - p);
  std::vector<double> costs;
  for (const smoother::StarCorner& c : star.corners()) {
    costs.push_back(smoother::corner_cost(smoother::corner_form(p, c.q, c.r), c.target,
                                          squares / static_cast<double>(star.corners().size())));
  }
  return costs;
}

double largest_cost(const smoother::Star& star, Point p) {
  const std::vector<double> costs = corner_costs(star, p);
  return *std::max_element(costs.begin(), costs.end());
}

}  // namespace quadloop::test
