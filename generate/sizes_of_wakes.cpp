#include "generate/sizes_of_wakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/front/layer_lines.hpp"

namespace quadloop {

namespace {

/// A part of a wake's line with one spacing.
struct WakePart {
  double spacing = 0;
  std::vector<Point> points;
};

/// Divides a wake's line such that the spacing within a part varies by at most a quarter. `slope`: its change
/// per length.
std::vector<WakePart> parts_of(const std::vector<Point>& path, double spacing, double slope) {
  constexpr double ratio = 1.25;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const auto end_of_part = [&](double own) {
    return slope > 0 ? (ratio * own - spacing) / slope : unlimited;
  };
  std::vector<WakePart> parts{{spacing, {path[0]}}};
  double way = 0, end = end_of_part(spacing);
  for (std::size_t i = 1; i < path.size(); ++i) {
    double left = length(path[i] - path[i - 1]);
    for (; way + left > end; end = end_of_part(parts.back().spacing)) {
      const Point from = parts.back().points.back(), cut = from + ((end - way) / left) * (path[i] - from);
      parts.back().points.push_back(cut);
      parts.push_back({ratio * parts.back().spacing, {cut}});
      left -= end - way;
      way = end;
    }
    way += left;
    parts.back().points.push_back(path[i]);
  }
  return parts;
}

/// The polyline with as few of its points as keep the others within the tolerance, found from its beginning.
std::vector<Point> simplified(const std::vector<Point>& points, double tolerance) {
  std::vector<Point> kept{points[0]};
  std::size_t from = 0;
  const auto is_near = [&](std::size_t to) {
    return std::all_of(points.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                       points.begin() + static_cast<std::ptrdiff_t>(to), [&](Point p) {
                         return place_on_segment(p, points[from], points[to]).squared_distance <=
                                tolerance * tolerance;
                       });
  };
  for (std::size_t to = 2; to < points.size(); ++to) {
    if (is_near(to)) continue;
    from = to - 1;
    kept.push_back(points[from]);
  }
  kept.push_back(points.back());
  return kept;
}

/// The boundaries as obstacles of wakes.
class Obstacles {
 public:
  explicit Obstacles(const Geometry& geometry)
      : g_{geometry},
        tree_(geometry.size(), [&](std::int32_t s) { return box_of(g_.point(s), end_of(s)); }) {}

  /// The wake's line up to the first boundary that it meets, with its clearance from that boundary.
  PlacedLine ended(const PlacedLine& wake, double requested) const {
    constexpr double least_spacings = 2;
    double way = 0;
    for (std::size_t i = 1; i < wake.path.size(); ++i) {
      const Point from = wake.path[i - 1], to = wake.path[i];
      if (const auto [distance, segment] = first_meeting(wake, from, to, i == 1); segment != BoxTree::none) {
        const Boundary& boundary = g_.boundary(g_.boundary_of(segment));
        const double clearance =
            std::max(least_spacings * wake.spacing, boundary.layers ? layers_thickness(*boundary.layers) : 0);
        PlacedLine shorter = wake;
        const double left = std::max(way + distance - clearance, 0.0);
        shorter.path = beginning_of(wake.path, left);
        shorter.shortened = ShortenedWake{requested, left, "boundary " + boundary.name, shorter.path.back()};
        return shorter;
      }
      way += length(to - from);
    }
    return wake;
  }

 private:
  struct Meeting {
    double distance = std::numeric_limits<double>::infinity();
    std::int32_t segment = BoxTree::none;
  };

  Point end_of(std::int32_t s) const { return g_.point(g_.next(s)); }

  /// The first segment that a piece of the wake meets, and its distance from `from`. The walls at the edge do
  /// not count for the first piece.
  Meeting first_meeting(const PlacedLine& wake, Point from, Point to, bool at_edge) const {
    Meeting first;
    tree_.for_each_meeting(box_of(from, to), [&](std::int32_t s) {
      if (at_edge && is_at_edge(wake, s)) return;
      if (!segments_meet(from, to, g_.point(s), end_of(s))) return;
      const double distance = distance_to(s, from, to);
      if (distance < first.distance || (distance == first.distance && s < first.segment))
        first = {distance, s};
    });
    return first;
  }

  bool is_at_edge(const PlacedLine& wake, std::int32_t s) const {
    if (s == g_.previous(wake.edge) || s == wake.base_end) return true;
    for (std::int32_t v = wake.edge; v != wake.base_end; v = g_.next(v)) {
      if (v == s) return true;
    }
    return false;
  }

  /// The distance from `from` at which the line to `to` meets the segment, which it does.
  double distance_to(std::int32_t s, Point from, Point to) const {
    const Point along = to - from, side = end_of(s) - g_.point(s);
    const double across = cross(along, side);
    if (across == 0)
      return std::min(length(nearest_on_segment(g_.point(s), from, to) - from),
                      length(nearest_on_segment(end_of(s), from, to) - from));
    return std::clamp(cross(g_.point(s) - from, side) / across, 0.0, 1.0) * length(along);
  }

  const Geometry& g_;
  BoxTree tree_;
};

void add_sources(const PlacedLine& wake, const LayerLine& line, double requested,
                 std::vector<SizeSource>& sources) {
  constexpr double tolerance = 0.25;  // of the spacing
  if (wake.path.size() < 2) return;   // a boundary is too near
  constexpr double slope_of_guess = 0.05;
  const double slope =
      std::max((line.spacing_at_end - line.spacing) / requested, wake.is_guess ? slope_of_guess : 0.0);
  for (const WakePart& part : parts_of(wake.path, line.spacing, slope)) {
    const std::vector<Point> points = simplified(part.points, tolerance * part.spacing);
    for (std::size_t i = 1; i < points.size(); ++i)
      sources.push_back({SizeSource::Line{points[i - 1], points[i]}, part.spacing, line.where});
  }
}

}  // namespace

WakeSizes sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured) {
  WakeSizes sizes;
  const std::vector<LayerLine>& lines = input.wakes_without_layers;
  const std::vector<PlacedLine> placed = place_lines(input.geometry, lines, measured.wakes);
  const Obstacles obstacles(input.geometry);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double requested = lines[i].path.empty() ? lines[i].length : length_of(placed[i].path);
    const PlacedLine wake = obstacles.ended(placed[i], requested);
    if (wake.shortened)
      sizes.warnings.push_back(
          fmt::format("{}{} ends at ({:.6g}, {:.6g}), after {:.3g} of its length of {:.3g}, before {}; "
                      "reduce its length, "
                      "or give it a path = [[x, y], ...] that passes beside it",
                      wake.place, wake.name, wake.shortened->at.x, wake.shortened->at.y, wake.shortened->left,
                      requested, wake.shortened->before));
    if (lines[i].spacing < input.mesh.size.min)
      sizes.warnings.push_back(
          fmt::format("{}{} requests a spacing of {:.6g}, but spacing.min = {} is larger; set a smaller "
                      "spacing.min",
                      wake.place, wake.name, lines[i].spacing, input.mesh.size.min));
    add_sources(wake, lines[i], requested, sizes.sources);
  }
  return sizes;
}

std::optional<MeshInput> with_sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured,
                                             std::vector<std::string>& warnings) {
  if (input.wakes_without_layers.empty()) return std::nullopt;
  const WakeSizes sizes = sizes_of_wakes(input, measured);
  warnings.insert(warnings.end(), sizes.warnings.begin(), sizes.warnings.end());
  std::optional<MeshInput> sized(input);
  std::vector<SizeSource>& sources = sized->mesh.size.sources;
  sources.insert(sources.end(), sizes.sources.begin(), sizes.sources.end());
  return sized;
}

std::optional<MeshInput> with_sizes_of_wakes(const MeshInput& input, const MeasuredFlow& measured) {
  std::vector<std::string> warnings;
  return with_sizes_of_wakes(input, measured, warnings);
}

}  // namespace quadloop
