#include "mesher/build/near_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

namespace {

/// Distance below which triangles are thin, as a fraction of the edge of the mesh at the end.
constexpr double near_of_edge = 0.1;

/// The free ends of inner lines, with the length of the longest edge of the mesh at each. *Collective.*
std::map<Point, double> edges_at_ends(const Communicator& comm, const Geometry& geometry, const Mesh& mesh) {
  std::map<Point, double> edges;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (geometry.is_tip(v)) edges.emplace(geometry.point(v), 0);
  }
  struct EdgeAtEnd {
    Point end;
    double length = 0;
  };
  std::vector<EdgeAtEnd> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      const Point a = mesh.point(from), b = mesh.point(to);
      for (const Point end : {a, b}) {
        if (edges.contains(end)) own.push_back({end, length(b - a)});
      }
    }
  }
  for (const EdgeAtEnd& edge : comm.all_gather_values(std::span<const EdgeAtEnd>(own))) {
    double& longest = edges.at(edge.end);
    longest = std::max(longest, edge.length);
  }
  return edges;
}

/// The segments of a line from its end `tip` until it is farther away from there than `reach`, both ways.
std::set<std::int32_t> segments_at(const Geometry& geometry, std::int32_t tip, double reach) {
  std::set<std::int32_t> found;
  std::int32_t s = tip;
  do {
    found.insert({s, geometry.twin(s)});
    s = geometry.next(s);
  } while (geometry.is_inner_line(s) && !found.contains(s) &&
           length(geometry.point(s) - geometry.point(tip)) <= reach);
  return found;
}

/// An end of an inner line next to another segment.
struct NearEnd {
  std::int32_t tip = -1, segment = -1;
  double distance = 0;
};

/// The nearest segment within `reach` of an end that does not belong to the line there.
NearEnd nearest_to(const Geometry& geometry, const SegmentTree& segments, std::int32_t tip, double reach) {
  NearEnd nearest{tip, -1, reach};
  const Point p = geometry.point(tip);
  const std::set<std::int32_t> own = segments_at(geometry, tip, reach);
  segments.for_each_meeting({{p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}}, [&](std::int32_t s) {
    const Point a = geometry.point(s), b = geometry.point(geometry.next(s));
    if (own.contains(s) || a == p || b == p) return;
    const double distance = distance_to_segment(p, a, b);
    if (distance < nearest.distance) nearest = {tip, s, distance};
  });
  return nearest;
}

std::string text_of(const Geometry& geometry, const NearEnd& end, std::size_t count) {
  const auto boundary_of = [&](std::int32_t s) { return geometry.boundary(geometry.boundary_of(s)); };
  const Boundary other = boundary_of(end.segment);
  const Box box = geometry.box();
  const double extent = std::max(box.width(), box.height());
  const Point p = geometry.point(end.tip);
  const std::string remedy =
      other.layers ? "to the wall"
                   : fmt::format(
                         "exactly to the boundary, or set join = {:.2g} in [geometry], which moves "
                         "it there",
                         1.1 * end.distance / extent);
  return fmt::format(
      "inner line '{}': its end at ({:.6g}, {:.6g}) is only {:.3g} away from {}boundary '{}', so that "
      "triangles between them are thin{}; move it away, or {}",
      boundary_of(end.tip).name, p.x, p.y, end.distance, other.layers ? "the layers of " : "", other.name,
      count == 1 ? "" : fmt::format(" ({} such ends)", count), remedy);
}

}  // namespace

std::optional<std::string> warning_of_near_ends(const Communicator& comm, const Geometry& geometry,
                                                const Mesh& mesh) {
  if (!geometry.has_inner_lines()) return {};
  const std::map<Point, double> edges = edges_at_ends(comm, geometry, mesh);
  const SegmentTree segments(geometry);
  std::vector<NearEnd> ends;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (!geometry.is_tip(v)) continue;
    const NearEnd end = nearest_to(geometry, segments, v, near_of_edge * edges.at(geometry.point(v)));
    if (end.segment >= 0) ends.push_back(end);
  }
  if (ends.empty()) return {};
  return text_of(geometry, *std::ranges::min_element(ends, {}, &NearEnd::distance), ends.size());
}

}  // namespace quadloop
