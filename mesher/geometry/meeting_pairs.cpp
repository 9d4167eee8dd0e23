#include "mesher/geometry/meeting_pairs.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t most_counted = 1000;  // a larger count gives the user no more information

/// Whether the segments from `at` to a and to b have more than this end in common.
bool overlap(Point at, Point a, Point b) { return on_segment(a, at, b) || on_segment(b, at, a); }

}  // namespace

FlatOutline::FlatOutline(const Outline& outline) {
  std::size_t size = 0;
  for (const OutlineLoop& loop : outline.loops) size += loop.points.size();
  points.reserve(size);
  loop_of.reserve(size);
  for (const OutlineLoop& loop : outline.loops) {
    loop_starts.push_back(size32(points));
    points.insert(points.end(), loop.points.begin(), loop.points.end());
    loop_of.resize(points.size(), size32(loop_starts) - 1);
  }
  loop_starts.push_back(size32(points));
}

bool FlatOutline::faulty(std::int32_t s, std::int32_t t) const {
  if (next(t) == s) std::swap(s, t);
  if (next(s) == t) return overlap(point(t), point(s), point(next(t)));
  if (loop(s) != loop(t)) {  // loops may touch in a point of both
    for (const auto& [at, from] : {std::pair(s, next(s)), std::pair(next(s), s)}) {
      if (point(t) == point(at)) return overlap(point(at), point(from), point(next(t)));
      if (point(next(t)) == point(at)) return overlap(point(at), point(from), point(t));
    }
  }
  return segments_meet(point(s), point(next(s)), point(t), point(next(t)));
}

Point FlatOutline::meeting_point(std::int32_t s, std::int32_t t) const {
  const Point a = point(s), b = point(next(s)), c = point(t), d = point(next(t));
  const bool t_follows = next(s) == t, s_follows = next(t) == s;
  if (!s_follows && on_segment(a, c, d)) return a;
  if (!t_follows && on_segment(b, c, d)) return b;
  if (!t_follows && on_segment(c, a, b)) return c;
  if (!s_follows && on_segment(d, a, b)) return d;
  const double share = cross(c - a, d - c) / cross(b - a, d - c);
  return a + std::clamp(share, 0.0, 1.0) * (b - a);
}

MeetingPairs meeting_pairs(const FlatOutline& flat) {
  std::vector<Box> boxes;
  const auto size = size32(flat.points);
  for (std::int32_t s = 0; s < size; ++s) boxes.push_back(box_of(flat.point(s), flat.point(flat.next(s))));
  const BoxTree tree(boxes);
  MeetingPairs pairs;
  std::vector<std::int32_t> met;
  for (std::int32_t s = 0; s < size && pairs.complete; ++s) {
    met.clear();
    tree.for_each_meeting(boxes[s], [&](std::int32_t t) {
      if (t > s && flat.faulty(s, t)) met.push_back(t);
    });
    if (met.empty()) continue;
    if (pairs.count == 0) {
      pairs.first = s;
      pairs.second = *std::min_element(met.begin(), met.end());
    }
    pairs.count += std::ssize(met);
    pairs.complete = pairs.count < most_counted;
  }
  return pairs;
}

}  // namespace quadloop
