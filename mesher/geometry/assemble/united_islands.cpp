#include "mesher/geometry/assemble/united_islands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/assemble/split_loops.hpp"
#include "mesher/geometry/assemble/winding_faces.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/geometry/validate.hpp"

namespace quadloop {

namespace {

[[noreturn]] void refuse_touched_curve(const OutlineLoop& loop, const std::string& name, Point p) {
  throw InputError(fmt::format(
      "{}: boundary '{}': another boundary touches its curve near ({}, {}) without a common point; "
      "geometry.overlap = \"union\" requires that they cross; move one of them, or set geometry.spline = "
      "false",
      loop.source, name, p.x, p.y));
}

using LoopGroup = std::vector<std::int32_t>;  ///< loops that meet, ascending

double longer_side_of(const Outline& outline) {
  Box box;
  for (const OutlineLoop& loop : outline.loops) {
    for (const Point p : loop.points) box.include(p);
  }
  return std::max(box.width(), box.height());
}

/// Twice the signed area or a multiple: only its sign and relative size are used.
double area_of(const std::vector<Point>& points) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    sum += cross(points[i] - points[0], points[i + 1] - points[0]);
  return 0.5 * sum;
}

std::int32_t root_of(std::vector<std::int32_t>& parents, std::int32_t l) {
  while (parents[l] != l) l = parents[l] = parents[parents[l]];
  return l;
}

/// Groups of loops that have a point in common, directly or through others, in the order of their first
/// loops.
std::vector<LoopGroup> groups_of(const std::vector<SplitLoop>& loops) {
  std::vector<std::int32_t> parents(loops.size());
  std::iota(parents.begin(), parents.end(), 0);
  std::map<Point, std::int32_t> first_at;
  for (std::int32_t l = 0; l < size32(loops); ++l) {
    for (const Point p : loops[l].points) {
      const auto [found, is_new] = first_at.try_emplace(p, l);
      if (is_new) continue;
      const std::int32_t one = root_of(parents, found->second), other = root_of(parents, l);
      parents[std::max(one, other)] = std::min(one, other);
    }
  }
  std::map<std::int32_t, LoopGroup> by_root;
  for (std::int32_t l = 0; l < size32(loops); ++l) by_root[root_of(parents, l)].push_back(l);
  std::vector<LoopGroup> groups;
  for (auto& [root, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

Box box_of_loop(const SplitLoop& loop) {
  Box box;
  for (const Point p : loop.points) box.include(p);
  return box;
}

/// One loop, for queries by point in logarithmic time.
class SearchedLoop {
 public:
  explicit SearchedLoop(const SplitLoop& loop)
      : points_{loop.points}, sorted_{loop.points}, tree_(size32(loop.points), [&](std::int32_t e) {
          return box_of(points_[e], after(e));
        }) {
    std::ranges::sort(sorted_);
  }

  bool has_point(Point p) const { return std::ranges::binary_search(sorted_, p); }

  /// For a point that is not on the loop: an exact count of the edges that a ray to the left crosses.
  bool encloses(Point p) const {
    bool odd = false;
    tree_.for_each_meeting({{-std::numeric_limits<double>::infinity(), p.y}, p}, [&](std::int32_t e) {
      const Point a = points_[e], b = after(e);
      if ((a.y > p.y) == (b.y > p.y) || orientation(std::min(a, b, lower), std::max(a, b, lower), p) > 0)
        return;
      odd = !odd;
    });
    return odd;
  }

 private:
  static bool lower(Point a, Point b) { return a.y < b.y; }
  Point after(std::int32_t e) const { return points_[e + 1 < size32(points_) ? e + 1 : 0]; }

  const std::vector<Point>& points_;
  std::vector<Point> sorted_;
  BoxTree tree_;
};

/// Finds the loops around points and around other loops.
class LoopsAround {
 public:
  explicit LoopsAround(const std::vector<SplitLoop>& loops)
      : loops_{loops}, tree_(size32(loops), [&](std::int32_t l) { return box_of_loop(loops[l]); }) {
    searched_.reserve(loops.size());
    for (const SplitLoop& loop : loops) searched_.emplace_back(loop);
  }

  /// The loops that enclose a point which is on none of them, ascending.
  std::vector<std::int32_t> of(Point p) const {
    std::vector<std::int32_t> around;
    tree_.for_each_meeting({p, p}, [&](std::int32_t l) {
      if (searched_[l].encloses(p)) around.push_back(l);
    });
    std::ranges::sort(around);
    return around;
  }

  /// The loops that satisfy `may_be(l)` and of which all points of the inner loop lie inside that are not
  /// common to both; ascending.
  template <class MayBe>
  std::vector<std::int32_t> of_loop(std::int32_t inner, const MayBe& may_be) const {
    std::vector<std::int32_t> around;
    tree_.for_each_meeting(box_of_loop(loops_[inner]), [&](std::int32_t l) {
      if (l != inner && may_be(l) && is_inside(loops_[inner], searched_[l])) around.push_back(l);
    });
    std::ranges::sort(around);
    return around;
  }

 private:
  static bool is_inside(const SplitLoop& inner, const SearchedLoop& loop) {
    bool any = false;
    for (const Point p : inner.points) {
      if (loop.has_point(p)) continue;
      if (!loop.encloses(p)) return false;
      any = true;
    }
    return any;
  }

  const std::vector<SplitLoop>& loops_;
  BoxTree tree_;
  std::vector<SearchedLoop> searched_;
};

/// Counts for the user.
struct UnionCounts {
  std::int64_t joined = 0, made = 0, dropped = 0;
  std::string first_joined, first_dropped;
};

class IslandUnion {
 public:
  IslandUnion(const Outline& outline, double near)
      : outline_{outline},
        loops_{split_loops(outline, near)},
        groups_{groups_of(loops_)},
        around_{loops_},
        areas_(loops_.size()),
        sign_(loops_.size(), 0),
        group_of_(loops_.size()),
        outer_(groups_.size()) {
    for (std::size_t l = 0; l < loops_.size(); ++l) areas_[l] = area_of(loops_[l].points);
    for (std::int32_t g = 0; g < size32(groups_); ++g) {
      for (const std::int32_t l : groups_[g]) group_of_[l] = g;
    }
    for (std::int32_t g = 0; g < size32(groups_); ++g) {
      outer_[g] = around_.of(loops_[groups_[g].front()].points.front());
      std::erase_if(outer_[g], [&](std::int32_t l) { return group_of_[l] == g; });
      const std::int32_t largest = largest_of(groups_[g]);
      for (const std::int32_t l : groups_[g]) sign_[l] = sign_of(l, g, largest);
    }
  }

  Outline run(UnionCounts& counts) const {
    Outline united{outline_.names, {}};
    for (std::int32_t g = 0; g < size32(groups_); ++g) {
      const LoopGroup& group = groups_[g];
      const std::size_t before = united.loops.size();
      if (group.size() > 1)
        add_union(g, united.loops);
      else if (const int outside = outside_of(g); (outside > 0) != (outside + sign_[group[0]] > 0))
        united.loops.push_back(outline_.loops[group[0]]);
      count(group, united.loops.size() - before, counts);
    }
    return united;
  }

 private:
  const std::string& source(std::int32_t l) const { return outline_.loops[l].source; }
  std::string text_of(std::int32_t l) const {
    const OutlineLoop& loop = outline_.loops[l];
    return fmt::format("boundary '{}' at ({}, {})", outline_.names[loop.boundary.front().value()],
                       loop.points.front().x, loop.points.front().y);
  }

  /// Whether this loop may be a hole in the other: its file specifies its direction, or both belong to one
  /// feature.
  bool may_be_hole_in(std::int32_t l, std::int32_t other) const {
    return outline_.loops[l].directed || source(l) == source(other);
  }

  std::int32_t largest_of(const LoopGroup& group) const {
    return *std::ranges::max_element(group, {}, [&](std::int32_t l) { return std::abs(areas_[l]); });
  }

  /// +1 for a loop with domain inside, -1 for an island. Among loops that meet and are not enclosed the
  /// largest one is an outer boundary, and others whose specified direction says so.
  int sign_of(std::int32_t l, std::int32_t g, std::int32_t largest) const {
    const std::vector<std::int32_t>& outer = outer_[g];
    std::vector<std::int32_t> around = around_.of_loop(
        l, [&](std::int32_t other) { return group_of_[other] == g && may_be_hole_in(l, other); });
    if (outer.empty() && around.empty())
      return l == largest || (outline_.loops[l].directed && areas_[l] > 0) ? 1 : -1;
    if ((outer.size() + around.size()) % 2 == 1) return -1;
    around.insert(around.end(), outer.begin(), outer.end());
    const bool is_hole =
        outline_.loops[l].directed
            ? areas_[l] > 0
            : std::ranges::any_of(around, [&](std::int32_t other) { return source(other) == source(l); });
    return is_hole ? 1 : -1;
  }

  int outside_of(std::int32_t g) const {
    int sum = 0;
    for (const std::int32_t l : outer_[g]) sum += sign_[l];
    return std::min(sum, 1);
  }

  void add_union(std::int32_t g, std::vector<OutlineLoop>& united) const {
    struct Origin {
      std::int32_t loop, segment;
    };
    std::vector<WindingEdge> edges;
    std::vector<Origin> origins;
    for (const std::int32_t l : groups_[g]) {
      const SplitLoop& loop = loops_[l];
      const int weight = areas_[l] > 0 ? sign_[l] : -sign_[l];
      for (std::size_t i = 0; i < loop.points.size(); ++i) {
        if (origins.empty() || origins.back().loop != l || origins.back().segment != loop.segment[i])
          origins.push_back({l, loop.segment[i]});
        edges.push_back(
            {loop.points[i], loop.points[(i + 1) % loop.points.size()], weight, size32(origins) - 1});
      }
    }
    const std::vector<WindingLoop> all_found = outline_of_positive(edges, outside_of(g));
    std::map<Point, int> visits;
    for (const WindingLoop& found : all_found) {
      for (const Point p : found.points) ++visits[p];
    }
    for (const WindingLoop& found : all_found) {
      OutlineLoop loop;
      for (std::size_t i = 0; i < found.points.size(); ++i) {
        // Another loop split the segment here; the point stays where loops touch.
        if (i > 0 && found.origin[i] == found.origin[i - 1] && visits[found.points[i]] == 1) continue;
        const auto [l, segment] = origins[found.origin[i]];
        loop.points.push_back(found.points[i]);
        loop.boundary.push_back(outline_.loops[l].boundary[segment]);
        loop.curves.push_back(
            curve_of(l, segment, found.points[i], found.points[(i + 1) % found.points.size()]));
      }
      if (std::ranges::all_of(loop.curves, &Curve::straight)) loop.curves.clear();
      loop.source = source(origins[found.origin.front()].loop);
      united.push_back(std::move(loop));
    }
  }

  /// The shape of a piece of a segment; curves have been split where others cross them.
  Curve curve_of(std::int32_t l, std::int32_t segment, Point from, Point to) const {
    const OutlineLoop& loop = outline_.loops[l];
    if (loop.curves.empty() || loop.curves[segment].straight()) return {};
    const Point first = loop.points[segment], last = loop.points[(segment + 1) % loop.points.size()];
    if (from == first && to == last) return loop.curves[segment];
    if (from == last && to == first) return reversed(loop.curves[segment]);
    refuse_touched_curve(loop, outline_.names[loop.boundary[segment].value()], from);
  }

  void count(const LoopGroup& group, std::size_t made, UnionCounts& counts) const {
    if (made == 0) {
      if (counts.dropped == 0) counts.first_dropped = text_of(group.front());
      counts.dropped += std::ssize(group);
    } else if (group.size() > 1) {
      if (counts.joined == 0) counts.first_joined = text_of(group[0]) + " and " + text_of(group[1]);
      counts.joined += std::ssize(group);
      counts.made += static_cast<std::int64_t>(made);
    }
  }

  const Outline& outline_;
  std::vector<SplitLoop> loops_;
  std::vector<LoopGroup> groups_;
  LoopsAround around_;
  std::vector<double> areas_;
  std::vector<int> sign_;
  std::vector<std::int32_t> group_of_;            ///< for each loop
  std::vector<std::vector<std::int32_t>> outer_;  ///< for each group the loops of other groups around it
};

void require_simple_loops(const Outline& outline) {
  for (const OutlineLoop& loop : outline.loops) validate({outline.names, {loop}});
}

void warn_of_names_lost(const Outline& before, const Outline& after, std::vector<std::string>& warnings) {
  std::set<BoundaryId> left;
  for (const OutlineLoop& loop : after.loops) left.insert(loop.boundary.begin(), loop.boundary.end());
  for (std::int32_t b = 0; b < size32(before.names); ++b) {
    if (left.contains(BoundaryId{b})) continue;
    warnings.push_back(
        fmt::format("geometry.overlap: boundary '{}' has no edge left: it lies inside the union of others",
                    before.names[b]));
  }
}

}  // namespace

Outline united_islands(const Outline& outline, double join, std::vector<std::string>& warnings) {
  require_simple_loops(outline);
  UnionCounts counts;
  Outline united = IslandUnion(outline, join * longer_side_of(outline)).run(counts);
  if (counts.joined > 0)
    warnings.push_back(
        fmt::format("geometry.overlap: {} loops that overlap or touch became {}, the first of them {}",
                    counts.joined, counts.made, counts.first_joined));
  if (counts.dropped > 0)
    warnings.push_back(fmt::format("geometry.overlap: {} loop{} inside islands dropped, the first {}",
                                   counts.dropped, counts.dropped == 1 ? " was" : "s were",
                                   counts.first_dropped));
  warn_of_names_lost(outline, united, warnings);
  return united;
}

}  // namespace quadloop
