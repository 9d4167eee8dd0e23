#include "mesher/layers/front/thickness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/front/front_tree.hpp"

namespace quadloop {

namespace {

constexpr double shrink = 0.85;
constexpr double clearance = 0.75;  // free length beyond a column's end, as a fraction of its length
constexpr double own_reach = 4;     // thicknesses of wall within which a column's own wall is no obstacle
constexpr int most_passes = 200, passes_alone = 12;

/// Stations, and segments of other boundaries, near a station along the boundary, from which its column needs
/// no distance.
class Vicinity {
 public:
  explicit Vicinity(const WallLine& line)
      : line_{line}, station_(line.size()), segment_(line.geometry().points().size()) {}

  void move_to(std::int32_t i, double reach) {
    ++stamp_;
    place(i);
    if (line_.previous(i) != WallLine::none) place(line_.previous(i));
    onwards(i, reach);
    backwards(i, reach);
  }
  /// Whether the wall between the station and the next one is in the vicinity.
  bool has_station(std::int32_t i) const { return station_[i] == stamp_; }
  bool has_segment(std::int32_t s) const {
    const std::int32_t twin = line_.geometry().twin(s);
    return segment_[s] == stamp_ || (twin >= 0 && segment_[twin] == stamp_);
  }

 private:
  void place(std::int32_t i) { station_[i] = stamp_; }

  void onwards(std::int32_t i, double reach) {
    double passed = 0;
    std::int32_t last = i;
    line_.walk_on(i, reach, [&](std::int32_t j, double distance) { place(j), last = j, passed = distance; });
    if (line_.next(last) == WallLine::none) beyond_end(last, reach - passed, true);
  }
  void backwards(std::int32_t i, double reach) {
    double passed = 0;
    std::int32_t first = i;
    line_.walk_back(i, reach, [&](std::int32_t j, double distance) {
      place(j), first = j, passed = distance;
      if (line_.previous(j) != WallLine::none) place(line_.previous(j));
    });
    if (line_.previous(first) == WallLine::none) beyond_end(first, reach - passed, false);
  }

  /// Goes on along the boundary on which the run ends, and on the other side of an inner line along the wall.
  void beyond_end(std::int32_t end, double reach, bool on) {
    const Geometry& g = line_.geometry();
    if (const std::int32_t across = line_.across(end); across != WallLine::none && !has_station(across)) {
      place(across);
      on ? onwards(across, reach) : backwards(across, reach);
    }
    std::int32_t s = line_[end].segment;
    for (double distance = 0; distance <= reach;) {
      s = on ? g.next(s) : g.previous(s);
      if (segment_[s] == stamp_) return;
      segment_[s] = stamp_;
      distance += length(g.point(g.next(s)) - g.point(s));
    }
  }

  const WallLine& line_;
  std::vector<std::int64_t> station_, segment_;
  std::int64_t stamp_ = 0;
};

class Fitting {
 public:
  Fitting(const WallLine& line, const StationPairs& partners, const Communicator* sharing)
      : line_{line},
        partners_{partners},
        sharing_{sharing},
        vicinity_{line},
        h_(line.size()),
        meets_(line.size()),
        columns_on_wall_{line, sharing} {
    for (std::int32_t i = 0; i < line_.size(); ++i) h_[i] = std::min(line_.asked(i), room_at(i));
    gather_walls();
  }

  FittingColumns found() && {
    guess();
    for (int pass = 0; pass < most_passes; ++pass) {
      limit_slopes();
      renew_columns();
      std::fill(meets_.begin(), meets_.end(), 0);
      own_ = share_of_moved();
      mark_meeting();
      mark_unproved();
      share_marks();
      if (pass >= passes_alone) spread_flags();
      if (!any_marked()) return {std::move(h_), std::move(columns_), std::move(front_)};
      for (std::int32_t i = 0; i < line_.size(); ++i) {
        if (meets_[i]) h_[i] *= shrink;
      }
    }
    refuse();
  }

 private:
  /// The available length of a run's last column on the boundary on which the run ends.
  double room_at(std::int32_t i) const {
    const Station& end = line_[i];
    if (end.shape != Station::Shape::end || end.at_wake) return std::numeric_limits<double>::infinity();
    return share_of_end * line_.end_path(i).length() * dot(end.direction, left_of(end.after));
  }

  /// Divides the stations among the ranks, in their order, such that sums of weights are nearly equal.
  template <class Weight>
  ItemRun share(const Weight& weight) const {
    if (sharing_ == nullptr) return {0, line_.size()};
    std::int64_t sum = 0;
    for (std::int32_t i = 0; i < line_.size(); ++i) sum += weight(i);
    ItemRun own{line_.size(), line_.size()};
    std::int64_t before = 0;
    const std::int64_t ranks = sharing_->size(), rank = sharing_->rank();
    for (std::int32_t i = 0; i < line_.size() && own.end == line_.size(); before += weight(i++)) {
      if (own.begin == line_.size() && before * ranks >= rank * sum) own.begin = i;
      if (before * ranks >= (rank + 1) * sum) own.end = i;
    }
    return own;
  }
  /// The work is at stations that have moved.
  ItemRun share_of_moved() const {
    constexpr int of_moved = 16;  // the work there, in that at others
    return share([&](std::int32_t i) { return moved_[i] ? of_moved : 1; });
  }
  /// Marks what other ranks have marked.
  void share_marks() {
    if (sharing_ == nullptr) return;
    std::vector<std::int32_t> marked;
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      if (meets_[i]) marked.push_back(i);
    }
    for (const std::int32_t i : sharing_->all_gather_values(std::span<const std::int32_t>(marked)))
      meets_[i] = 1;
  }

  /// Notes the stations whose fronts have moved; only these have to be checked again.
  void renew_columns() {
    columns_ = columns_on_wall_.fit(h_);
    for (const auto& [i, j] : partners_)
      columns_.length[i] = columns_.length[j] = std::min(columns_.length[i], columns_.length[j]);
    std::vector<Point> before = std::exchange(front_, {});
    before.resize(line_.size());
    moved_.clear();
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      front_.push_back(columns_.front(line_, i));
      moved_.push_back(front_[i] != before[i] ? 1 : 0);
    }
  }
  bool front_moved(std::int32_t i) const { return moved_[i] || moved_[line_.next(i)]; }

  Point wall(std::int32_t i) const { return line_[i].wall; }
  Point front(std::int32_t i) const { return front_[i]; }
  bool place_exists(std::int32_t i) const { return line_.goes_on(i); }
  /// Whether both have the same column.
  bool is_same_foot(std::int32_t i, std::int32_t j) const { return i == j || line_.across(i) == j; }

  /// Collects the wall segments at the stations, then the segments without layers.
  void gather_walls() {
    const Geometry& g = line_.geometry();
    std::vector<char> layered(g.points().size());
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      layered[line_[i].segment] = 1;
      const Point next = place_exists(i) ? wall(line_.next(i)) : wall(i);
      walls_.push_back({wall(i), next});
    }
    for (std::int32_t s = 0; s < g.size(); ++s) {
      if (layered[s]) continue;
      walls_.push_back({g.point(s), g.point(g.next(s))});
      other_segments_.push_back(s);
    }
    wall_tree_ = tree_of(walls_);
    std::vector<Segment> first_points;
    for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
      const Point p = g.point(g.loop_start(loop));
      first_points.push_back({p, p});
    }
    loop_tree_ = tree_of(first_points);
  }
  static BoxTree tree_of(const std::vector<Segment>& segments) {
    std::vector<Box> boxes;
    boxes.reserve(segments.size());
    for (const Segment& s : segments) boxes.push_back(box_of(s.from, s.to));
    return BoxTree(boxes);
  }
  /// Whether two segments of the geometry are of one block; layers do not meet walls and fronts of others.
  bool in_one_block(std::int32_t a, std::int32_t b) const {
    const Geometry& g = line_.geometry();
    return !g.has_blocks() || g.block_of(a) == g.block_of(b);
  }
  bool fronts_in_one_block(std::int32_t i, std::int32_t j) const {
    return in_one_block(line_[i].segment, line_[j].segment);
  }
  bool is_wall_of_block(std::int32_t i, std::int32_t wall) const {
    return in_one_block(line_[i].segment,
                        wall < line_.size() ? line_[wall].segment : other_segments_[wall - line_.size()]);
  }
  /// Whether a wall, given by its number in walls_, is in the vicinity of station i, to which it has been
  /// moved, or bounds another block, and so needs no distance.
  bool is_near(std::int32_t i, std::int32_t wall) const {
    if (!is_wall_of_block(i, wall)) return true;
    return wall < line_.size() ? vicinity_.has_station(wall) || !place_exists(wall)
                               : vicinity_.has_segment(other_segments_[wall - line_.size()]);
  }

  /// Initial guess from the distance to the next wall along each column.
  void guess() {
    limit_slopes();
    columns_ = columns_on_wall_.fit(h_);
    std::vector<double> guessed;
    own_ = share([](std::int32_t) { return 1; });
    for (std::int32_t i = own_.begin; i < own_.end; ++i) {
      vicinity_.move_to(i, own_reach * h_[i]);
      const double reach = columns_.length[i] / share_of_gap;
      const Point end = wall(i) + reach * columns_.direction[i];
      double nearest = 1;
      wall_tree_.for_each_meeting(box_of(wall(i), end), [&](std::int32_t w) {
        const Segment& s = walls_[w];
        if (is_near(i, w) || !segments_meet(wall(i), end, s.from, s.to)) return;
        // mean from both ends, so that the result does not depend on the direction of the wall
        const Point across = s.to - s.from;
        const double share = (cross(s.from - wall(i), across) + cross(s.to - wall(i), across)) /
                             (2 * cross(end - wall(i), across));
        if (share > 0 && share < nearest) nearest = share;
      });
      guessed.push_back(nearest * h_[i]);
    }
    h_ = sharing_ == nullptr ? std::move(guessed)
                             : sharing_->all_gather_values(std::span<const double>(guessed));
  }

  /// h(s) <= h(s') + 0.35 |s - s'|, and partners are as thick as each other.
  void limit_slopes() {
    quadloop::limit_slopes(line_, h_);
    while (equalise_partners()) quadloop::limit_slopes(line_, h_);
  }
  bool equalise_partners() {
    bool changed = false;
    for (const auto& [i, j] : partners_) {
      changed = changed || h_[i] != h_[j];
      h_[i] = h_[j] = std::min(h_[i], h_[j]);
    }
    return changed;
  }

  std::optional<Segment> front_after(std::int32_t i) const {
    if (!place_exists(i)) return {};
    return Segment{front(i), front(line_.next(i))};
  }

  void mark_meeting() {
    fronts_ = FrontTree(line_, [&](std::int32_t i) { return front_after(i); });
    const FrontTree of_moved(line_, [&](std::int32_t i) {
      return place_exists(i) && front_moved(i) ? front_after(i) : std::nullopt;
    });
    for (std::int32_t i = own_.begin; i < own_.end; ++i) {
      const Point end = front(i) + clearance * (front(i) - wall(i));
      const Box box = box_of(wall(i), end);
      if (!moved_[i] && !of_moved.any_meeting(box, [](std::int32_t) { return true; })) continue;
      vicinity_.move_to(i, own_reach * h_[i]);
      if (moved_[i]) mark_walls_met(i, end, box);
      const auto look_at = [&](std::int32_t j) {
        if (is_same_foot(i, j) || is_same_foot(i, line_.next(j)) || !fronts_in_one_block(i, j)) return;
        const Point top = vicinity_.has_station(j) ? front(i) : end;
        if (!segments_meet(wall(i), top, front(j), front(line_.next(j)))) return;
        meets_[i] = meets_[j] = meets_[line_.next(j)] = 1;
      };
      if (moved_[i])
        fronts_.for_each_meeting(box, look_at);
      else
        of_moved.for_each_meeting(box, look_at);
    }
  }

  void mark_walls_met(std::int32_t i, Point end, const Box& box) {
    wall_tree_.for_each_meeting(box, [&](std::int32_t w) {
      if (is_near(i, w) || !segments_meet(wall(i), end, walls_[w].from, walls_[w].to)) return;
      meets_[i] = 1;
      if (w < line_.size()) meets_[w] = meets_[line_.next(w)] = 1;
    });
  }

  /// Extends marks to all stations within a thickness along the wall.
  void spread_flags() {
    const std::vector<char> direct = meets_;
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      if (!direct[i]) continue;
      const auto take = [&](std::int32_t j, double) { meets_[j] = 1; };
      line_.walk_on(i, h_[i], take);
      line_.walk_back(i, h_[i], take);
    }
  }

  bool any_marked() const {
    return std::ranges::any_of(meets_, [](char m) { return m != 0; });
  }

  /// Flags places where the proof fails. If each strip between two columns has four left-turning
  /// corners, and no segment of a front meets another one or a boundary, no two columns meet: a map of a ring
  /// that is locally one-to-one, and one-to-one on its rims, is one-to-one.
  void mark_unproved() {
    for (std::int32_t i = own_.begin; i < own_.end; ++i) {
      if (!place_exists(i) || !front_moved(i) || (is_positive(i) && is_beside_ends(i))) continue;
      meets_[i] = meets_[line_.next(i)] = 1;
    }
    mark_crossing_fronts();
    mark_bodies_within();
  }

  /// Flags bodies between columns. A loop that touches no column and no front may still lie
  /// entirely between two columns; this is the case if one of its points does.
  void mark_bodies_within() {
    const Geometry& g = line_.geometry();
    for (std::int32_t i = own_.begin; i < own_.end; ++i) {
      if (!place_exists(i) || !front_moved(i)) continue;
      const std::int32_t j = line_.next(i);
      Box box = box_of(wall(i), front(i));
      box.include(wall(j));
      box.include(front(j));
      loop_tree_.for_each_meeting(box, [&](std::int32_t loop) {
        if (is_between_columns(i, g.point(g.loop_start(loop)))) meets_[i] = meets_[j] = 1;
      });
    }
  }

  /// Whether a point lies strictly between a station's column and the next one.
  bool is_between_columns(std::int32_t i, Point p) const {
    const std::int32_t j = line_.next(i);
    const Point a = wall(i), b = wall(j), c = front(j), d = front(i);
    const bool above_wall = a == b || orientation(a, b, p) > 0;
    return above_wall && orientation(b, c, p) > 0 && orientation(c, d, p) > 0 && orientation(d, a, p) > 0;
  }

  bool is_positive(std::int32_t i) const {
    const std::int32_t j = line_.next(i);
    const Point a = wall(i), b = wall(j), c = front(j), d = front(i);
    if (a == b) return orientation(a, c, d) > 0;
    return orientation(a, b, c) > 0 && orientation(b, c, d) > 0 && orientation(c, d, a) > 0 &&
           orientation(d, a, b) > 0;
  }

  bool is_beside_ends(std::int32_t i) const;
  void mark_crossing_fronts();
  bool ends_on(std::int32_t i, std::int32_t segment) const;
  bool fronts_meet(std::int32_t i, std::int32_t k) const;

  [[noreturn]] void refuse() const {
    const auto at = std::ranges::find(meets_, 1) - meets_.begin();
    const Station& station = line_[size32(std::vector<char>(at))];
    throw InputError(fmt::format(
        "boundary {} near ({:.6g}, {:.6g}): its layers meet others even if they are made very thin; use "
        "thinner layers, or make that part a separate boundary without layers",
        line_.geometry().boundary(line_.geometry().boundary_of(station.segment)).name, station.wall.x,
        station.wall.y));
  }

  const WallLine& line_;
  const StationPairs& partners_;
  const Communicator* sharing_;  ///< or null
  ItemRun own_;             ///< those that this rank looks at
  Vicinity vicinity_;
  std::vector<double> h_;
  std::vector<char> meets_, moved_;
  std::vector<Segment> walls_;  ///< one for each station, then those without layers
  std::vector<std::int32_t> other_segments_;
  BoxTree wall_tree_;
  BoxTree loop_tree_;  ///< of the first point of each loop
  ColumnsOnWall columns_on_wall_;
  FrontTree fronts_;
  WallColumns columns_;
  std::vector<Point> front_;
};

/// Whether the curve on which a run ends at one of two stations does not meet the column at the other one, as
/// far as the last column reaches.
bool Fitting::is_beside_ends(std::int32_t i) const {
  constexpr int samples = 8;
  const std::int32_t j = line_.next(i);
  for (const auto& [end, from, to] : {std::tuple(i, wall(j), front(j)), std::tuple(j, front(i), wall(i))}) {
    if (!line_.ends_on_curve(end)) continue;
    for (int k = 1; k < samples; ++k) {
      const double distance = columns_.length[end] * k / samples;
      if (orientation(from, to, line_.end_path(end).point_at(distance)) <= 0) return false;
    }
  }
  return true;
}

/// Whether the front at a station lies on a segment of a boundary without layers, on which the run ends, or
/// on its twin.
bool Fitting::ends_on(std::int32_t i, std::int32_t segment) const {
  if (line_[i].shape != Station::Shape::end) return false;
  if (line_[i].at_wake) return true;
  const std::int32_t twin = line_.geometry().twin(segment);
  return std::ranges::any_of(line_.end_path(i).pieces(), [&](const EndPath::Piece& piece) {
    return piece.segment == segment || piece.segment == twin;
  });
}

/// Tests fronts against each other and against boundaries without layers; a front that ends on one may touch
/// it. Pairs that have not moved did not meet before.
void Fitting::mark_crossing_fronts() {
  for (std::int32_t i = own_.begin; i < own_.end; ++i) {
    if (!place_exists(i) || !front_moved(i)) continue;
    const std::int32_t j = line_.next(i);
    const Box box = box_of(front(i), front(j));
    fronts_.for_each_meeting(box, [&](std::int32_t k) {
      if (k != i && fronts_in_one_block(i, k) && fronts_meet(i, k))
        meets_[i] = meets_[j] = meets_[k] = meets_[line_.next(k)] = 1;
    });
    wall_tree_.for_each_meeting(box, [&](std::int32_t w) {
      if (w < line_.size() || !is_wall_of_block(i, w) ||
          !segments_meet(front(i), front(j), walls_[w].from, walls_[w].to))
        return;
      const std::int32_t segment = other_segments_[w - line_.size()];
      if (!ends_on(i, segment) && !ends_on(j, segment)) meets_[i] = meets_[j] = 1;
    });
  }
}

/// Whether the front segments after two stations meet; neighbours outside their common point.
bool Fitting::fronts_meet(std::int32_t i, std::int32_t k) const {
  const std::int32_t j = line_.next(i), l = line_.next(k);
  if (is_same_foot(l, i))
    return on_segment(front(k), front(j), front(i)) || on_segment(front(j), front(k), front(i));
  if (is_same_foot(j, k))
    return on_segment(front(l), front(i), front(j)) || on_segment(front(i), front(l), front(j));
  return segments_meet(front(i), front(j), front(k), front(l));
}

}  // namespace

FittingColumns fit_thickness(const WallLine& line, const StationPairs& partners,
                             const Communicator* sharing) {
  return Fitting(line, partners, sharing).found();
}

}  // namespace quadloop
