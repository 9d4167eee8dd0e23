#include "tests/property/shapes.hpp"

#include <cmath>
#include <numbers>

namespace quadloop::shapes {

namespace {

using Points = std::vector<Point>;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

int pick(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

Chain loop(const std::string& name, Points points) { return {name, false, std::move(points), "made"}; }

Chain square(double half) {
  return loop("frame", {{-half, -half}, {half, -half}, {half, half}, {-half, half}});
}

Points star(Random& random, Point centre, double inner, double outer, int corners) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + uniform(random, 0, 0.8)) / corners,
                 r = uniform(random, inner, outer);
    points.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return points;
}

/// Points of a grid of so many cells over [-1, 1], walked round the centre: runs along grid lines and
/// through corners.
Points grid_star(Random& random, int cells) {
  Points points;
  for (const Point p : star(random, {0, 0}, 0.2, 0.95, pick(random, 4, 14))) {
    const Point q{std::round(p.x * cells) / cells, std::round(p.y * cells) / cells};
    if (points.empty() || (points.back() != q && points.front() != q)) points.push_back(q);
  }
  return points;
}

Points staircase(Random& random, int steps) {
  const double step = 1.0 / steps;
  const double jitter = pick(random, 0, 1) == 0 ? 0.0 : uniform(random, -1, 1) * 1e-3;
  Points points{{-0.5 + jitter, -0.5}, {0.5 + jitter, -0.5}};
  for (int i = 0; i < steps; ++i) {
    points.push_back({0.5 + jitter - i * step, -0.5 + (i + 1) * step});
    points.push_back({0.5 + jitter - (i + 1) * step, -0.5 + (i + 1) * step});
  }
  points.pop_back();
  return points;
}

Points koch(Random& random, int depth) {
  const double turn = uniform(random, 0, 1);
  Points points;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * (i / 3.0 + turn);
    points.push_back({0.6 * std::cos(angle), 0.6 * std::sin(angle)});
  }
  for (int level = 0; level < depth; ++level) {
    Points finer;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i], d = points[(i + 1) % points.size()] - a;
      const Point b = a + (1.0 / 3) * d, c = a + (2.0 / 3) * d;
      const Point peak = a + 0.5 * d + (std::sqrt(3.0) / 6) * Point{d.y, -d.x};
      finer.insert(finer.end(), {a, b, peak, c});
    }
    points = std::move(finer);
  }
  return points;
}

/// A disc with needles, some of them almost without width.
Points spikes(Random& random) {
  Points points;
  const int count = pick(random, 3, 9);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count + uniform(random, 0, 0.2),
                 width = std::pow(10, uniform(random, -7, -0.7));
    const double reach = pick(random, 0, 1) == 0 ? uniform(random, 0.4, 0.9) : uniform(random, 0.02, 0.15);
    points.push_back({0.2 * std::cos(angle - width), 0.2 * std::sin(angle - width)});
    points.push_back({reach * std::cos(angle), reach * std::sin(angle)});
    points.push_back({0.2 * std::cos(angle + width), 0.2 * std::sin(angle + width)});
  }
  return points;
}

Points comb(Random& random) {
  const int teeth = pick(random, 2, 10);
  const double gap = std::pow(10, uniform(random, -6, -1));
  const double pitch = 1.0 / teeth;
  Points points{{-0.5, -0.5}, {0.5, -0.5}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double left = -0.5 + i * pitch, right = left + pitch;
    points.push_back({right, 0.4});
    points.push_back({left + std::min(gap, 0.5) * pitch, 0.4});
    if (i > 0) points.push_back({left + 0.5 * std::min(gap, 0.5) * pitch, uniform(random, -0.4, 0.0)});
  }
  points.back() = {-0.5, 0.4};
  return points;
}

Points shifted(Points points, Point by) {
  for (Point& p : points) p = p + by;
  return points;
}

Points turned(Points points, double angle) {
  for (Point& p : points)
    p = {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
  return points;
}

Shape near_loops(Random& random) {
  const double gap = std::pow(10, uniform(random, -12, -1));
  const Points half{{-0.5, -0.5}, {-gap / 2, -0.5}, {-gap / 2, 0.5}, {-0.5, 0.5}};
  Points other;
  for (const Point p : half) other.push_back({-p.x, p.y});
  const double angle = pick(random, 0, 2) == 0 ? 0 : uniform(random, 0, 3);
  return {"nearly touching loops",
          {square(1), loop("west", turned(half, angle)), loop("east", turned(other, angle))}};
}

Shape islands(Random& random) {
  Shape shape{"islands and lakes", {square(1)}};
  const int n = pick(random, 1, 4);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double cell = 1.8 / n, size = cell * 0.45 * std::pow(10, uniform(random, -2.5, 0));
      const Point centre{-0.9 + (i + 0.5) * cell, -0.9 + (j + 0.5) * cell};
      const std::string name = "island_" + std::to_string(i * n + j);
      shape.chains.push_back(loop(name, star(random, centre, 0.5 * size, size, pick(random, 3, 12))));
      if (pick(random, 0, 2) == 0)
        shape.chains.push_back(
            loop("lake_" + name, star(random, centre, 0.1 * size, 0.2 * size, pick(random, 3, 8))));
    }
  }
  return shape;
}

Shape several_boundaries(Random& random) {
  const Points ring =
      star(random, {uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)}, 0.3, 0.9, pick(random, 4, 20));
  Shape shape{"a loop of several boundaries", {}};
  for (std::size_t i = 0; i < ring.size();) {
    const std::size_t run = std::min(ring.size() - i, static_cast<std::size_t>(pick(random, 1, 5)));
    Chain chain{"part_" + std::to_string(i), true, {}, "made"};
    for (std::size_t k = 0; k <= run; ++k) chain.points.push_back(ring[(i + k) % ring.size()]);
    shape.chains.push_back(std::move(chain));
    i += run;
  }
  return shape;
}

}  // namespace

Shape random_shape(Random& random) {
  const Point by =
      pick(random, 0, 1) == 0 ? Point{} : Point{uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05)};
  const auto inside_frame = [&](const char* name, Points points) {
    return Shape{name, {square(1), loop("body", shifted(std::move(points), by))}};
  };
  switch (pick(random, 0, 11)) {
    case 0: return {"star", {loop("body", star(random, by, 0.1, 0.9, pick(random, 3, 40)))}};
    case 1: return inside_frame("star hole", star(random, {0, 0}, 0.05, 0.8, pick(random, 3, 60)));
    case 2: return {"lattice polygon", {loop("body", grid_star(random, 1 << pick(random, 1, 5)))}};
    case 3:
      return {"lattice hole",
              {square(1), loop("body", shifted(grid_star(random, 1 << pick(random, 2, 5)), {0, 0}))}};
    case 4: return inside_frame("staircase", staircase(random, pick(random, 2, 32)));
    case 5: return inside_frame("koch", koch(random, pick(random, 1, 4)));
    case 6: return inside_frame("spikes", spikes(random));
    case 7: return {"spikes", {loop("body", spikes(random))}};
    case 8:
      return inside_frame("comb", turned(comb(random), pick(random, 0, 1) == 0 ? 0 : uniform(random, 0, 3)));
    case 9: return near_loops(random);
    case 10: return islands(random);
    default: return several_boundaries(random);
  }
}

}  // namespace quadloop::shapes
