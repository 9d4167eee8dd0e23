#include "mesher/geometry/assemble/mirrored_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// A segment of a chain, with its curve.
struct Place {
  Chain* chain = nullptr;
  std::size_t segment = 0;

  Point from() const { return chain->points[segment]; }
  Point to() const { return chain->points[(segment + 1) % chain->points.size()]; }
  Curve& curve() const { return chain->curves[segment]; }
};

using Ends = std::pair<Point, Point>;

std::vector<Place> curved_segments(std::vector<Chain>& chains) {
  std::vector<Place> places;
  for (Chain& chain : chains) {
    for (std::size_t s = 0; s < chain.curves.size(); ++s) {
      if (!chain.curves[s].straight()) places.push_back({&chain, s});
    }
  }
  return places;
}

Curve image_of(MirrorAxis axis, Curve curve) {
  for (Point& p : curve.inner) p = image_of(axis, p);
  return curve;
}

Curve mean_of(const Curve& a, const Curve& b) {
  Curve mean = a;
  for (std::size_t i = 0; i < mean.inner.size(); ++i) mean.inner[i] = 0.5 * (a.inner[i] + b.inner[i]);
  for (std::size_t i = 0; i < mean.weights.size(); ++i) mean.weights[i] = 0.5 * (a.weights[i] + b.weights[i]);
  return mean;
}

bool are_near(const Curve& a, const Curve& b, double tolerance) {
  constexpr double same_weight = 1e-9;
  const auto near = [&](Point p, Point q) { return length(p - q) <= tolerance; };
  const auto same = [&](double v, double w) { return std::abs(v - w) <= same_weight * v; };
  return std::ranges::equal(a.inner, b.inner, near) && std::ranges::equal(a.weights, b.weights, same);
}

/// The sum of the heights of all control points: its sign tells on which side of the axis a curve lies.
double height_of(const Place& place, MirrorAxis axis) {
  double sum = height_over(axis, place.from()) + height_over(axis, place.to());
  for (const Point p : place.curve().inner) sum += height_over(axis, p);
  return sum;
}

[[noreturn]] void refuse(const Place& place, MirrorAxis axis) {
  const Point p = place.from(), q = place.to();
  throw InputError(fmt::format(
      "{}: boundary {}: the curve from ({}, {}) to ({}, {}) has no mirror image, which mesh.mirror = \"{}\" "
      "requires; make the geometry symmetric, or remove the key",
      place.chain->source, place.chain->name, p.x, p.y, q.x, q.y, name_of(axis)));
}

}  // namespace

void fit_curves_to_mirror(std::vector<Chain>& chains, MirrorAxis axis, double tolerance) {
  const std::vector<Place> places = curved_segments(chains);
  std::multimap<Ends, Place> by_ends;
  for (const Place& place : places) by_ends.emplace(Ends{place.from(), place.to()}, place);
  // The image of a curve from one point to another, among the curves between their images.
  const auto find_image = [&](const Place& of, Curve& image) -> const Place* {
    const Point from = image_of(axis, of.from()), to = image_of(axis, of.to());
    for (const bool turned : {true, false}) {
      const auto [begin, end] = by_ends.equal_range(turned ? Ends{to, from} : Ends{from, to});
      for (auto at = begin; at != end; ++at) {
        Curve other = image_of(axis, at->second.curve());
        image = turned ? reversed(std::move(other)) : std::move(other);
        if (are_near(of.curve(), image, tolerance)) return &at->second;
      }
    }
    return nullptr;
  };
  for (const Place& place : places) {
    Curve image;
    const Place* const other = find_image(place, image);
    if (other == nullptr) refuse(place, axis);
    if (other->chain == place.chain && other->segment == place.segment)
      place.curve() = mean_of(place.curve(), image);
    else if (height_of(place, axis) < 0)
      place.curve() = std::move(image);
  }
}

}  // namespace quadloop
