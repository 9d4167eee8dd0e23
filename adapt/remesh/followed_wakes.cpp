#include "adapt/remesh/followed_wakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/remesh/streamlines.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop::adapt {

namespace {

constexpr int steps_over_spacing = 4, steps_over_point = 2;

StreamlineStart start_of(const LayerLine& line, const PlacedLine& placed, const Geometry& geometry) {
  const double base = length(geometry.point(placed.edge) - geometry.point(placed.base_end));
  return {.edge = placed.path[0],
          .bisector = direction_of(placed.path[0], placed.path[1]),
          .offset = std::min(0.25 * line.length,
                             std::max({line.spacing, layers_thickness(placed.layers), 2 * base})),
          .step = line.spacing / steps_over_spacing,
          .length = line.length};
}

/// Every second point, and the last one, smoothed over a few of them.
std::vector<Point> course_along(const std::vector<Point>& points) {
  constexpr int passes = 4;
  std::vector<Point> course{points[0]};
  for (std::size_t i = 1; i + 1 < points.size(); i += steps_over_point) course.push_back(points[i]);
  course.push_back(points.back());
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<Point> before = course;
    for (std::size_t i = 1; i + 1 < course.size(); ++i)
      course[i] = 0.25 * (before[i - 1] + 2 * before[i] + before[i + 1]);
  }
  return course;
}

/// Empty if nothing is to be said.
std::string warning_of(const Streamline& line, const PlacedLine& placed, bool kept) {
  const Point at = line.points.back();
  if (kept)
    return fmt::format(
        "{}{} keeps its course, as the flow behind its trailing edge at ({:.6g}, {:.6g}) {}; converge the "
        "solution further, or give the wake a path = [[x, y], ...]",
        placed.place, placed.name, line.points[0].x, line.points[0].y,
        line.end == Streamline::End::outside
            ? "leaves the mesh at once"
            : "is at rest, reversed, or more than 60 degrees off the direction of the edge");
  if (line.end != Streamline::End::reversed) return {};
  return fmt::format(
      "{}{} ends at ({:.6g}, {:.6g}), as the flow is at rest or turns back there; reduce its length, or give "
      "it a path = [[x, y], ...]",
      placed.place, placed.name, at.x, at.y);
}

/// Whether a point of the first path is farther from the second one than a fifth of the column width.
bool deviates(const PlacedLine& line, const std::vector<Point>& path) {
  constexpr double share = 0.2, widening = 0.1;
  const double at_edge = layers_thickness(line.layers);
  double s = 0;
  for (std::size_t i = 1; i < line.path.size(); ++i) {
    s += length(line.path[i] - line.path[i - 1]);
    if (distance_to_polyline(line.path[i], path) > share * std::min(line.spacing, at_edge + widening * s))
      return true;
  }
  return false;
}

}  // namespace

FollowedWakes wakes_to_follow(const Communicator& comm, const MeshInput& input, const SolvedMesh& solved) {
  FollowedWakes followed;
  if (std::ranges::none_of(input.lines, &LayerLine::follows_flow)) return followed;
  const std::vector<PlacedLine> straight = place_lines(input.geometry, input.lines),
                                last = place_lines(input.geometry, input.lines, solved.tree.measured.wakes);
  const std::optional<Field> direction = flow_direction(comm, solved.mesh, solved.solution);
  if (!direction) {
    followed.paths = solved.tree.measured.wakes;
    followed.warnings.emplace_back(
        "wakes with path = \"flow\" keep their course, as the solution has no velocity; write x_velocity and "
        "y_velocity, or x_momentum and y_momentum");
    return followed;
  }
  std::vector<std::size_t> which;
  std::vector<StreamlineStart> starts;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    if (!input.lines[i].follows_flow) continue;
    which.push_back(i);
    starts.push_back(start_of(input.lines[i], straight[i], input.geometry));
  }
  const std::vector<Streamline> lines = streamlines(comm, solved.mesh, *direction, starts);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool kept = lines[k].points.size() < 3;  // the edge, the start and one more
    const std::string warning = warning_of(lines[k], straight[which[k]], kept);
    if (!warning.empty()) followed.warnings.push_back(warning);
    followed.paths.push_back(kept ? last[which[k]].path : course_along(lines[k].points));
  }
  if (input.mesh.mirror) agree_with_images(*input.mesh.mirror, followed.paths);
  return followed;
}

bool other_wakes(const MeshInput& input, const MeasuredFlow& before, const MeasuredFlow& now) {
  if (before.wakes == now.wakes) return false;
  const std::vector<PlacedLine> old_lines = place_lines(input.geometry, input.lines, before.wakes),
                                new_lines = place_lines(input.geometry, input.lines, now.wakes);
  for (std::size_t i = 0; i < new_lines.size(); ++i) {
    if (deviates(new_lines[i], old_lines[i].path) || deviates(old_lines[i], new_lines[i].path)) return true;
  }
  return false;
}

}  // namespace quadloop::adapt
