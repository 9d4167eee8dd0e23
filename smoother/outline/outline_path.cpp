#include "smoother/outline/outline_path.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 2, bg::cs::cartesian>;
using Extent = bg::model::box<Corner>;
using Entry = std::pair<Extent, std::int32_t>;

constexpr std::size_t most_vertices = 1000;  ///< that one chord may stand for

Extent extent_of(Point a, Point b, double margin = 0) {
  return {{std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin},
          {std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin}};
}

/// The share of the way from a to b at which the nearest point to p lies.
double nearest_share(Point p, Point a, Point b) {
  const Point ab = b - a;
  const double square = dot(ab, ab);
  return square > 0 ? std::clamp(dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
}

double distance_to(Point p, Point a, Point b) { return length(p - a - nearest_share(p, a, b) * (b - a)); }

}  // namespace

struct OutlinePath::Index {
  bg::index::rtree<Entry, bg::index::quadratic<16>> tree;
};

OutlinePath::OutlinePath(const Geometry& geometry)
    : geometry_{geometry},
      arc_(static_cast<std::size_t>(geometry.size())),
      tolerance_{on_outline * std::max(geometry.box().width(), geometry.box().height())},
      index_{std::make_unique<Index>()} {
  std::vector<Entry> entries;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    double arc = 0;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      arc_[static_cast<std::size_t>(v)] = arc;
      const Point a = geometry.point(v), b = geometry.point(geometry.next(v));
      arc += length(b - a);
      entries.emplace_back(extent_of(a, b), v);
    }
    length_.push_back(arc);
  }
  index_->tree = decltype(index_->tree)(entries);
}

OutlinePath::~OutlinePath() = default;

double OutlinePath::within(std::int32_t loop, double arc) const {
  const double whole = loop_length(loop);
  if (arc < 0) arc += whole;
  return arc >= whole ? arc - whole : arc;
}

std::int32_t OutlinePath::segment_at(std::int32_t loop, double arc) const {
  const auto first = arc_.begin() + geometry_.loop_start(loop),
             last = arc_.begin() + geometry_.loop_start(loop + 1);
  return static_cast<std::int32_t>(std::upper_bound(first + 1, last, arc) - arc_.begin()) - 1;
}

/// The nearest segment of that boundary, the lowest of several; none where it is farther than `within`.
OutlinePath::Nearest OutlinePath::nearest(Point p, const std::string& boundary, double within) const {
  Nearest found_so_far{-1, within};
  auto& [segment, nearest] = found_so_far;
  const Extent around = extent_of(p, p, within);
  for (auto found = index_->tree.qbegin(bg::index::intersects(around)); found != index_->tree.qend();
       ++found) {
    const std::int32_t s = found->second;
    if (geometry_.boundary(geometry_.boundary_of(s)).name != boundary) continue;
    const double distance = distance_to(p, geometry_.point(s), geometry_.point(geometry_.next(s)));
    if (distance > nearest || (distance == nearest && segment >= 0 && s > segment)) continue;
    nearest = distance;
    segment = s;
  }
  return found_so_far;
}

bool OutlinePath::has(const std::string& boundary) const {
  const auto boundaries = geometry_.boundaries();
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [&](const Boundary& b) { return b.name == boundary; });
}

double OutlinePath::distance(Point p, const std::string& boundary, double within) const {
  const Nearest found = nearest(p, boundary, within);
  return found.segment < 0 ? std::numeric_limits<double>::infinity() : found.distance;
}

OutlinePlace OutlinePath::locate(Point p, const std::string& boundary, bool also_kept) const {
  const std::int32_t segment = nearest(p, boundary, tolerance_).segment;
  if (segment < 0) return {};
  for (const std::int32_t v : {segment, geometry_.next(segment)}) {
    if (!also_kept && geometry_.kept(v) && length(p - geometry_.point(v)) <= tolerance_) return {};
  }
  const Point a = geometry_.point(segment), b = geometry_.point(geometry_.next(segment));
  const std::int32_t loop = geometry_.loop_of(segment);
  return {loop,
          within(loop, arc_[static_cast<std::size_t>(segment)] + nearest_share(p, a, b) * length(b - a))};
}

Point OutlinePath::point_at(OutlinePlace place) const {
  const double arc = within(place.loop, place.arc);
  const std::int32_t s = segment_at(place.loop, arc);
  const Point a = geometry_.point(s), b = geometry_.point(geometry_.next(s));
  const double whole = length(b - a), along = arc - arc_[static_cast<std::size_t>(s)];
  return along >= whole ? b : a + (along / whole) * (b - a);
}

double OutlinePath::way(OutlinePlace from, OutlinePlace to) const {
  return within(from.loop, to.arc - from.arc);
}

double OutlinePath::deviation(OutlinePlace from, Point a, OutlinePlace to, Point b) const {
  const double end = way(from, to), start = within(from.loop, from.arc);
  double deviation = 0;
  std::int32_t v = geometry_.next(segment_at(from.loop, start));
  for (std::size_t passed = 0; passed < most_vertices; ++passed, v = geometry_.next(v)) {
    const double arc = way({from.loop, start}, {from.loop, arc_[static_cast<std::size_t>(v)]});
    if (arc >= end || (arc == 0 && passed > 0)) return deviation;
    deviation = std::max(deviation, distance_to(geometry_.point(v), a, b));
  }
  return std::numeric_limits<double>::infinity();
}

/// Whether a segment is a part of the way between two places, or touches its ends a and b there.
bool OutlinePath::belongs(std::int32_t segment, OutlinePlace from, Point a, OutlinePlace to, Point b) const {
  if (geometry_.loop_of(segment) != from.loop) return false;
  const std::int32_t first = segment_at(from.loop, within(from.loop, from.arc)),
                     last = segment_at(to.loop, within(to.loop, to.arc));
  if (segment == first || segment == last) return true;
  if (segment == geometry_.previous(first) && length(geometry_.point(first) - a) <= tolerance_) return true;
  if (segment == geometry_.next(last) && length(geometry_.point(segment) - b) <= tolerance_) return true;
  return way(from, {from.loop, arc_[static_cast<std::size_t>(segment)]}) <= way(from, to);
}

std::vector<std::int32_t> OutlinePath::met_elsewhere(const Chord& chord) const {
  std::vector<std::int32_t> met;
  for (auto found = index_->tree.qbegin(bg::index::intersects(extent_of(chord.a, chord.b)));
       found != index_->tree.qend(); ++found) {
    const std::int32_t s = found->second;
    if (belongs(s, chord.from, chord.a, chord.to, chord.b)) continue;
    if (segments_meet(chord.a, chord.b, geometry_.point(s), geometry_.point(geometry_.next(s))))
      met.push_back(s);
  }
  return met;
}

bool OutlinePath::sweeps_over(const Chord& chord, Point apex) const {
  const Point a = chord.a, b = chord.b, c = apex;
  Extent around = extent_of(a, b);
  bg::expand(around, Corner{c.x, c.y});
  for (auto found = index_->tree.qbegin(bg::index::intersects(around)); found != index_->tree.qend();
       ++found) {
    const Point v = geometry_.point(found->second);
    const std::array<int, 3> turns{orientation(a, b, v), orientation(b, c, v), orientation(c, a, v)};
    const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
    const bool in_triangle = *least * *most >= 0 && (*least != 0 || *most != 0);
    if (in_triangle && !belongs(found->second, chord.from, a, chord.to, b)) return true;
  }
  return false;
}

std::vector<std::int32_t> OutlinePath::segments_between(OutlinePlace from, OutlinePlace to) const {
  std::vector<std::int32_t> segments;
  const double start = within(from.loop, from.arc), end = within(to.loop, to.arc);
  const std::int32_t last = segment_at(to.loop, end);
  bool goes_round =
      end < start;  // on the way over the loop's first vertex, perhaps back to the segment where it begins
  for (std::int32_t s = segment_at(from.loop, start); segments.size() < most_vertices;
       s = geometry_.next(s)) {
    segments.push_back(s);
    if (s == last && !(goes_round && segments.size() == 1)) return segments;
  }
  return {};
}

}  // namespace quadloop
