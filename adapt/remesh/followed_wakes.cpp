#include "adapt/remesh/followed_wakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/remesh/streamlines.hpp"
#include "generate/outside_layers.hpp"
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

/// Whether a point of the first path is farther from the second one than a fifth of the column width; of a
/// wake without layers, than half the cell size at its edge.
bool deviates(const PlacedLine& line, bool without_layers, const std::vector<Point>& path) {
  constexpr double share = 0.2, widening = 0.1, share_of_cell = 0.5;
  const double at_edge = layers_thickness(line.layers);
  double s = 0;
  for (std::size_t i = 1; i < line.path.size(); ++i) {
    s += length(line.path[i] - line.path[i - 1]);
    const double allowed = without_layers ? share_of_cell * line.spacing
                                          : share * std::min(line.spacing, at_edge + widening * s);
    if (distance_to_polyline(line.path[i], path) > allowed) return true;
  }
  return false;
}

/// A wake that follows the flow: straight, and with its course in the last mesh.
struct LineToFollow {
  const LayerLine* line;
  PlacedLine straight, last;
};

/// Those with layers, and then those without.
std::vector<LineToFollow> lines_to_follow(const MeshInput& input, const MeasuredFlow& measured) {
  std::vector<LineToFollow> lines;
  for (const std::vector<LayerLine>* some : {&input.lines, &input.wakes_without_layers}) {
    const std::vector<PlacedLine> straight = place_lines(input.geometry, *some),
                                  last = place_lines(input.geometry, *some, measured.wakes);
    for (std::size_t i = 0; i < some->size(); ++i) {
      if ((*some)[i].follows_flow) lines.push_back({&(*some)[i], straight[i], last[i]});
    }
  }
  return lines;
}

}  // namespace

FollowedWakes wakes_to_follow(const Communicator& comm, const MeshInput& input, const SolvedMesh& solved) {
  FollowedWakes followed;
  if (!wants_streamlines(input)) return followed;
  const std::vector<LineToFollow> wakes = lines_to_follow(input, solved.tree.measured);
  const std::optional<Field> direction = flow_direction(comm, solved.mesh, solved.solution);
  if (!direction) {
    followed.paths = solved.tree.measured.wakes;
    followed.warnings.emplace_back(
        "wakes with path = \"flow\" keep their course, as the solution has no velocity; write x_velocity and "
        "y_velocity, or x_momentum and y_momentum");
    return followed;
  }
  std::vector<StreamlineStart> starts;
  for (const LineToFollow& wake : wakes)
    starts.push_back(start_of(*wake.line, wake.straight, input.geometry));
  const std::vector<Streamline> lines = streamlines(comm, solved.mesh, *direction, starts);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool kept = lines[k].points.size() < 3;  // the edge, the start and one more
    const std::string warning = warning_of(lines[k], wakes[k].straight, kept);
    if (!warning.empty()) followed.warnings.push_back(warning);
    if (kept && wakes[k].last.is_guess && wakes[k].line->without_layers) continue;
    followed.paths.push_back(kept ? wakes[k].last.path : course_along(lines[k].points));
  }
  if (input.mesh.mirror) agree_with_images(*input.mesh.mirror, followed.paths);
  return followed;
}

bool other_wakes(const MeshInput& input, const MeasuredFlow& before, const MeasuredFlow& now) {
  if (before.wakes == now.wakes) return false;
  const std::vector<LineToFollow> old_lines = lines_to_follow(input, before),
                                  new_lines = lines_to_follow(input, now);
  for (std::size_t i = 0; i < new_lines.size(); ++i) {
    const PlacedLine &old_line = old_lines[i].last, &new_line = new_lines[i].last;
    const bool without_layers = new_lines[i].line->without_layers;
    if (deviates(new_line, without_layers, old_line.path) ||
        deviates(old_line, without_layers, new_line.path))
      return true;
  }
  return false;
}

}  // namespace quadloop::adapt
