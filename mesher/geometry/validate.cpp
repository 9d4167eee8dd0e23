#include "mesher/geometry/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/geometry/meeting_pairs.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// Sweeps a line over the plane from left to right (points ordered by x, then y: it leans a little, so that
/// no segment is parallel to it) and keeps the segments that it crosses in their order along it (Shamos and
/// Hoey 1976). If two segments meet, two neighbours in that order do. The segment below a loop's first point
/// says what the loop lies in.
class Sweep {
 public:
  explicit Sweep(const FlatOutline& flat)
      : flat_{flat},
        status_{Below{this}},
        status_at_(flat.points.size()),
        below_(flat.loop_count(), none),
        begun_(flat.loop_count()) {}

  /// Whether no two segments meet. Stops at the first sign that some do.
  bool run() {
    const std::vector<Event> starts = local_starts();
    auto start = starts.begin();
    Point last{-std::numeric_limits<double>::infinity(), 0};
    while (!met_ && (start != starts.end() || !coming_.empty())) {
      const bool starts_first =
          coming_.empty() || (start != starts.end() && start->place < coming_.top().place);
      const Event event = starts_first ? *start++ : coming_.top();
      if (!starts_first) coming_.pop();
      if (event.place == last) return false;  // two points at one place
      last = event.place;
      visit(event.point);
    }
    return !met_;
  }

  /// After a run that found nothing: how each loop lies among the others.
  std::vector<LoopNesting> nestings() const;

 private:
  static constexpr std::int32_t none = -1;

  /// A segment in the order along the line. At its end the one that continues it takes its place.
  struct Crossed {
    mutable std::int32_t segment;
  };
  struct Below {
    Sweep* sweep;
    bool operator()(Crossed s, Crossed t) const { return sweep->is_below(s.segment, t.segment); }
  };
  using Status = std::set<Crossed, Below>;

  /// The line comes to a point.
  struct Event {
    Point place;
    std::int32_t point;
    friend bool operator>(const Event& a, const Event& b) { return a.place > b.place; }
  };

  /// The points with both neighbours to their right, from left to right. To all others the line is led by a
  /// segment that it crosses: so no more need to be sorted than it crosses at a time.
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

  /// Of two segments that the line crosses at once. Where they turn out to touch, notes it.
  bool is_below(std::int32_t s, std::int32_t t) {
    if (s == t) return false;
    const Point s_left = left(s), t_left = left(t);
    if (s_left < t_left) return side(s, s_left, t_left) > 0;
    if (t_left < s_left) return side(t, t_left, s_left) < 0;
    return side(s, s_left, right(t)) > 0;  // neighbours that begin at one point
  }
  int side(std::int32_t s, Point s_left, Point p) {
    const int turn = orientation(s_left, right(s), p);
    if (turn == 0) met_ = true;
    return turn;
  }

  void visit(std::int32_t v) {
    const std::int32_t before = flat_.previous(v), after = v;  // a segment has the number of its first point
    const bool first_ends = flat_.point(before) < flat_.point(v),
               second_ends = flat_.point(flat_.next(v)) < flat_.point(v);
    if (first_ends && second_ends) {
      leave(before);
      leave(after);
    } else if (first_ends) {
      carry_on(before, after);
    } else if (second_ends) {
      carry_on(after, before);
    } else {
      enter(before);
      enter(after);
      if (!begun_[flat_.loop(v)]) note_below(v, before, after);
    }
  }

  void enter(std::int32_t s) { place(s, status_.insert({s}).first); }

  /// Neighbours were found not to meet `ended`: so the segment that goes on from its end is between them too.
  void carry_on(std::int32_t ended, std::int32_t s) {
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

  /// Where two segments end, the one that is walked rightwards announces it.
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

  /// At the first point of a loop, where both of its segments were just entered.
  void note_below(std::int32_t v, std::int32_t s, std::int32_t t) {
    begun_[flat_.loop(v)] = 1;
    first_points_.push_back(v);
    const auto lower = status_at_[is_below(s, t) ? s : t];
    if (lower != status_.begin()) below_[flat_.loop(v)] = std::prev(lower)->segment;
  }

  const FlatOutline& flat_;
  Status status_;
  std::vector<Status::iterator> status_at_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> coming_;  ///< the leftmost first
  std::vector<std::int32_t> below_;         ///< by loop: the segment below its first point
  std::vector<char> begun_;                 ///< by loop
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
        nestings[flat_.loop(below)];  // begun before: its first point lies further left
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

[[noreturn]] void refuse(const Outline& outline, const FlatOutline& flat) {
  const MeetingPairs pairs = meeting_pairs(flat);
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
                  "there",
                  source, boundary_text(outline, flat, pairs.first),
                  boundary_text(outline, flat, pairs.second), place_of_other, at.x, at.y, others));
}

}  // namespace

std::vector<LoopNesting> validate(const Outline& outline) {
  const FlatOutline flat(outline);
  Sweep sweep(flat);
  if (!sweep.run()) refuse(outline, flat);
  return sweep.nestings();
}

}  // namespace quadloop
