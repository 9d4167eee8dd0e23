#include "mesher/geometry/assemble/split_curves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesher/geometry/box_tree.hpp"

namespace quadloop {

namespace {

constexpr int deepest = 26;               // halvings of an interval; then a curve is its chord to rounding
constexpr double beyond_chord = 1e-3;     // of these chords: tolerance of their intersection
constexpr double least_sine = 1e-6;       // of the angle between chords that intersect
constexpr double at_end = 0x1p-36;        // parameters this near to an end count as the end
constexpr std::size_t most_pairs = 4096;  // of one crossing: more if curves touch over a length

/// A part of a segment, with its interval of the parameter.
struct Part {
  CurvedSegment segment;
  double low = 0, high = 1;

  double middle() const { return 0.5 * (low + high); }
  Box box() const {
    Box box = box_of(segment.from, segment.to);
    for (const Point p : segment.curve.inner) box.include(p);
    return box;
  }
  std::pair<Part, Part> halves() const {
    const auto [first, second] = quadloop::halves(segment);
    return {{first, low, middle()}, {second, middle(), high}};
  }
};

/// Parameters on two segments where they meet.
struct Meeting {
  double on_first = 0, on_second = 0;
  Point point;
};

/// Where the chords of two small parts intersect.
std::optional<Meeting> intersection_of(const Part& a, const Part& b) {
  const Point along = a.segment.to - a.segment.from, other = b.segment.to - b.segment.from,
              between = b.segment.from - a.segment.from;
  const double area = cross(along, other);
  if (std::abs(area) <= least_sine * length(along) * length(other)) return {};
  const double s = cross(between, other) / area, t = cross(between, along) / area;
  if (std::min(s, t) < -beyond_chord || std::max(s, t) > 1 + beyond_chord) return {};
  return Meeting{a.low + s * (a.high - a.low), b.low + t * (b.high - b.low), a.segment.from + s * along};
}

bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Where two segments meet: both are halved as long as the boxes of their control points overlap. None if
/// they touch over a length.
std::vector<Meeting> meetings_of(const CurvedSegment& first, const CurvedSegment& second) {
  std::vector<std::pair<Part, Part>> pairs{{{first}, {second}}};
  for (int depth = 0; depth < deepest && !pairs.empty(); ++depth) {
    std::vector<std::pair<Part, Part>> finer;
    for (const auto& [a, b] : pairs) {
      const auto halves_of_a = a.halves(), halves_of_b = b.halves();
      for (const Part* const x : {&halves_of_a.first, &halves_of_a.second}) {
        for (const Part* const y : {&halves_of_b.first, &halves_of_b.second}) {
          if (overlap(x->box(), y->box())) finer.emplace_back(*x, *y);
        }
      }
    }
    if (finer.size() > most_pairs) return {};
    pairs = std::move(finer);
  }
  std::vector<Meeting> meetings;
  for (const auto& [a, b] : pairs) {
    const std::optional<Meeting> here = intersection_of(a, b);
    const auto is_known = [&](const Meeting& m) {
      return std::abs(m.on_first - here->on_first) < at_end &&
             std::abs(m.on_second - here->on_second) < at_end;
    };
    if (here && std::ranges::none_of(meetings, is_known)) meetings.push_back(*here);
  }
  return meetings;
}

bool is_start(double parameter) { return parameter < at_end; }
bool is_end(double parameter) { return parameter > 1 - at_end; }
bool is_inner(double parameter) { return !is_start(parameter) && !is_end(parameter); }

/// The two parts of a segment at a parameter, which meet in a given point (de Casteljau).
std::pair<CurvedSegment, CurvedSegment> parts_at(const CurvedSegment& segment, double t, Point at) {
  struct WeightedPoint {
    double x = 0, y = 0, weight = 1;
  };
  const Curve& curve = segment.curve;
  std::vector<Point> control{segment.from};
  control.insert(control.end(), curve.inner.begin(), curve.inner.end());
  control.push_back(segment.to);
  std::vector<WeightedPoint> poles;
  for (std::size_t i = 0; i < control.size(); ++i) {
    const double weight = curve.weights.empty() ? 1 : curve.weights[i];
    poles.push_back({weight * control[i].x, weight * control[i].y, weight});
  }
  std::vector<WeightedPoint> before{poles.front()}, after{poles.back()};
  for (std::size_t round = poles.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) {
      const WeightedPoint &a = poles[i], &b = poles[i + 1];
      poles[i] = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.weight + t * (b.weight - a.weight)};
    }
    before.push_back(poles.front());
    after.push_back(poles[round - 1]);
  }
  std::ranges::reverse(after);
  const auto part = [&](const std::vector<WeightedPoint>& of, Point from, Point to) {
    CurvedSegment made{from, {{}, {}, curve.spacing, curve.interpolates}, to};
    for (std::size_t i = 1; i + 1 < of.size(); ++i)
      made.curve.inner.push_back({of[i].x / of[i].weight, of[i].y / of[i].weight});
    for (std::size_t i = 0; !curve.weights.empty() && i < of.size(); ++i)
      made.curve.weights.push_back(of[i].weight);
    return made;
  };
  return {part(before, segment.from, at), part(after, at, segment.to)};
}

/// A segment of a chain, with the places where others meet it.
struct MetSegment {
  std::size_t chain = 0;
  CurvedSegment segment;
  struct Place {
    double parameter = 0;
    Point point;
  };
  std::vector<Place> places = {};

  void add(double parameter, Point point) {
    const auto near = [&](const Place& p) { return std::abs(p.parameter - parameter) < at_end; };
    if (std::ranges::none_of(places, near)) places.push_back({parameter, point});
  }

  std::vector<CurvedSegment> split() const {
    std::vector<Place> ordered = places;
    std::ranges::sort(ordered, {}, &Place::parameter);
    std::vector<CurvedSegment> pieces;
    CurvedSegment rest = segment;
    double reached = 0;
    for (const Place& place : ordered) {
      auto [before, after] = parts_at(rest, (place.parameter - reached) / (1 - reached), place.point);
      pieces.push_back(std::move(before));
      rest = std::move(after);
      reached = place.parameter;
    }
    pieces.push_back(std::move(rest));
    return pieces;
  }
};

Point end_at(const CurvedSegment& segment, double parameter) {
  return is_start(parameter) ? segment.from : segment.to;
}

/// Adds the common points of two segments, of which one at least is a curve.
void meet(MetSegment& first, MetSegment& second) {
  for (const Meeting& m : meetings_of(first.segment, second.segment)) {
    const bool inner_first = is_inner(m.on_first), inner_second = is_inner(m.on_second);
    if (!inner_first && !inner_second) continue;
    const Point at = !inner_first    ? end_at(first.segment, m.on_first)
                     : !inner_second ? end_at(second.segment, m.on_second)
                                     : m.point;
    if (inner_first) first.add(m.on_first, at);
    if (inner_second) second.add(m.on_second, at);
  }
}

std::vector<MetSegment> segments_of(const std::vector<Chain>& chains) {
  std::vector<MetSegment> segments;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const std::size_t count = chain.points.size() - (chain.open ? 1 : 0);
    for (std::size_t s = 0; s < count; ++s)
      segments.push_back({c,
                          {chain.points[s], chain.curves.empty() ? Curve{} : chain.curves[s],
                           chain.points[(s + 1) % chain.points.size()]}});
  }
  return segments;
}

bool is_same(const CurvedSegment& a, const CurvedSegment& b) {
  return a.from == b.from && a.to == b.to && a.curve == b.curve;
}

}  // namespace

void split_curves_at_crossings(std::vector<Chain>& chains) {
  if (std::ranges::all_of(chains, [](const Chain& chain) { return chain.curves.empty(); })) return;
  std::vector<MetSegment> segments = segments_of(chains);
  const auto box_at = [&](std::int32_t i) { return Part{segments[i].segment}.box(); };
  const BoxTree tree(size32(segments), box_at);
  for (std::int32_t i = 0; i < size32(segments); ++i) {
    tree.for_each_meeting(box_at(i), [&](std::int32_t j) {
      MetSegment &a = segments[i], &b = segments[j];
      if (j <= i || a.chain == b.chain || (a.segment.curve.straight() && b.segment.curve.straight())) return;
      if (is_same(a.segment, b.segment) || is_same(a.segment, reversed(b.segment))) return;
      meet(a, b);
    });
  }
  if (std::ranges::all_of(segments, [](const MetSegment& met) { return met.places.empty(); })) return;
  for (Chain& chain : chains) {
    if (chain.open && chain.points.size() > 1)
      chain.points.erase(chain.points.begin(), chain.points.end() - 1);
    if (!chain.open) chain.points.clear();
    chain.curves.clear();
  }
  for (const MetSegment& met : segments) {
    Chain& chain = chains[met.chain];
    for (const CurvedSegment& piece : met.split()) {
      chain.points.insert(chain.points.end() - (chain.open ? 1 : 0), piece.from);
      chain.curves.push_back(piece.curve);
    }
  }
  for (Chain& chain : chains) {
    if (std::ranges::all_of(chain.curves, &Curve::straight)) chain.curves.clear();
  }
}

}  // namespace quadloop
