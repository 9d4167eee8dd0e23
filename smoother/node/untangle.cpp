#include "smoother/node/untangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop::smoother {

namespace {

/// The half plane n . p + c >= t of an opposite edge, with |n| = 1; t is the distance of p to the left of the
/// edge.
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

/// The point of equal depth in three half planes, if it exists.
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
  return (1.0 / size32(star.corners())) * sum;
}

/// Finds the point of largest minimum depth: a linear program in three unknowns, solved by the dual simplex
/// method. Three half planes are the basis. The half plane with the least depth at the basis point enters and
/// replaces one of them, so that the depth falls, until no half plane has a smaller depth. A step costs one
/// pass over the half planes; the number of steps is small and bounded by a few times their number.
class DeepestPlace {
 public:
  explicit DeepestPlace(std::vector<HalfPlane> planes) : planes_{std::move(planes)} {}

  /// Returns a point at least as deep as any of the guesses, even if rounding ends the search early.
  Point find(std::initializer_list<Point> guesses) {
    for (const Point guess : guesses) consider(guess);
    Basis basis = far_away();
    Held held{*equally_deep(basis[0], basis[1], basis[2]), basis[0].c};
    for (std::size_t step = 0; step < steps_per_plane * planes_.size(); ++step) {
      const HalfPlane& shallowest = *std::min_element(
          planes_.begin(), planes_.end(),
          [&](const auto& a, const auto& b) { return a.depth(held.place) < b.depth(held.place); });
      const auto next = exchange(basis, shallowest);
      if (!next || !(next->depth < held.depth)) break;
      held = *next;
      consider(held.place);
    }
    return best_;
  }

 private:
  static constexpr std::size_t steps_per_plane = 4;
  using Basis = std::array<HalfPlane, 3>;
  struct Held {
    Point place;
    double depth = 0;
  };

  /// Three half planes that enclose all others, so deep that any other enters first.
  Basis far_away() const {
    double reach = 0;
    for (const HalfPlane& plane : planes_) reach = std::max(reach, std::abs(plane.c));
    const double c = reach > 0 ? 1e3 * reach : 1, s = std::numbers::sqrt3 / 2;
    return {HalfPlane{{1, 0}, c}, HalfPlane{{-0.5, s}, c}, HalfPlane{{-0.5, -s}, c}};
  }

  /// Of the four half planes, selects as the new basis the three whose point is deepest in all four.
  std::optional<Held> exchange(Basis& basis, const HalfPlane& entering) const {
    std::optional<Held> deepest;
    Basis chosen = basis;
    for (std::size_t leaving = 0; leaving < 3; ++leaving) {
      Basis trial = basis;
      trial[leaving] = entering;
      const auto place = equally_deep(trial[0], trial[1], trial[2]);
      if (!place) continue;
      const double depth =
          std::min(entering.depth(*place),
                   std::min({basis[0].depth(*place), basis[1].depth(*place), basis[2].depth(*place)}));
      if (deepest && depth <= deepest->depth) continue;
      deepest = Held{*place, depth};
      chosen = trial;
    }
    basis = chosen;
    return deepest;
  }

  void consider(Point candidate) {
    const double depth = least_depth(planes_, candidate);
    if (depth <= deepest_) return;
    deepest_ = depth;
    best_ = candidate;
  }

  std::vector<HalfPlane> planes_;
  Point best_;
  double deepest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Point deepest_point(const Star& star, Point p) {
  Star from_p;  // relative to p, to keep precision far from the origin
  for (StarCorner c : star.corners()) {
    c.q = c.q - p;
    c.r = c.r - p;
    from_p.add(c);
  }
  return p + DeepestPlace(half_planes(from_p)).find({Point{}, mean_of_neighbours(from_p)});
}

UntanglingRule::UntanglingRule(const Star& star, Point p, Objective objective)
    : star_{star},
      objective_{objective},
      reference_{star.reference(p)},
      sound_{star.sound_corners(p)},
      now_{tangle(p)} {}

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

bool UntanglingRule::prefers(Point a, Point b) const {
  switch (objective_) {
    case Objective::thesis: return star_.nodal_cost(a, reference_) < star_.nodal_cost(b, reference_);
    case Objective::power: return tangle(a) < tangle(b);
  }
  QUADLOOP_REQUIRE(false, "an objective that prefers no place to another");
  return false;
}

std::optional<Point> untangle(const Star& star, Point p, Objective objective) {
  const UntanglingRule rule(star, p, objective);
  const double edge = std::sqrt(star.reference(p));
  const Point deep = deepest_point(star, p), mean = mean_of_neighbours(star);
  std::vector<Point> candidates{deep, mean};
  for (const double share : {0.5, 0.25, 0.1}) {
    candidates.push_back(p + share * (deep - p));
    candidates.push_back(p + share * (mean - p));
    for (const Point d : {Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}, Point{0.7, 0.7},
                          Point{-0.7, 0.7}, Point{0.7, -0.7}, Point{-0.7, -0.7}}) {
      candidates.push_back(p + share * edge * d);
    }
  }
  std::optional<Point> best;
  for (const Point candidate : candidates) {
    if (rule.accepts(candidate) && (!best || rule.prefers(candidate, *best))) best = candidate;
  }
  return best;
}

std::vector<int> ranked_places(const Star& star, Point p, Objective objective, const Star::Batch& x,
                               const Star::Batch& y) {
  std::vector<int> order;
  order.reserve(Star::batch);
  const StarCost<1> now = star.cost(p, objective);
  if (now.valid[0]) {
    const Acceptance acceptance(now);
    const auto cost = star.cost(x, y, objective);
    for (int k = 0; k < Star::batch; ++k) {
      if (acceptance.accepts(cost, k)) order.push_back(k);
    }
    std::ranges::sort(order, {}, [&](int k) { return std::pair(cost.objective[k], k); });
    return order;
  }
  const UntanglingRule rule(star, p, objective);
  for (int k = 0; k < Star::batch; ++k) {
    if (rule.accepts({x[k], y[k]})) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return rule.prefers({x[a], y[a]}, {x[b], y[b]});
  });
  return order;
}

}  // namespace quadloop::smoother
