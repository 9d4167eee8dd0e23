#include "mesher/build/required_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesher/base/error.hpp"
#include "mesher/geometry/interior.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

namespace {

/// Distance of a point from the geometry and from other points in leaf edges. Then the leaf of the point, and
/// the grid vertices and edges that it may move, are free of geometry.
constexpr double leaves_between = 1.5;
/// Points as near to a boundary as this, relative to the extent, are meant to lie on it.
constexpr double on_boundary = 1e-9;

/// The nearest thing from which a point needs a distance.
struct Neighbour {
  double distance = std::numeric_limits<double>::infinity();
  std::int32_t segment = -1;
  std::int32_t point = -1;  ///< instead of a segment
};

/// Finds what is near required points.
class Surroundings {
 public:
  Surroundings(const Geometry& geometry, const std::vector<RequiredPoint>& points)
      : geometry_{geometry}, points_{points}, outline_{geometry}, inside_{outline_}, segments_{geometry} {
    for (std::int32_t v = 0; v < geometry.size(); ++v) {
      if (geometry.kept(v)) feature_points_.emplace(geometry.point(v), v);
    }
  }

  bool is_feature_point(Point p) const { return feature_points_.contains(p); }
  bool contains(Point p) const { return inside_.contains(p); }

  /// What is nearest to a point, within `reach` of it.
  Neighbour nearest_to(std::int32_t point, double reach) const {
    const Point p = points_[point].position;
    Neighbour nearest;
    for (std::int32_t other = 0; other < size32(points_); ++other) {
      const double distance = length(points_[other].position - p);
      if (other != point && distance < nearest.distance) nearest = {distance, -1, other};
    }
    segments_.for_each_meeting({{p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}}, [&](std::int32_t s) {
      const double distance = distance_to_segment(p, geometry_.point(s), geometry_.point(geometry_.next(s)));
      if (distance < nearest.distance) nearest = {distance, s, -1};
    });
    return nearest;
  }

  [[noreturn]] void refuse(std::int32_t point, const Neighbour& nearest, double finest) const {
    const RequiredPoint& required = points_[point];
    const std::string head = fmt::format("{}: {}", required.where, text_of(required));
    const double extent = geometry_.box().width() + geometry_.box().height();
    if (nearest.segment >= 0) {
      const std::string& name = geometry_.boundary(geometry_.boundary_of(nearest.segment)).name;
      if (nearest.distance <= on_boundary * extent)
        throw InputError(
            fmt::format("{} lies on boundary '{}', at none of its feature points; move it off the boundary, "
                        "or divide the "
                        "boundary there into two of different names",
                        head, name));
      refuse_near(head, fmt::format("boundary '{}'", name), nearest.distance, finest);
    }
    const RequiredPoint& other = points_[nearest.point];
    if (nearest.distance == 0)
      throw InputError(fmt::format("{} and point '{}' ({}) are the same; remove one of them", head,
                                   other.name, other.where));
    refuse_near(head, fmt::format("point '{}' ({})", other.name, other.where), nearest.distance, finest);
  }

 private:
  [[noreturn]] static void refuse_near(const std::string& head, const std::string& what, double distance,
                                       double finest) {
    throw InputError(fmt::format(
        "{} is {:.3g} away from {}, but must be at least {} smallest cells of size {:.3g} away; move it, or "
        "reduce spacing.min to {:.3g}",
        head, distance, what, leaves_between, finest, distance / (2 * leaves_between)));
  }

  const Geometry& geometry_;
  const std::vector<RequiredPoint>& points_;
  ShiftedOutline outline_;
  Interior inside_;
  SegmentTree segments_;
  std::map<Point, std::int32_t> feature_points_;
};

}  // namespace

std::string text_of(const RequiredPoint& point) {
  return fmt::format("point '{}' at ({:.6g}, {:.6g})", point.name, point.position.x, point.position.y);
}

MeshOptions with_room_for_points(const Geometry& geometry, const MeshOptions& options) {
  MeshOptions with_room = options;
  if (options.required_points.empty()) return with_room;
  const std::vector<RequiredPoint>& points = options.required_points;
  const Surroundings surroundings(geometry, points);
  const TreeGrid grid = choose_root(geometry, options.size);
  const int finest_level = grid.finest_level(options.size.min);
  with_room.required_points.clear();
  for (std::int32_t i = 0; i < size32(points); ++i) {
    const RequiredPoint& point = points[i];
    const Neighbour nearest = surroundings.nearest_to(i, leaves_between * options.size.max);
    const double room = nearest.distance / leaves_between;
    const bool is_twice = nearest.point >= 0 && nearest.distance == 0;
    const bool is_node = surroundings.is_feature_point(point.position) && !is_twice;
    if (is_node) continue;
    if (grid.is_larger(finest_level, room)) surroundings.refuse(i, nearest, grid.edge(finest_level));
    if (!surroundings.contains(point.position))
      throw InputError(fmt::format("{}: {} lies outside the domain; move it inside, or remove it",
                                   point.where, text_of(point)));
    with_room.required_points.push_back(point);
    if (room < options.size.max)
      with_room.size.sources.push_back({SizeSource::Line{point.position, point.position}, room, point.where});
  }
  return with_room;
}

std::vector<Point> positions_of(const std::vector<RequiredPoint>& points) {
  std::vector<Point> positions;
  for (const RequiredPoint& point : points) positions.push_back(point.position);
  return positions;
}

std::vector<RequiredPoint> points_outside_layers(const Geometry& whole, const Geometry& outer,
                                                 const std::vector<RequiredPoint>& points) {
  std::vector<RequiredPoint> outside;
  if (points.empty()) return outside;
  const Surroundings of_whole(whole, points), of_outer(outer, points);
  for (const RequiredPoint& point : points) {
    const Point p = point.position;
    if (of_whole.is_feature_point(p)) continue;
    outside.push_back(point);
    if (!of_whole.contains(p) || of_outer.contains(p)) continue;
    throw InputError(fmt::format(
        "{}: {} lies in boundary layers, whose nodes follow from the wall; move it out of them, or make the "
        "layers thinner",
        point.where, text_of(point)));
  }
  return outside;
}

std::vector<NamedNode> nodes_at(const Communicator& comm, const std::vector<RequiredPoint>& points,
                                const Mesh& mesh) {
  std::vector<NamedNode> nodes;
  if (points.empty()) return nodes;
  std::map<Point, std::int32_t> wanted;
  for (std::int32_t i = 0; i < size32(points); ++i) wanted.emplace(points[i].position, i);
  struct Found {
    std::int64_t node;
    std::int32_t point;
  };
  std::vector<Found> own;
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const auto at = wanted.find(mesh.points[node]);
    if (at != wanted.end()) own.push_back({mesh.first_node + node, at->second});
  }
  std::vector<std::int64_t> first(points.size(), -1);
  for (const Found& found : comm.all_gather_values(std::span<const Found>(own)))
    first[found.point] = first[found.point] < 0 ? found.node : std::min(first[found.point], found.node);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] < 0)
      throw InputError(
          fmt::format("{}: {} cannot be a node of the mesh with these cells; move it, or reduce "
                      "spacing.min",
                      points[i].where, text_of(points[i])));
    nodes.push_back({points[i].name, GlobalNodeId{first[i]}});
  }
  return nodes;
}

}  // namespace quadloop
