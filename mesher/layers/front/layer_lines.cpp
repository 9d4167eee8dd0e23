#include "mesher/layers/front/layer_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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

/// As messages name it: `case.toml:12: wake_2, from = "wing",`.
std::string said(const PlacedLine& line, const LayerLine& asked) {
  return fmt::format("{}{}, from = \"{}\"", line.place, line.name, fmt::join(asked.from, "\", \""));
}

/// Each boundary's, in ascending order.
using SegmentsOfBoundaries = IdVector<BoundaryId, std::vector<std::int32_t>>;

SegmentsOfBoundaries segments_of_boundaries(const Geometry& g) {
  SegmentsOfBoundaries segments(g.boundaries().size());
  for (std::int32_t s = 0; s < g.size(); ++s) segments[g.boundary_of(s)].push_back(s);
  return segments;
}

/// The boundaries that a wake begins at, as a flag for each of the geometry's.
class WakeWall {
 public:
  WakeWall(const Geometry& g, const SegmentsOfBoundaries& segments, const LayerLine& line,
           const std::string& said)
      : g_{g}, has_(g.boundaries().size(), 0) {
    for (const std::string& name : line.from) {
      const auto found = std::ranges::find(g.boundaries(), name, &Boundary::name);
      if (found == g.boundaries().end()) refuse_unknown(name, said);
      if (!found->layers)
        throw InputError(fmt::format("{}: boundary '{}' has no layers to go on; give it some", said, name));
      const BoundaryId boundary{static_cast<std::int32_t>(found - g.boundaries().begin())};
      if (std::exchange(has_[boundary], 1) != 0) continue;
      segments_.insert(segments_.end(), segments[boundary].begin(), segments[boundary].end());
    }
    std::ranges::sort(segments_);
  }
  /// In ascending order.
  const std::vector<std::int32_t>& segments() const { return segments_; }
  /// Whether a segment is of one of them.
  bool has(std::int32_t segment) const { return has_[g_.boundary_of(segment)] != 0; }

 private:
  [[noreturn]] void refuse_unknown(const std::string& name, const std::string& said) const {
    std::vector<std::string> names;
    for (const Boundary& boundary : g_.boundaries()) names.push_back(boundary.name);
    throw InputError(fmt::format("{}: the geometry has no boundary '{}'; it has: {}{}", said, name,
                                 first_few(names), guess_for(name, names)));
  }

  const Geometry& g_;
  IdVector<BoundaryId, char> has_;
  std::vector<std::int32_t> segments_;
};

/// By how much the wall turns away from the domain: the cosine; 1 where it does not.
double cosine_of_turn(const Geometry& g, std::int32_t before, std::int32_t after) {
  const Point a = direction_of_segment(g, before), b = direction_of_segment(g, after);
  return cross(a, b) < 0 ? dot(a, b) : 1;
}

/// The first and the last vertex of an edge, blunt or sharp.
using Edge = std::pair<std::int32_t, std::int32_t>;

/// The base that begins at a corner, if there is one.
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

/// A twentieth of the extent of the boundaries that a wake begins at: the longest base, and how far off `at`
/// may be.
double reach_of_edges(const Geometry& g, const WakeWall& wall) {
  constexpr double reach_over_box = 0.05;
  double low = g.box().high.x, high = g.box().low.x, bottom = g.box().high.y, top = g.box().low.y;
  for (const std::int32_t v : wall.segments()) {
    low = std::min(low, g.point(v).x), high = std::max(high, g.point(v).x);
    bottom = std::min(bottom, g.point(v).y), top = std::max(top, g.point(v).y);
  }
  return reach_over_box * std::max(high - low, top - bottom);
}

struct Edges {
  std::vector<Edge> sharp, blunt;
};

Edges edges_of(const Geometry& g, const WakeWall& wall, double longest_base) {
  Edges edges;
  for (const std::int32_t v : wall.segments()) {
    if (!wall.has(g.previous(v))) continue;
    if (cosine_of_turn(g, g.previous(v), v) < cosine_of_sharp_edge) edges.sharp.push_back({v, v});
    if (const auto base = base_from(g, wall, v, longest_base)) edges.blunt.push_back(*base);
  }
  return edges;
}

Point middle_of(const Geometry& g, const Edge& edge) {
  return edge.first == edge.second ? g.point(edge.first)
                                   : 0.5 * (g.point(edge.first) + g.point(edge.second));
}

/// The first few: "(1, 0), (0, 0) and 3 more".
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
  throw InputError(fmt::format(
      "{}: at = [{}, {}] lies {:.3g} from the nearest edge, and must not lie farther from it than {:.3g}; "
      "there are edges at {}",
      said, at.x, at.y, distance(nearest), reach, places_of(g, edges)));
}

Edge edge_of(const Geometry& g, const WakeWall& wall, const LayerLine& line, const std::string& said) {
  const double reach = reach_of_edges(g, wall);
  const auto [sharp, blunt] = edges_of(g, wall, reach);
  std::vector<Edge> edges = sharp;
  if (line.at || sharp.empty()) edges.insert(edges.end(), blunt.begin(), blunt.end());
  if (edges.empty())
    throw InputError(fmt::format(
        "{}: there is no edge, sharp (a turn of more than 120 degrees) or blunt (two of more than "
        "50 close together); where several boundaries meet at it, name them all: from = [\"a\", "
        "\"b\"]",
        said));
  if (line.at) return edge_near(g, edges, *line.at, reach, said);
  if (edges.size() == 1) return edges[0];
  throw InputError(
      fmt::format("{}: there are {} edges, at {}; name the one at which the wake begins: at = [x, y]", said,
                  edges.size(), places_of(g, edges)));
}

/// With its name and place alone.
PlacedLine named(const std::vector<LayerLine>& lines, std::size_t number) {
  const LayerLine& line = lines[number];
  const auto same_kind = [&](const LayerLine& other) { return other.from.empty() == line.from.empty(); };
  PlacedLine placed;
  placed.name = line.from.empty() ? "layer_line" : "wake";
  if (std::ranges::count_if(lines, same_kind) > 1)
    placed.name += fmt::format("_{}", 1 + std::count_if(lines.begin(), lines.begin() + number, same_kind));
  if (!line.where.empty()) placed.place = line.where + ": ";
  placed.spacing = line.spacing;
  return placed;
}

void place_wake(const Geometry& g, const SegmentsOfBoundaries& segments, const LayerLine& line,
                PlacedLine& placed) {
  const WakeWall wall(g, segments, line, said(placed, line));
  const auto [first, last] = edge_of(g, wall, line, said(placed, line));
  std::vector<Point> path{middle_of(g, {first, last})};
  const bool repeats_edge = !line.path.empty() && line.path[0] == path[0];
  path.insert(path.end(), line.path.begin() + (repeats_edge ? 1 : 0), line.path.end());
  if (line.path.empty()) {
    const Point on = unit(direction_of_segment(g, g.previous(first)) - direction_of_segment(g, last));
    path.push_back(path[0] + line.length * on);
  }
  placed.edge = first;
  placed.base_end = last;
  placed.path = std::move(path);
  placed.layers = *g.boundary(g.boundary_of(first)).layers;
  const Boundary &before = g.boundary(g.boundary_of(g.previous(first))),
                 &after = g.boundary(g.boundary_of(last));
  if (before.layers->count != after.layers->count)
    throw InputError(fmt::format("{}: boundary {} asks for {} layers and {} for {}; give them one count",
                                 said(placed, line), before.name, before.layers->count, after.name,
                                 after.layers->count));
}

void require_edge_of_its_own(const std::vector<PlacedLine>& before, const PlacedLine& wake) {
  const auto same = std::ranges::find(before, wake.edge, &PlacedLine::edge);
  if (wake.edge == PlacedLine::nowhere || same == before.end()) return;
  throw InputError(fmt::format(
      "{}{} begins at the edge at ({}, {}), and so does {}; an edge has one wake: leave one of them out",
      wake.place, wake.name, wake.path[0].x, wake.path[0].y, same->name));
}

}  // namespace

std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines) {
  std::vector<PlacedLine> all;
  const bool any_wake = std::ranges::any_of(lines, [](const LayerLine& l) { return !l.from.empty(); });
  const SegmentsOfBoundaries segments = any_wake ? segments_of_boundaries(geometry) : SegmentsOfBoundaries{};
  for (std::size_t number = 0; number < lines.size(); ++number) {
    const LayerLine& line = lines[number];
    PlacedLine placed = named(lines, number);
    if (line.from.empty()) {
      placed.path = line.path;
      placed.layers = *line.layers;
    } else {
      place_wake(geometry, segments, line, placed);
      require_edge_of_its_own(all, placed);
    }
    all.push_back(std::move(placed));
  }
  return all;
}

}  // namespace quadloop
