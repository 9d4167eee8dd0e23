#include "mesher/geometry/assemble/curve_meetings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace quadloop {

namespace {

constexpr int deepest = 26;               // halvings of an interval; then a curve is its chord to rounding
constexpr double beyond_chord = 1e-3;     // of these chords: tolerance of their intersection
constexpr double least_sine = 1e-6;       // of the angle between chords that intersect
constexpr std::size_t most_pairs = 4096;  // of one crossing: more if curves touch over a length

/// A part of a segment, with its interval of the parameter.
struct Part {
  CurvedSegment segment;
  double low = 0, high = 1;

  double middle() const { return 0.5 * (low + high); }
  double at(double share) const { return low + share * (high - low); }
  double chord() const { return length(segment.to - segment.from); }
  /// Its halves, or the part itself if it is smaller than `near`.
  std::vector<Part> parts(double near) const {
    const Box box = box_of(segment);
    if (std::max(box.width(), box.height()) <= near) return {*this};
    const auto [first, second] = quadloop::halves(segment);
    return {{first, low, middle()}, {second, middle(), high}};
  }
  /// Whether a share of its chord, which may be outside the range from 0 to 1, is on it or beyond an end of
  /// the whole segment by no more than `near`.
  bool holds(double share, double near) const {
    const double of_end = std::max(beyond_chord, near / chord());
    return share >= -(low == 0 ? of_end : beyond_chord) && share <= 1 + (high == 1 ? of_end : beyond_chord);
  }
};

/// Where the chords of two small parts intersect.
std::optional<CurveMeeting> intersection_of(const Part& a, const Part& b, double near) {
  const Point along = a.segment.to - a.segment.from, other = b.segment.to - b.segment.from,
              between = b.segment.from - a.segment.from;
  const double area = cross(along, other);
  if (std::abs(area) <= least_sine * length(along) * length(other)) return {};
  const double s = cross(between, other) / area, t = cross(between, along) / area;
  if (!a.holds(s, near) || !b.holds(t, near)) return {};
  return CurveMeeting{a.at(s), b.at(t), a.segment.from + s * along};
}

bool overlap(const Box& a, const Box& b, double near) {
  return a.low.x <= b.high.x + near && b.low.x <= a.high.x + near && a.low.y <= b.high.y + near &&
         b.low.y <= a.high.y + near;
}

bool is_same(const CurveMeeting& a, const CurveMeeting& b, double near) {
  const auto apart = [](double s, double t) { return std::abs(s - t); };
  return length(a.point - b.point) <= near ||
         (apart(a.on_first, b.on_first) < nearest_to_end && apart(a.on_second, b.on_second) < nearest_to_end);
}

}  // namespace

std::vector<CurveMeeting> meetings_of(const CurvedSegment& first, const CurvedSegment& second, double near) {
  std::vector<std::pair<Part, Part>> pairs{{{first}, {second}}};
  for (int depth = 0; depth < deepest && !pairs.empty(); ++depth) {
    std::vector<std::pair<Part, Part>> finer;
    for (const auto& [a, b] : pairs) {
      const std::vector<Part> parts_of_b = b.parts(near);
      for (const Part& x : a.parts(near)) {
        const Box box = box_of(x.segment);
        for (const Part& y : parts_of_b) {
          if (overlap(box, box_of(y.segment), near)) finer.emplace_back(x, y);
        }
      }
    }
    if (finer.size() > most_pairs) return {};
    pairs = std::move(finer);
  }
  std::vector<CurveMeeting> meetings;
  for (const auto& [a, b] : pairs) {
    const std::optional<CurveMeeting> here = intersection_of(a, b, near);
    if (here && std::ranges::none_of(meetings, [&](const auto& m) { return is_same(m, *here, near); }))
      meetings.push_back(*here);
  }
  return meetings;
}

}  // namespace quadloop
