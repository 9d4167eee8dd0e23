#include "mesher/geometry/assemble/pair_outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double largest_difference = 1e-5, rounding = 1e-12;  // relative to the length of `from`

/// The part of a loop that belongs to one boundary.
struct PairSide {
  std::size_t loop = 0, first = 0, segments = 0;
  std::vector<Point> points;  ///< one more than there are segments
  std::vector<Curve> curves;  ///< one for each segment
};

[[noreturn]] void refuse_pair(const WantedPair& wanted, const std::string& what) {
  throw InputError(fmt::format("{}: [[pair]]: {}", wanted.where, what));
}

BoundaryId boundary_named(const Outline& outline, const WantedPair& wanted, const std::string& name) {
  const auto found = std::ranges::find(outline.names, name);
  if (found == outline.names.end())
    refuse_pair(wanted, fmt::format("the geometry has no boundary '{}'; its boundaries are: {}{}", name,
                                    first_few(outline.names), guess_for(name, outline.names)));
  return BoundaryId{static_cast<std::int32_t>(found - outline.names.begin())};
}

/// The points and curves of the side, for its segments first .. first + segments - 1 of the loop.
void copy_shape(const OutlineLoop& loop, PairSide& side) {
  const std::size_t size = loop.points.size();
  for (std::size_t i = 0; i <= side.segments; ++i) {
    const std::size_t at = (side.first + i) % size;
    side.points.push_back(loop.points[at]);
    if (i < side.segments) side.curves.push_back(loop.curves.empty() ? Curve{} : loop.curves[at]);
  }
}

PairSide side_named(const Outline& outline, const WantedPair& wanted, const std::string& name) {
  const BoundaryId boundary = boundary_named(outline, wanted, name);
  std::optional<PairSide> side;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const OutlineLoop& loop = outline.loops[l];
    const std::size_t size = loop.points.size();
    const auto is_of = [&](std::size_t s) { return loop.boundary[s % size] == boundary; };
    for (std::size_t s = 0; s < size; ++s) {
      const bool begins = is_of(s) && !is_of(s + size - 1);
      if (!begins && !(s == 0 && std::ranges::count(loop.boundary, boundary) == std::ssize(loop.boundary)))
        continue;
      const Point p = loop.points[s];
      if (side || !begins)
        refuse_pair(wanted, fmt::format("boundary '{}' {} at ({:.6g}, {:.6g}), but a side of a pair is one "
                                        "open line; give its other parts names of their own",
                                        name, begins ? "begins again" : "is a closed loop", p.x, p.y));
      side = PairSide{l, s, 1, {}, {}};
      while (is_of(s + side->segments)) ++side->segments;
    }
  }
  QUADLOOP_REQUIRE(side.has_value(), "a boundary of an outline has a segment");
  copy_shape(outline.loops[side->loop], *side);
  return *side;
}

PairSide image_of(const PeriodicPair& pair, PairSide side) {
  for (Point& p : side.points) p = pair.image(p);
  for (Curve& curve : side.curves) {
    for (Point& p : curve.inner) p = pair.image(p);
  }
  return side;
}

void turn_round(PairSide& side) {
  std::ranges::reverse(side.points);
  side.curves = reversed(std::move(side.curves));
}

CurvedSegment segment_of(const PairSide& side, std::size_t s) {
  return {side.points[s], side.curves[s], side.points[s + 1]};
}

/// Vertices, and points of the curves between them.
std::vector<Point> samples_of(const PairSide& side, int parts) {
  std::vector<Point> samples;
  for (std::size_t s = 0; s < side.curves.size(); ++s) {
    samples.push_back(side.points[s]);
    for (int k = 1; k < parts && !side.curves[s].straight(); ++k)
      samples.push_back(point_at(segment_of(side, s), double(k) / parts));
  }
  samples.push_back(side.points.back());
  return samples;
}

double length_of(const std::vector<Point>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += length(line[i] - line[i - 1]);
  return sum;
}

struct Difference {
  double distance = 0;
  Point place;
};

/// The largest distance of a side from a line, and where it is.
Difference difference_from(const PairSide& side, const std::vector<Point>& line) {
  Difference largest;
  for (const Point p : samples_of(side, 2)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < line.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(p, line[i - 1], line[i]));
    if (nearest > largest.distance) largest = {nearest, p};
  }
  return largest;
}

/// Chords between samples of a curve are nearer than this to it.
double height_of_samples(const PairSide& side, int parts) {
  double height = 0;
  for (std::size_t s = 0; s < side.curves.size(); ++s)
    if (!side.curves[s].straight()) height = std::max(height, height_of_hull(segment_of(side, s)));
  return 4 * height / (parts * parts);
}

Difference largest_of(const PairSide& image, const PairSide& given) {
  constexpr int parts = 32;
  Difference found;
  for (const auto& [one, other] : {std::pair(&image, &given), std::pair(&given, &image)}) {
    Difference difference = difference_from(*one, samples_of(*other, parts));
    difference.distance = std::max(0.0, difference.distance - height_of_samples(*other, parts));
    if (difference.distance > found.distance) found = difference;
  }
  for (const auto& [p, q] : {std::pair(image.points.front(), given.points.front()),
                             std::pair(image.points.back(), given.points.back())}) {
    if (length(p - q) > found.distance) found = {length(p - q), q};
  }
  return found;
}

std::string map_text(const PeriodicPair& pair) {
  return pair.rotates()
             ? fmt::format("rotation = {:g}, centre = [{:.6g}, {:.6g}]", pair.degrees, pair.centre.x,
                           pair.centre.y)
             : fmt::format("translation = [{:.6g}, {:.6g}]", pair.translation.x, pair.translation.y);
}

/// Puts another line in the place of a side.
void replace_side(const PairSide& old, const PairSide& by, OutlineLoop& loop) {
  if (loop.curves.empty()) loop.curves.resize(loop.points.size());
  const BoundaryId boundary = loop.boundary[old.first];
  std::ranges::rotate(loop.points, loop.points.begin() + old.first);
  std::ranges::rotate(loop.boundary, loop.boundary.begin() + old.first);
  std::ranges::rotate(loop.curves, loop.curves.begin() + old.first);
  loop.points.erase(loop.points.begin(), loop.points.begin() + old.segments);
  loop.boundary.erase(loop.boundary.begin(), loop.boundary.begin() + old.segments);
  loop.curves.erase(loop.curves.begin(), loop.curves.begin() + old.segments);
  loop.points.front() = by.points.back();
  loop.points.insert(loop.points.begin(), by.points.begin(), by.points.end() - 1);
  loop.boundary.insert(loop.boundary.begin(), by.curves.size(), boundary);
  loop.curves.insert(loop.curves.begin(), by.curves.begin(), by.curves.end());
  if (std::ranges::all_of(loop.curves, &Curve::straight)) loop.curves.clear();
}

void match_sides(Outline& outline, const WantedPair& wanted, std::vector<std::string>& warnings) {
  const PeriodicPair& pair = wanted.pair;
  const PairSide from = side_named(outline, wanted, pair.from), given = side_named(outline, wanted, pair.to);
  PairSide image = image_of(pair, from);
  const auto gap = [&] {
    return std::max(length(image.points.front() - given.points.front()),
                    length(image.points.back() - given.points.back()));
  };
  const double as_it_is = gap();
  turn_round(image);  // two sides of one loop have opposite directions
  if (as_it_is < gap()) turn_round(image);
  const Difference difference = largest_of(image, given);
  const double extent = length_of(from.points);
  if (difference.distance > largest_difference * extent)
    refuse_pair(wanted, fmt::format("boundary '{}' is not the image of '{}' by {}: they are {:.3g} apart at "
                                    "({:.6g}, {:.6g}); correct the map, or the outline there",
                                    pair.to, pair.from, map_text(pair), difference.distance,
                                    difference.place.x, difference.place.y));
  if (difference.distance > rounding * extent)
    warnings.push_back(
        fmt::format("boundary '{}' moved by up to {:.2g}, near ({:.6g}, {:.6g}), to be the "
                    "image of '{}' exactly",
                    pair.to, difference.distance, difference.place.x, difference.place.y, pair.from));
  replace_side(given, image, outline.loops[given.loop]);
}

}  // namespace

void match_outlines(Outline& outline, const std::vector<WantedPair>& pairs,
                    std::vector<std::string>& warnings) {
  for (const WantedPair& wanted : pairs) match_sides(outline, wanted, warnings);
}

}  // namespace quadloop
