#include "mesher/geometry/meeting_pairs.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

namespace bg = boost::geometry;
using IndexPoint = bg::model::point<double, 2, bg::cs::cartesian>;
using IndexBox = bg::model::box<IndexPoint>;
using Entry = std::pair<IndexBox, std::int32_t>;
using Index = bg::index::rtree<Entry, bg::index::rstar<16>>;

constexpr std::int64_t most_counted = 1000;  // enough for a user to know that the file is hopeless

IndexBox box_of(const FlatOutline& flat, std::int32_t s) {
  const Point a = flat.point(s), b = flat.point(flat.next(s));
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

}  // namespace

FlatOutline::FlatOutline(const Outline& outline) {
  for (const OutlineLoop& loop : outline.loops) {
    loop_starts.push_back(static_cast<std::int32_t>(points.size()));
    points.insert(points.end(), loop.points.begin(), loop.points.end());
    loop_of.resize(points.size(), static_cast<std::int32_t>(loop_starts.size()) - 1);
  }
  loop_starts.push_back(static_cast<std::int32_t>(points.size()));
}

bool FlatOutline::faulty(std::int32_t s, std::int32_t t) const {
  if (next(t) == s) std::swap(s, t);
  if (next(s) == t)
    return on_segment(point(s), point(t), point(next(t))) || on_segment(point(next(t)), point(s), point(t));
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
  std::vector<Entry> entries;
  const auto size = static_cast<std::int32_t>(flat.points.size());
  for (std::int32_t s = 0; s < size; ++s) entries.emplace_back(box_of(flat, s), s);
  const Index index(entries);
  MeetingPairs pairs;
  std::vector<std::int32_t> met;
  for (std::int32_t s = 0; s < size && pairs.complete; ++s) {
    met.clear();
    for (auto at = index.qbegin(bg::index::intersects(box_of(flat, s))); at != index.qend(); ++at) {
      if (at->second > s && flat.faulty(s, at->second)) met.push_back(at->second);
    }
    if (met.empty()) continue;
    if (pairs.count == 0) {
      pairs.first = s;
      pairs.second = *std::min_element(met.begin(), met.end());
    }
    pairs.count += static_cast<std::int64_t>(met.size());
    pairs.complete = pairs.count < most_counted;
  }
  return pairs;
}

}  // namespace quadloop
