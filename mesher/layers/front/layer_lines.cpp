#include "mesher/layers/front/layer_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

namespace {

Point direction_of_segment(const Geometry& g, std::int32_t s) {
  return direction_of(g.point(s), g.point(g.next(s)));
}

/// Prefix of messages: `case.toml:12: wake_2, from = "wing",`.
std::string said(const PlacedLine& line, const LayerLine& asked) {
  return fmt::format("{}{}, from = \"{}\"", line.place, line.name, fmt::join(asked.from, "\", \""));
}

/// The boundaries by name, with their segments in ascending order.
struct Walls {
  explicit Walls(const Geometry& g) : segments(g.boundaries().size()) {
    for (const BoundaryId b : segments.ids()) by_name.emplace(g.boundary(b).name, b);
    for (std::int32_t s = 0; s < g.size(); ++s) segments[g.boundary_of(s)].push_back(s);
  }
  std::map<std::string, BoundaryId> by_name;
  IdVector<BoundaryId, std::vector<std::int32_t>> segments;
};

/// The boundaries at which a wake begins.
class WakeWall {
 public:
  WakeWall(const Geometry& g, const Walls& walls, const LayerLine& line, const std::string& said) : g_{g} {
    for (const std::string& name : line.from) {
      const auto found = walls.by_name.find(name);
      if (found == walls.by_name.end()) refuse_unknown(name, said);
      const BoundaryId boundary = found->second;
      if (!line.without_layers && !g.boundary(boundary).layers)
        throw InputError(fmt::format(
            "{}: boundary '{}' has no layers that a wake could continue; add layers to it, or set layers = "
            "false for a wake that only requests cell sizes",
            said, name));
      if (has(boundary)) continue;
      boundaries_.push_back(boundary);
      segments_.insert(segments_.end(), walls.segments[boundary].begin(), walls.segments[boundary].end());
    }
    std::ranges::sort(segments_);
  }
  /// In ascending order.
  const std::vector<std::int32_t>& segments() const { return segments_; }
  const std::vector<BoundaryId>& boundaries() const { return boundaries_; }
  /// Whether a segment belongs to one of them.
  bool has(std::int32_t segment) const { return has(g_.boundary_of(segment)); }

 private:
  bool has(BoundaryId b) const { return std::ranges::find(boundaries_, b) != boundaries_.end(); }
  [[noreturn]] void refuse_unknown(const std::string& name, const std::string& said) const {
    std::vector<std::string> names;
    for (const Boundary& boundary : g_.boundaries()) names.push_back(boundary.name);
    throw InputError(fmt::format("{}: the geometry has no boundary '{}'; it has: {}{}", said, name,
                                 first_few(names), guess_for(name, names)));
  }

  const Geometry& g_;
  std::vector<BoundaryId> boundaries_;
  std::vector<std::int32_t> segments_;
};

/// The cosine of the angle by which the wall turns away from the domain; 1 if it does not.
double cosine_of_turn(const Geometry& g, std::int32_t before, std::int32_t after) {
  const Point a = direction_of_segment(g, before), b = direction_of_segment(g, after);
  return cross(a, b) < 0 ? dot(a, b) : 1;
}

/// First and last vertex of an edge, blunt or sharp.
using Edge = std::pair<std::int32_t, std::int32_t>;

/// The base that begins at a corner, if any.
std::optional<Edge> base_from(const Geometry& g, const WakeWall& wall, std::int32_t v, double longest) {
  constexpr double cosine_of_corner = 0.64278760968653933;  // 50 degrees
  if (cosine_of_turn(g, g.previous(v), v) > cosine_of_corner) return std::nullopt;
  double way = 0;
  for (std::int32_t s = v;; s = g.next(s)) {
    way += length(g.point(g.next(s)) - g.point(s));
    if (way > longest || g.boundary_of(s) != g.boundary_of(v)) return std::nullopt;
    const std::int32_t end = g.next(s);
    if (cosine_of_turn(g, s, end) > cosine_of_corner) continue;
    const bool turns_back =
        dot(direction_of_segment(g, g.previous(v)), direction_of_segment(g, end)) < cosine_of_sharp_edge;
    return turns_back && wall.has(end) ? std::optional(Edge{v, end}) : std::nullopt;
  }
}

/// A twentieth of the extent of the boundaries at which a wake begins: the largest length of a base and the
/// largest distance of `at` from its edge.
double reach_of_edges(const Geometry& g, const WakeWall& wall) {
  constexpr double reach_over_box = 0.05;
  double low = g.box().high.x, high = g.box().low.x, bottom = g.box().high.y, top = g.box().low.y;
  for (const std::int32_t v : wall.segments()) {
    low = std::min(low, g.point(v).x), high = std::max(high, g.point(v).x);
    bottom = std::min(bottom, g.point(v).y), top = std::max(top, g.point(v).y);
  }
  return reach_over_box * std::max(high - low, top - bottom);
}

/// Sharp edges first, then blunt ones whose corners are not sharp.
std::vector<Edge> edges_of(const Geometry& g, const WakeWall& wall, double longest_base) {
  const auto is_sharp = [&](std::int32_t v) {
    return wall.has(g.previous(v)) && cosine_of_turn(g, g.previous(v), v) < cosine_of_sharp_edge;
  };
  std::vector<Edge> edges, blunt;
  for (const std::int32_t v : wall.segments()) {
    if (!wall.has(g.previous(v))) continue;
    if (is_sharp(v)) edges.push_back({v, v});
    const auto base = base_from(g, wall, v, longest_base);
    if (base && !is_sharp(v) && !is_sharp(base->second)) blunt.push_back(*base);
  }
  edges.insert(edges.end(), blunt.begin(), blunt.end());
  return edges;
}

Point middle_of(const Geometry& g, const Edge& edge) {
  return edge.first == edge.second ? g.point(edge.first) : 0.5 * (g.point(edge.first) + g.point(edge.second));
}

/// Coordinates of the first few edges: "(1, 0), (0, 0) and 3 more".
std::string places_of(const Geometry& g, const std::vector<Edge>& edges) {
  std::vector<std::string> places;
  for (const Edge& edge : edges) {
    const Point p = middle_of(g, edge);
    places.push_back(fmt::format("({}, {})", p.x, p.y));
  }
  return first_few(places);
}

Edge edge_near(const Geometry& g, const std::vector<Edge>& edges, Point at, double reach,
               const std::string& said) {
  const auto distance = [&](const Edge& edge) {
    return std::sqrt(place_on_segment(at, g.point(edge.first), g.point(edge.second)).squared_distance);
  };
  const Edge nearest = *std::ranges::min_element(edges, {}, distance);
  if (distance(nearest) <= reach) return nearest;
  throw InputError(
      fmt::format("{}: at = [{}, {}] is {:.3g} from the nearest trailing edge, more than the {:.3g} allowed; "
                  "there are trailing edges at {}",
                  said, at.x, at.y, distance(nearest), reach, places_of(g, edges)));
}

/// Reports that there is no edge. At an end of the walls on a symmetry boundary the edge has only one half.
[[noreturn]] void refuse_without_edge(const Geometry& g, const WakeWall& wall, const std::string& said) {
  std::vector<Edge> ends;
  std::string symmetry;
  const auto look_at = [&](std::int32_t vertex, std::int32_t beyond) {
    const Boundary& boundary = g.boundary(g.boundary_of(beyond));
    if (wall.has(beyond) || boundary.condition != BoundaryCondition::symmetry) return;
    ends.push_back({vertex, vertex});
    symmetry = boundary.name;
  };
  for (const std::int32_t s : wall.segments()) {
    look_at(s, g.previous(s));
    look_at(g.next(s), g.next(s));
  }
  if (!ends.empty())
    throw InputError(
        fmt::format("{}: the wall ends at {} on the symmetry boundary '{}', where a wake would have only one "
                    "of its two sides, which is not supported; mesh the whole body (mesh.mirror without "
                    "mesh.half), or remove the wake",
                    said, places_of(g, ends), symmetry));
  throw InputError(
      fmt::format("{}: no trailing edge found: a sharp one turns by more than 120 degrees, a blunt one has "
                  "two corners of more than 50 degrees close together; if several boundaries meet there, "
                  "name them all: from = [\"a\", \"b\"]",
                  said));
}

Edge edge_of(const Geometry& g, const WakeWall& wall, const LayerLine& line, const std::string& said) {
  const double reach = reach_of_edges(g, wall);
  const std::vector<Edge> edges = edges_of(g, wall, reach);
  if (edges.empty()) refuse_without_edge(g, wall, said);
  if (line.at) return edge_near(g, edges, *line.at, reach, said);
  if (edges.size() == 1) return edges[0];
  throw InputError(fmt::format(
      "{}: there are {} trailing edges, at {}; select the one at which the wake begins: at = [x, y]", said,
      edges.size(), places_of(g, edges)));
}

/// A placed line with name and place only; `number`: its number among `all` of its kind, from 1.
PlacedLine named(const LayerLine& line, std::ptrdiff_t number, std::ptrdiff_t all) {
  PlacedLine placed;
  placed.name = line.from.empty() ? "layer_line" : "wake";
  if (all > 1) placed.name += fmt::format("_{}", number);
  if (!line.where.empty()) placed.place = line.where + ": ";
  placed.spacing = line.spacing;
  return placed;
}

/// The known course of a wake after its edge; empty without points or a streamline.
std::vector<Point> course_of(const LayerLine& line, Point edge,
                             const std::vector<std::vector<Point>>& streamlines) {
  if (!line.path.empty()) return {line.path.begin() + (line.path[0] == edge ? 1 : 0), line.path.end()};
  const auto distance = [&](const std::vector<Point>& path) { return length(path[0] - edge); };
  if (line.follows_flow && !streamlines.empty()) {
    const std::vector<Point>& nearest = *std::ranges::min_element(streamlines, {}, distance);
    if (distance(nearest) <= line.spacing) {
      std::vector<Point> course = beginning_of(nearest, line.length);
      const Point moved = edge - course[0];
      course.erase(course.begin());
      for (Point& p : course) p = p + moved;
      return course;
    }
  }
  return {};
}

void place_wake(const Geometry& g, const Walls& walls, const LayerLine& line,
                const std::vector<std::vector<Point>>& streamlines, PlacedLine& placed) {
  const WakeWall wall(g, walls, line, said(placed, line));
  const auto [first, last] = edge_of(g, wall, line, said(placed, line));
  std::vector<Point> path{middle_of(g, {first, last})};
  const Point on = unit(direction_of_segment(g, g.previous(first)) - direction_of_segment(g, last));
  const std::vector<Point> course = course_of(line, path[0], streamlines);
  placed.is_guess = line.follows_flow && course.empty();
  path.insert(path.end(), course.begin(), course.end());
  if (line.path.empty() && course.empty()) path.push_back(path[0] + line.length * on);
  if (line.follows_flow) placed.clear_of_all_but = wall.boundaries();
  if (path.size() > 1)
    placed.turn_degrees =
        std::acos(std::clamp(dot(on, direction_of(path[0], path[1])), -1.0, 1.0)) * (180 / std::numbers::pi);
  placed.edge = first;
  placed.base_end = last;
  placed.path = std::move(path);
  placed.layers = g.boundary(g.boundary_of(first)).layers.value_or(LayerSpec{});
  if (line.without_layers) return;
  const Boundary &before = g.boundary(g.boundary_of(g.previous(first))),
                 &after = g.boundary(g.boundary_of(last));
  if (before.layers->count != after.layers->count)
    throw InputError(fmt::format("{}: boundary {} has {} layers and {} has {}; give both the same count",
                                 said(placed, line), before.name, before.layers->count, after.name,
                                 after.layers->count));
}

[[noreturn]] void refuse_second(const PlacedLine& wake, const std::string& first) {
  throw InputError(fmt::format(
      "{}{} begins at the trailing edge at ({:.6g}, {:.6g}), and so does {}; a trailing edge has one "
      "wake: remove one of them",
      wake.place, wake.name, wake.path[0].x, wake.path[0].y, first));
}

}  // namespace

std::vector<Point> beginning_of(const std::vector<Point>& path, double length) {
  std::vector<Point> beginning{path[0]};
  for (std::size_t i = 1; i < path.size() && length > 0; ++i) {
    const Point step = path[i] - path[i - 1];
    const double far = quadloop::length(step);
    beginning.push_back(far <= length ? path[i] : path[i - 1] + (length / far) * step);
    length -= far;
  }
  return beginning;
}

double length_of(const std::vector<Point>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += length(path[i] - path[i - 1]);
  return sum;
}

std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines,
                                    const std::vector<std::vector<Point>>& streamlines) {
  const std::ptrdiff_t wakes = std::ranges::count_if(lines, [](const auto& l) { return !l.from.empty(); });
  std::optional<Walls> walls;
  if (wakes > 0) walls.emplace(geometry);
  std::vector<PlacedLine> all;
  std::map<std::int32_t, std::string> name_at;  // name of the wake that begins at a vertex
  std::ptrdiff_t placed_wakes = 0;
  for (const LayerLine& line : lines) {
    const bool is_wake = !line.from.empty();
    if (is_wake) ++placed_wakes;
    const std::ptrdiff_t before = std::ssize(all) - placed_wakes;
    PlacedLine placed =
        is_wake ? named(line, placed_wakes, wakes) : named(line, before + 1, std::ssize(lines) - wakes);
    if (is_wake) {
      place_wake(geometry, *walls, line, streamlines, placed);
      const auto [first, is_new] = name_at.emplace(placed.edge, placed.name);
      if (!is_new) refuse_second(placed, first->second);
    } else {
      placed.path = line.path;
      placed.layers = *line.layers;
      placed.across = line.across;
    }
    all.push_back(std::move(placed));
  }
  return all;
}

}  // namespace quadloop
