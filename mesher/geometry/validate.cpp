#include "mesher/geometry/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/geometry/meeting_pairs.hpp"
#include "mesher/geometry/point_table.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// Sweeps a line over the plane from left to right (points ordered by x, then y, so that no segment is
/// parallel to the line) and keeps the segments that it crosses in their order along it (Shamos and Hoey
/// 1976). If two segments meet, two neighbours in that order do. The segment below a loop's first point
/// determines the loop's nesting.
class Sweep {
 public:
  explicit Sweep(const FlatOutline& flat)
      : flat_{flat},
        status_{Below{this}},
        status_at_(flat.points.size()),
        below_(flat.loop_count(), none),
        begun_(flat.loop_count()) {}

  /// Whether no two segments meet. Stops at the first indication that some do.
  bool run() {
    const std::vector<Event> starts = local_starts();
    auto start = starts.begin();
    std::vector<std::int32_t> at_place;
    while (!met_ && (start != starts.end() || !coming_.empty())) {
      const bool starts_first =
          coming_.empty() || (start != starts.end() && start->place < coming_.top().place);
      const Point place = starts_first ? start->place : coming_.top().place;
      at_place.clear();
      for (; start != starts.end() && start->place == place; ++start) at_place.push_back(start->point);
      for (; !coming_.empty() && coming_.top().place == place; coming_.pop())
        at_place.push_back(coming_.top().point);
      visit(at_place);
    }
    return !met_;
  }

  /// After a run without contacts: the nesting of each loop.
  std::vector<LoopNesting> nestings() const;

 private:
  static constexpr std::int32_t none = -1;

  /// A segment in the order along the line. At its end the following one takes its place.
  struct Crossed {
    mutable std::int32_t segment;
  };
  struct Below {
    Sweep* sweep;
    bool operator()(Crossed s, Crossed t) const { return sweep->is_below(s.segment, t.segment); }
  };
  using Status = std::set<Crossed, Below>;

  /// The line reaches a point.
  struct Event {
    Point place;
    std::int32_t point;
    friend bool operator>(const Event& a, const Event& b) { return a.place > b.place; }
  };

  /// The points with both neighbours to their right, from left to right. All other points are reached along a
  /// segment that the line crosses, so that no more events are queued than segments are crossed at a time.
  std::vector<Event> local_starts() const {
    std::vector<Event> starts;
    const auto size = size32(flat_.points);
    for (std::int32_t v = 0; v < size; ++v) {
      const Point p = flat_.point(v);
      if (p < flat_.point(flat_.next(v)) && p < flat_.point(flat_.previous(v))) starts.push_back({p, v});
    }
    std::sort(starts.begin(), starts.end(), [](const Event& a, const Event& b) { return b > a; });
    return starts;
  }

  Point left(std::int32_t s) const { return std::min(flat_.point(s), flat_.point(flat_.next(s))); }
  Point right(std::int32_t s) const { return std::max(flat_.point(s), flat_.point(flat_.next(s))); }

  /// Order of two segments that the line crosses at the same time. Notes whether they touch.
  bool is_below(std::int32_t s, std::int32_t t) {
    if (s == t) return false;
    const Point s_left = left(s), t_left = left(t);
    if (s_left < t_left) return side(s, s_left, t_left) > 0;
    if (t_left < s_left) return side(t, t_left, s_left) < 0;
    return side(s, s_left, right(t)) > 0;  // neighbours with the same first point
  }
  int side(std::int32_t s, Point s_left, Point p) {
    const int turn = orientation(s_left, right(s), p);
    if (turn == 0) met_ = true;
    return turn;
  }

  /// Number of segments that end at a point.
  int ends_at(std::int32_t v) const {
    return (flat_.point(flat_.previous(v)) < flat_.point(v) ? 1 : 0) +
           (flat_.point(flat_.next(v)) < flat_.point(v) ? 1 : 0);
  }
  std::int32_t lower_at(std::int32_t v) {
    const std::int32_t before = flat_.previous(v);
    return is_below(before, v) ? before : v;
  }

  /// Handles the points at one place, usually one: removes all ending segments before adding new ones. For
  /// loops that begin there the segment below is noted.
  void visit(std::vector<std::int32_t>& points) {
    std::ranges::stable_sort(points, std::greater<>(), [&](std::int32_t v) { return ends_at(v); });
    for (const std::int32_t v : points) pass(v);
    std::erase_if(points, [&](std::int32_t v) { return ends_at(v) > 0 || begun_[flat_.loop(v)] != 0; });
    if (points.size() > 1)
      std::ranges::sort(points,
                        [&](std::int32_t v, std::int32_t w) { return is_below(lower_at(v), lower_at(w)); });
    for (const std::int32_t v : points) note_below(v);
  }

  void pass(std::int32_t v) {
    const std::int32_t before = flat_.previous(v), after = v;  // a segment has the number of its first point
    const bool first_ends = flat_.point(before) < flat_.point(v),
               second_ends = flat_.point(flat_.next(v)) < flat_.point(v);
    if (first_ends && second_ends) {
      leave(before);
      leave(after);
    } else if (first_ends) {
      continue_in_time(before, after);
    } else if (second_ends) {
      continue_in_time(after, before);
    } else {
      enter(before);
      enter(after);
    }
  }

  void enter(std::int32_t s) { place(s, status_.insert({s}).first); }

  /// The neighbours were tested against `ended`, so the segment that continues from its end lies between them
  /// too.
  void continue_in_time(std::int32_t ended, std::int32_t s) {
    const auto at = status_at_[ended];
    at->segment = s;
    place(s, at);
  }

  void place(std::int32_t s, Status::iterator at) {
    status_at_[s] = at;
    if (at != status_.begin()) check(std::prev(at)->segment, s);
    if (std::next(at) != status_.end()) check(s, std::next(at)->segment);
    expect_end(s);
  }

  /// Queues the end of a segment; where two segments end, the one directed to the right does this.
  void expect_end(std::int32_t s) {
    const std::int32_t next = flat_.next(s);
    if (flat_.point(s) < flat_.point(next)) {
      coming_.push({flat_.point(next), next});
    } else if (flat_.point(flat_.previous(s)) > flat_.point(s)) {
      coming_.push({flat_.point(s), s});
    }
  }

  void leave(std::int32_t s) {
    const auto after = status_.erase(status_at_[s]);
    if (after != status_.begin() && after != status_.end()) check(std::prev(after)->segment, after->segment);
  }

  void check(std::int32_t s, std::int32_t t) { met_ = met_ || flat_.faulty(s, t); }

  /// Notes the segment below the first point of a loop, whose two segments have just been added.
  void note_below(std::int32_t v) {
    begun_[flat_.loop(v)] = 1;
    first_points_.push_back(v);
    const auto lower = status_at_[lower_at(v)];
    if (lower != status_.begin()) below_[flat_.loop(v)] = std::prev(lower)->segment;
  }

  const FlatOutline& flat_;
  Status status_;
  std::vector<Status::iterator> status_at_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> coming_;  ///< events, the leftmost first
  std::vector<std::int32_t> below_;         ///< for each loop the segment below its first point
  std::vector<char> begun_;                 ///< for each loop
  std::vector<std::int32_t> first_points_;  ///< of the loops, from left to right
  bool met_ = false;
};

std::vector<LoopNesting> Sweep::nestings() const {
  std::vector<LoopNesting> nestings(flat_.loop_count());
  for (const std::int32_t v : first_points_) {
    LoopNesting& loop = nestings[flat_.loop(v)];
    loop.counter_clockwise =
        orientation(flat_.point(flat_.previous(v)), flat_.point(v), flat_.point(flat_.next(v))) > 0;
    const std::int32_t below = below_[flat_.loop(v)];
    if (below == none) continue;
    const LoopNesting& other =
        nestings[flat_.loop(below)];  // that loop was handled before, as its first point is further left
    const bool rightwards = flat_.point(below) < flat_.point(flat_.next(below));
    const bool within = rightwards == other.counter_clockwise;
    loop.depth = other.depth + (within ? 1 : 0);
    loop.parent = within ? static_cast<std::int32_t>(flat_.loop(below)) : other.parent;
  }
  return nestings;
}

std::string boundary_text(const Outline& outline, const FlatOutline& flat, std::int32_t s) {
  const std::int32_t loop_begin = flat.loop_starts[flat.loop(s)];
  const OutlineLoop& loop = outline.loops[flat.loop(s)];
  const Point a = flat.point(s), b = flat.point(flat.next(s));
  const BoundaryId boundary = loop.boundary[s - loop_begin];
  return fmt::format("'{}' between ({}, {}) and ({}, {})", outline.names[boundary.value()], a.x, a.y, b.x,
                     b.y);
}

/// Order of directions from a place, counter-clockwise from straight down.
bool turns_before(Point from, Point a, Point b) {
  const bool a_right = from < a, b_right = from < b;
  return a_right != b_right ? a_right : orientation(from, a, b) > 0;
}

/// Whether the geometry crosses itself at two of its points at one place: the neighbours of the two alternate
/// around the place.
bool cross_at_points(const FlatOutline& flat, std::int32_t v, std::int32_t w) {
  const Point from = flat.point(v);
  Point low = flat.point(flat.previous(v)), high = flat.point(flat.next(v));
  if (turns_before(from, high, low)) std::swap(low, high);
  const auto is_between = [&](Point p) { return turns_before(from, low, p) && turns_before(from, p, high); };
  return is_between(flat.point(flat.previous(w))) != is_between(flat.point(flat.next(w)));
}

/// Two points of different loops at one place in which the loops cross; -1 if there are none.
std::pair<std::int32_t, std::int32_t> crossing_points_of(const FlatOutline& flat) {
  std::vector<std::int32_t> order(flat.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::int32_t v) { return std::pair(flat.point(v), v); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && flat.point(order[end]) == flat.point(order[begin])) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        if (cross_at_points(flat, order[i], order[j])) return {order[i], order[j]};
      }
    }
  }
  return {-1, -1};
}

[[noreturn]] void refuse(const Outline& outline, const FlatOutline& flat, const std::string& remedy_of_two) {
  MeetingPairs pairs = meeting_pairs(flat);
  if (pairs.count == 0) {
    std::tie(pairs.first, pairs.second) = crossing_points_of(flat);
    if (pairs.first >= 0) pairs.count = 1;
  }
  QUADLOOP_REQUIRE(pairs.count > 0, "the sweep found segments that meet, the search did not");
  const Point at = flat.meeting_point(pairs.first, pairs.second);
  const std::int64_t more = pairs.count - 1;
  const std::string others =
      more == 0 ? ""
                : fmt::format(" ({}{} more pair{} of segments meet{})", pairs.complete ? "" : "at least ",
                              more, more == 1 ? "" : "s", more == 1 ? "s" : "");
  const std::string &source = outline.loops[flat.loop(pairs.first)].source,
                    &other_source = outline.loops[flat.loop(pairs.second)].source;
  const std::string place_of_other = source == other_source ? "" : fmt::format(" ({})", other_source);
  throw InputError(
      fmt::format("{}: boundary {} meets boundary {}{} at ({}, {}){}; boundaries must neither cross nor "
                  "touch: move or remove the points "
                  "there{}",
                  source, boundary_text(outline, flat, pairs.first),
                  boundary_text(outline, flat, pairs.second), place_of_other, at.x, at.y, others,
                  flat.loop(pairs.first) == flat.loop(pairs.second) ? "" : remedy_of_two));
}

}  // namespace

std::vector<LoopNesting> validate(const Outline& outline, const std::string& remedy_of_two) {
  const FlatOutline flat(outline);
  Sweep sweep(flat);
  if (!sweep.run() || (PointTable(flat.points).any_twice() && crossing_points_of(flat).first >= 0))
    refuse(outline, flat, remedy_of_two);
  return sweep.nestings();
}

}  // namespace quadloop
