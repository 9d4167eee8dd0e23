#include "adapt/morph/outline_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <span>

#include "mesher/base/error.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "smoother/outline/outline_match.hpp"

namespace quadloop::adapt {

namespace {

constexpr double least_corner = 10;   // degrees: a smaller turn does not correspond to a corner
constexpr double most_cut_off = 0.5;  // height of a corner over the edge of a mesh that cuts it off
constexpr double most_stretched = 2;  // maximum ratio of lengths, or its inverse, between vertices that stay

using NameSet = std::set<std::string>;

const std::string& name_of_segment(const Geometry& geometry, std::int32_t v) {
  return geometry.boundary(geometry.boundary_of(v)).name;
}

template <class Visit>
void for_each_vertex(const Geometry& geometry, std::int32_t loop, const Visit& visit) {
  for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) visit(v);
}

NameSet names_of(const Geometry& geometry, std::int32_t loop) {
  NameSet names;
  for_each_vertex(geometry, loop, [&](std::int32_t v) { names.insert(name_of_segment(geometry, v)); });
  return names;
}

std::string listed(const NameSet& names) { return fmt::format("'{}'", fmt::join(names, "' and '")); }

Point centre_of(const Geometry& geometry, std::int32_t loop) {
  Box box;
  for_each_vertex(geometry, loop, [&](std::int32_t v) { box.include(geometry.point(v)); });
  return box.centre();
}

double area_of(const Geometry& geometry, std::int32_t loop) {
  double twice = 0;
  const Point origin = geometry.point(geometry.loop_start(loop));
  for_each_vertex(geometry, loop, [&](std::int32_t v) {
    twice += cross(geometry.point(v) - origin, geometry.point(geometry.next(v)) - origin);
  });
  return twice / 2;
}

/// Returns the closest loop, by its centre, with the same boundaries, among the allowed ones; -1: none.
template <class MayTake>
std::int32_t counterpart(const Geometry& outline, std::int32_t loop, const Geometry& other,
                         const MayTake& may_take) {
  const NameSet names = names_of(outline, loop);
  std::int32_t nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t candidate = 0; candidate < other.loop_count(); ++candidate) {
    if (!may_take(candidate) || names_of(other, candidate) != names) continue;
    const double away = length(centre_of(other, candidate) - centre_of(outline, loop));
    if (away >= least) continue;
    least = away;
    nearest = candidate;
  }
  return nearest;
}

bool begins_boundary(const Geometry& geometry, std::int32_t v) {
  return geometry.boundary_of(v) != geometry.boundary_of(geometry.previous(v));
}

std::vector<std::int32_t> kept_vertices(const Geometry& geometry, std::int32_t loop) {
  std::vector<std::int32_t> kept;
  for_each_vertex(geometry, loop, [&](std::int32_t v) {
    if (geometry.kept(v)) kept.push_back(v);
  });
  return kept;
}

/// Returns at most `count` vertices, ascending: first those where boundaries begin, then those of the largest
/// turning angles.
std::vector<std::int32_t> sharpest_vertices(const Geometry& geometry, std::int32_t loop, std::size_t count) {
  std::vector<std::int32_t> found;
  for_each_vertex(geometry, loop, [&](std::int32_t v) {
    if (begins_boundary(geometry, v) || geometry.turn_degrees(v) >= least_corner) found.push_back(v);
  });
  const auto worth = [&](std::int32_t v) {
    return std::pair(begins_boundary(geometry, v), geometry.turn_degrees(v));
  };
  std::ranges::stable_sort(found, [&](std::int32_t a, std::int32_t b) { return worth(a) > worth(b); });
  found.resize(std::min(count, found.size()));
  std::ranges::sort(found);
  return found;
}

using Vertices = std::vector<std::int32_t>;

Vertices all_vertices(const Geometry& geometry, std::int32_t loop) {
  Vertices all;
  for_each_vertex(geometry, loop, [&](std::int32_t v) { all.push_back(v); });
  return all;
}

/// Returns the rotation of the vertex numbering of `to` that makes them correspond to those of `from`: the
/// sequence of names must agree, and the vertices be closest after the loops' centres are aligned. Empty if
/// the names never agree.
std::optional<std::size_t> turn_of(const Geometry& old_outline, const Vertices& from,
                                   const Geometry& new_outline, const Vertices& to, Point shift,
                                   std::span<const std::size_t> turns) {
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t turn : turns) {
    double sum = 0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const std::int32_t v = to[(k + turn) % to.size()];
      if (name_of_segment(old_outline, from[k]) != name_of_segment(new_outline, v))
        sum = std::numeric_limits<double>::infinity();
      const Point away = new_outline.point(v) - old_outline.point(from[k]) - shift;
      sum += dot(away, away);
    }
    if (sum >= least) continue;
    least = sum;
    best = turn;
  }
  return best;
}

/// Returns the rotations that map the first feature point of one loop to a feature point of another with the
/// same number of points; and 0.
std::vector<std::size_t> turns_of_kept(const Geometry& old_outline, const Vertices& from,
                                       const Geometry& new_outline, const Vertices& to) {
  std::vector<std::size_t> turns{0};
  const auto first = std::ranges::find_if(from, [&](std::int32_t v) { return old_outline.kept(v); });
  if (first == from.end()) return turns;
  const std::size_t at = first - from.begin();
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (new_outline.kept(to[k])) turns.push_back((k + to.size() - at) % to.size());
  }
  return turns;
}

/// Returns the arc length along a loop of its point closest to p.
double nearest_arc(const Geometry& geometry, const smoother::OutlinePath& path, std::int32_t loop, Point p) {
  double arc = 0, least = std::numeric_limits<double>::infinity();
  for_each_vertex(geometry, loop, [&](std::int32_t v) {
    const Point a = geometry.point(v), b = geometry.point(geometry.next(v));
    const PlaceOnSegment place = place_on_segment(p, a, b);
    if (place.squared_distance >= least) return;
    least = place.squared_distance;
    arc = path.arc_of(v) + place.parameter * length(b - a);
  });
  return arc;
}

}  // namespace

std::vector<char> loops_against(const Geometry& like, const Geometry& outline) {
  std::vector<char> against;
  for (std::int32_t loop = 0; loop < outline.loop_count(); ++loop) {
    const std::int32_t other = counterpart(outline, loop, like, [](std::int32_t) { return true; });
    against.push_back(other >= 0 && area_of(outline, loop) * area_of(like, other) < 0 ? 1 : 0);
  }
  return against;
}

Geometry walked_as(const Geometry& like, const Geometry& outline) {
  return smoother::with_loops_turned(outline, loops_against(like, outline));
}

OutlineMap::OutlineMap(const Geometry& from, const Geometry& to, bool by_points, const Names& names)
    : from_{from}, to_{to}, old_path_{from}, new_path_{to}, loops_(from.loop_count()) {
  match_loops(names);
  for (std::int32_t loop = 0; loop < from.loop_count(); ++loop) {
    if (!maps(loop)) continue;
    const std::int32_t image = loops_[loop].image;
    std::optional<LoopMap> map;
    if (by_points) map = point_by_point(loop, image);
    loops_[loop] = map ? *map : by_corners(loop, image, names);
  }
}

OutlineMap::OutlineMap(const Geometry& from, const Geometry& to)
    : from_{from}, to_{to}, old_path_{from}, new_path_{to} {
  for (std::int32_t loop = 0; loop < from.loop_count(); ++loop)
    loops_.push_back(anchored(loop, all_vertices(from, loop), all_vertices(to, loop), 0));
}

void OutlineMap::refuse_loop(std::int32_t image, const Names& names) const {
  const NameSet own = names_of(to_, image);
  for (std::int32_t loop = 0; loop < from_.loop_count(); ++loop) {
    const NameSet other = names_of(from_, loop);
    if (other == own || !std::ranges::includes(other, own)) continue;
    throw InputError(fmt::format(
        "{}: a loop of {} alone, but the loop of {} has {}, as that of a half model; give the whole loop, as "
        "`quadloop mesh --geometry-out` writes it",
        names.to, listed(own), names.from, listed(other)));
  }
  throw InputError(fmt::format("{}: has more loops of {} than {}; generate a new mesh", names.to, listed(own),
                               names.from));
}

void OutlineMap::match_loops(const Names& names) {
  for (std::int32_t image = 0; image < to_.loop_count(); ++image) {
    const std::int32_t nearest =
        counterpart(to_, image, from_, [&](std::int32_t loop) { return !maps(loop); });
    if (nearest < 0) refuse_loop(image, names);
    loops_[nearest].image = image;
  }
  for (std::int32_t loop = 0; loop < from_.loop_count(); ++loop) {
    if (maps(loop)) continue;
    const NameSet own = names_of(from_, loop);
    for (std::int32_t image = 0; image < to_.loop_count(); ++image) {
      const NameSet other = names_of(to_, image);
      if (std::ranges::none_of(own, [&](const auto& n) { return other.contains(n); })) continue;
      throw InputError(fmt::format(
          "{}: {} has a loop of {} near ({:g}, {:g}) that has no counterpart here; generate a new mesh",
          names.to, names.from, listed(own), centre_of(from_, loop).x, centre_of(from_, loop).y));
    }
  }
}

OutlineMap::LoopMap OutlineMap::anchored(std::int32_t image, const Vertices& corners,
                                         const Vertices& counterparts, std::size_t turn) const {
  LoopMap map{image, {}, {}, {}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    double arc = new_path_.arc_of(counterparts[(k + turn) % counterparts.size()]);
    if (k + turn >= counterparts.size()) arc += new_path_.loop_length(image);
    map.from.push_back(old_path_.arc_of(corners[k]));
    map.to.push_back(arc);
  }
  return map;
}

std::optional<OutlineMap::LoopMap> OutlineMap::point_by_point(std::int32_t loop, std::int32_t image) const {
  const Vertices own = all_vertices(from_, loop), other = all_vertices(to_, image);
  if (own.size() != other.size()) return {};
  const Point shift = centre_of(to_, image) - centre_of(from_, loop);
  const auto turn = turn_of(from_, own, to_, other, shift, turns_of_kept(from_, own, to_, other));
  if (!turn) return {};
  LoopMap map = anchored(image, own, other, *turn);
  for (std::size_t k = 0; k < own.size(); ++k) map.to_vertices.push_back(other[(k + *turn) % other.size()]);
  return map;
}

std::vector<OutlineMap::Anchor> OutlineMap::fixed_vertices(std::int32_t loop, std::int32_t image) const {
  std::vector<Anchor> standing;
  for_each_vertex(from_, loop, [&](std::int32_t v) {
    const smoother::OutlinePlace place = new_path_.locate(from_.point(v), name_of_segment(from_, v));
    if (place.loop == image) standing.push_back({old_path_.arc_of(v), place.arc});
  });
  return standing;
}

OutlineMap::LoopMap OutlineMap::with_fixed(std::int32_t loop, const LoopMap& map,
                                           std::vector<Anchor> standing) const {
  const double old_length = old_path_.loop_length(loop), new_length = new_path_.loop_length(map.image);
  for (Anchor& anchor : standing) {
    if (anchor.from < map.from.front()) anchor.from += old_length;
  }
  std::ranges::stable_sort(standing, {}, &Anchor::from);
  LoopMap denser{map.image, {}, {}, {}};
  const auto append = [&denser](const Anchor& anchor) {
    denser.from.push_back(anchor.from);
    denser.to.push_back(anchor.to);
  };
  auto next = standing.begin();
  for (std::size_t k = 0; k < map.from.size(); ++k) {
    const bool last = k + 1 == map.from.size();
    const Anchor begin{map.from[k], map.to[k]},
        end = last ? Anchor{map.from.front() + old_length, map.to.front() + new_length}
                   : Anchor{map.from[k + 1], map.to[k + 1]};
    append(begin);
    std::vector<Anchor> between;
    for (; next != standing.end() && next->from < end.from; ++next) {
      if (next->from <= begin.from) continue;
      while (next->to < begin.to) next->to += new_length;
      between.push_back(*next);
    }
    if (may_stay(begin, between, end)) std::ranges::for_each(between, append);
  }
  return denser;
}

bool OutlineMap::may_stay(Anchor begin, std::span<const Anchor> between, Anchor end) {
  const auto is_stretched = [&](const Anchor& after) {
    const double before = after.from - begin.from, now = after.to - begin.to;
    begin = after;
    return !(now <= most_stretched * before && before <= most_stretched * now);
  };
  return std::ranges::none_of(between, is_stretched) && !is_stretched(end);
}

std::optional<OutlineMap::LoopMap> OutlineMap::unchanged(std::int32_t loop, std::int32_t image,
                                                         const std::vector<Anchor>& standing) const {
  const std::size_t vertices = from_.loop_start(loop + 1) - from_.loop_start(loop);
  if (standing.size() != vertices) return {};
  const LoopMap map = with_fixed(loop, {image, {standing.front().from}, {standing.front().to}, {}}, standing);
  if (map.from.size() != vertices) return {};
  std::vector<double> arcs;
  for (const Anchor& anchor : standing) arcs.push_back(anchor.to);
  std::ranges::sort(arcs);
  const auto place = [&](double arc) { return new_path_.point_at(new_path_.place_at(image, arc)); };
  const auto is_shown = [&](std::int32_t corner) {
    const auto after = std::ranges::lower_bound(arcs, new_path_.arc_of(corner));
    const Point a = place(after == arcs.begin() ? arcs.back() : *(after - 1)),
                b = place(after == arcs.end() ? arcs.front() : *after);
    return distance_to_segment(to_.point(corner), a, b) <
           std::max(new_path_.tolerance(), most_cut_off * length(b - a));
  };
  if (!std::ranges::all_of(kept_vertices(to_, image), is_shown)) return {};
  return map;
}

OutlineMap::LoopMap OutlineMap::by_corners(std::int32_t loop, std::int32_t image, const Names& names) const {
  const std::vector<Anchor> standing = fixed_vertices(loop, image);
  if (auto map = unchanged(loop, image, standing)) return *map;
  const Vertices counterparts = kept_vertices(to_, image);
  const Vertices corners = sharpest_vertices(from_, loop, counterparts.size());
  const Point shift = centre_of(to_, image) - centre_of(from_, loop);
  if (counterparts.empty()) {
    if (!standing.empty()) {
      const Anchor& first = standing.front();
      const LoopMap map = with_fixed(loop, {image, {first.from}, {first.to}, {}}, standing);
      if (map.from.size() > 1) return map;
    }
    const Point first = from_.point(from_.loop_start(loop));
    return {image, {0}, {nearest_arc(to_, new_path_, image, first + shift)}, {}};
  }
  std::vector<std::size_t> turns(counterparts.size());
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  std::optional<std::size_t> turn;
  if (corners.size() == counterparts.size()) turn = turn_of(from_, corners, to_, counterparts, shift, turns);
  if (turn) return with_fixed(loop, anchored(image, corners, counterparts, *turn), standing);
  const Point centre = centre_of(to_, image);
  throw InputError(
      fmt::format("{}: the loop of {} round ({:g}, {:g}) has {} feature points and that of {} has {}, or "
                  "others between its boundaries; generate a new mesh",
                  names.to, listed(names_of(to_, image)), centre.x, centre.y, counterparts.size(), names.from,
                  corners.size()));
}

OutlineMap::Stretch OutlineMap::stretch_at(std::int32_t loop, double arc) const {
  const LoopMap& map = loops_[loop];
  const double old_length = old_path_.loop_length(loop);
  if (arc < map.from.front()) arc += old_length;
  const std::size_t k = std::ranges::upper_bound(map.from, arc) - map.from.begin() - 1;
  const double old_end = k + 1 == map.from.size() ? map.from.front() + old_length : map.from[k + 1];
  return {k, (arc - map.from[k]) / (old_end - map.from[k])};
}

std::optional<PointShares> OutlineMap::shares(std::int32_t loop, double arc) const {
  const std::vector<std::int32_t>& vertices = loops_[loop].to_vertices;
  if (vertices.empty()) return {};
  const auto [k, share] = stretch_at(loop, arc);
  return PointShares{vertices[k], vertices[(k + 1) % vertices.size()], share};
}

Point OutlineMap::image(std::int32_t loop, double arc) const {
  const LoopMap& map = loops_[loop];
  const double new_length = new_path_.loop_length(map.image);
  const auto [k, share] = stretch_at(loop, arc);
  const double new_end = k + 1 == map.from.size() ? map.to.front() + new_length : map.to[k + 1];
  double on_new = map.to[k] + share * (new_end - map.to[k]);
  if (on_new >= new_length) on_new -= new_length;
  return new_path_.point_at(new_path_.place_at(map.image, on_new));
}

}  // namespace quadloop::adapt
