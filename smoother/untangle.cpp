#include "smoother/untangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadloop {

namespace {

/// The half plane n . p + c >= t of an opposite edge, n of length 1: t is how far p lies to its left.
struct HalfPlane {
  Point n;
  double c = 0;
  double depth(Point p) const { return dot(n, p) + c; }
};

std::vector<HalfPlane> half_planes(const Star& star) {
  std::vector<HalfPlane> planes;
  for (const StarCorner& corner : star.corners()) {
    const Point along = corner.r - corner.q;
    const double edge = length(along);
    if (edge == 0) continue;
    const Point n{-along.y / edge, along.x / edge};
    planes.push_back({n, -dot(n, corner.q)});
  }
  return planes;
}

/// Where three half planes have the same depth, if anywhere.
std::optional<Point> equally_deep(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c) {
  const Point u = a.n - b.n, v = a.n - c.n;
  const double determinant = cross(u, v), du = b.c - a.c, dv = c.c - a.c;
  if (std::abs(determinant) < 1e-12) return std::nullopt;
  return Point{(du * v.y - dv * u.y) / determinant, (u.x * dv - v.x * du) / determinant};
}

double least_depth(const std::vector<HalfPlane>& planes, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfPlane& plane : planes) least = std::min(least, plane.depth(p));
  return least;
}

Point mean_of_neighbours(const Star& star) {
  Point sum;
  for (const StarCorner& c : star.corners()) sum = sum + c.q;
  return (1 / static_cast<double>(star.corners().size())) * sum;
}

}  // namespace

Point deepest_point(const Star& star, Point p) {
  std::vector<HalfPlane> planes;
  Star from_p;  // in coordinates from p, so that far from the origin nothing is lost
  for (StarCorner c : star.corners()) {
    c.q = c.q - p;
    c.r = c.r - p;
    from_p.add(c);
  }
  planes = half_planes(from_p);
  Point best;
  double deepest = least_depth(planes, best);
  const auto consider = [&](Point candidate) {
    const double depth = least_depth(planes, candidate);
    if (depth <= deepest) return;
    deepest = depth;
    best = candidate;
  };
  consider(mean_of_neighbours(from_p));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        if (const auto candidate = equally_deep(planes[i], planes[j], planes[k])) consider(*candidate);
      }
    }
  }
  return p + best;
}

UntanglingRule::UntanglingRule(const Star& star, Point p)
    : star_{star}, reference_{star.reference(p)}, sound_{star.sound_corners(p)}, now_{tangle(p)} {}

UntanglingRule::Tangle UntanglingRule::tangle(Point p) const {
  const auto sound = star_.sound_corners(p);
  return {star_.inversion(p, reference_), std::count(sound.begin(), sound.end(), 0)};
}

bool UntanglingRule::accepts(Point to) const {
  const auto sound = star_.sound_corners(to);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    if (sound_[i] != 0 && sound[i] == 0) return false;
  }
  return tangle(to) < now_;
}

std::optional<Point> untangle(const Star& star, Point p) {
  const UntanglingRule rule(star, p);
  const double edge = std::sqrt(star.reference(p));
  const Point deep = deepest_point(star, p), mean = mean_of_neighbours(star);
  std::vector<Point> candidates{deep, mean};
  for (const double share : {0.5, 0.25, 0.1}) {
    candidates.push_back(p + share * (deep - p));
    candidates.push_back(p + share * (mean - p));
    for (const Point d :
         {Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}, Point{0.7, 0.7}, Point{-0.7, 0.7}, Point{0.7, -0.7}, Point{-0.7, -0.7}}) {
      candidates.push_back(p + share * edge * d);
    }
  }
  std::optional<Point> best;
  UntanglingRule::Tangle least;
  for (const Point candidate : candidates) {
    if (!rule.accepts(candidate)) continue;
    const auto tangle = rule.tangle(candidate);
    if (best && !(tangle < least)) continue;
    best = candidate;
    least = tangle;
  }
  return best;
}

std::vector<int> ranked_places(const Star& star, Point p, Objective objective, const Star::Batch& x, const Star::Batch& y) {
  std::vector<int> order;
  const StarCost<1> now = star.cost(p, objective);
  if (now.valid[0]) {
    const Acceptance acceptance(now);
    const auto cost = star.cost(x, y, objective);
    for (int k = 0; k < Star::batch; ++k) {
      if (acceptance.accepts(cost, k)) order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cost.objective[a] < cost.objective[b]; });
    return order;
  }
  const UntanglingRule rule(star, p);
  for (int k = 0; k < Star::batch; ++k) {
    if (rule.accepts({x[k], y[k]})) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rule.tangle({x[a], y[a]}) < rule.tangle({x[b], y[b]}); });
  return order;
}

}  // namespace quadloop
