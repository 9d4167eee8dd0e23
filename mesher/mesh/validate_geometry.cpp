#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/validate_rules.hpp"

namespace quadloop {

namespace {

namespace bg = boost::geometry;
using IndexPoint = bg::model::point<double, 2, bg::cs::cartesian>;
using IndexSegment = bg::model::segment<IndexPoint>;

constexpr double sharp_degrees = 30;
constexpr double largest_area_error = 0.05;

double distance_to_segment(Point p, Point a, Point b) {
  const Point edge = b - a;
  const double squared = dot(edge, edge);
  const double t = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return length(p - a - t * edge);
}

/// Segments that answer which of them is nearest.
class SegmentSet {
 public:
  void add(Point a, Point b) { segments_.emplace_back(a, b); }
  void build() {
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
      const auto& [a, b] = segments_[i];
      entries.emplace_back(IndexSegment{{a.x, a.y}, {b.x, b.y}}, i);
    }
    index_ = Index(entries);
  }
  /// Number of the nearest segment, and how far it is: infinitely, where there is none.
  std::pair<std::uint32_t, double> nearest(Point p) const {
    if (segments_.empty()) return {0, std::numeric_limits<double>::infinity()};
    const auto found = index_.qbegin(bg::index::nearest(IndexPoint(p.x, p.y), 1));
    const auto& [a, b] = segments_[found->second];
    return {found->second, distance_to_segment(p, a, b)};
  }

 private:
  using Entry = std::pair<IndexSegment, std::uint32_t>;
  using Index = bg::index::rtree<Entry, bg::index::quadratic<16>>;
  std::vector<std::pair<Point, Point>> segments_;
  Index index_;
};

/// All chains of one name.
struct NamedOutline {
  std::vector<Point> points;
  SegmentSet segments;
};

template <class Visit>
void for_each_segment(const Chain& chain, const Visit& visit) {
  const std::size_t count = chain.points.size();
  for (std::size_t i = 0; i + (chain.open ? 1 : 0) < count; ++i) visit(chain.points[i], chain.points[(i + 1) % count]);
}

std::map<std::string, NamedOutline> outlines_of(std::span<const Chain> geometry) {
  std::map<std::string, NamedOutline> outlines;
  for (const Chain& chain : geometry) {
    NamedOutline& outline = outlines[chain.name];
    for_each_segment(chain, [&](Point a, Point b) {
      outline.points.push_back(a);
      outline.segments.add(a, b);
    });
  }
  for (auto& [name, outline] : outlines) outline.segments.build();
  return outlines;
}

std::vector<Point> sharp_points(std::span<const Chain> geometry) {
  std::vector<Point> sharp;
  for (const Chain& chain : geometry) {
    const auto& p = chain.points;
    if (p.empty()) continue;
    if (chain.open) sharp.insert(sharp.end(), {p.front(), p.back()});
    for (std::size_t i = 0; i < p.size() && !chain.open; ++i) {
      const Point in = p[i] - p[(i + p.size() - 1) % p.size()], out = p[(i + 1) % p.size()] - p[i];
      const double turn = 180 - std::abs(corner_degrees(p[i] - in, p[i], p[i] + out));
      if (turn > sharp_degrees) sharp.push_back(p[i]);
    }
  }
  return sharp;
}

std::vector<double> longest_edge_of_cells(const Mesh& mesh) {
  std::vector<double> longest(mesh.triangles.size() + mesh.quads.size(), 0);
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    auto& value = longest[static_cast<std::size_t>(cell)];
    value = std::max(value, length(mesh.point(to) - mesh.point(from)));
  });
  return longest;
}

/// Compares the two, boundary by boundary.
class Comparison {
 public:
  Comparison(const Mesh& mesh, std::span<const Chain> geometry, double tolerance)
      : mesh_{mesh}, geometry_{geometry}, outlines_{outlines_of(geometry)}, table_{mesh}, longest_{longest_edge_of_cells(mesh)} {
    Box box;
    for (const Point p : mesh.points) box.include(p);
    centre_ = box.centre();
    tolerance_ = tolerance * std::max(box.width(), box.height());
  }

  GeometryFit run() {
    std::set<std::string> present;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (boundary.edges.empty()) continue;
      present.insert(boundary.name);
      const auto outline = outlines_.find(boundary.name);
      if (outline == outlines_.end()) {
        fault("the geometry has no boundary " + boundary.name, mesh_.point(boundary.edges.front()[0]));
        continue;
      }
      compare_nodes(boundary, outline->second);
      compare_points(boundary, outline->second);
    }
    for (const auto& [name, outline] : outlines_) fit_.boundaries_dropped += present.contains(name) ? 0 : 1;
    compare_corners();
    compare_area();
    return std::move(fit_);
  }

 private:
  void fault(const std::string& what, Point place) { fit_.faults.push_back({MeshRule::geometry, what, place}); }

  void compare_nodes(const BoundaryEdges& boundary, const NamedOutline& outline) {
    for (const auto& edge : boundary.edges) {
      for (const NodeId node : edge) {
        const double away = outline.segments.nearest(mesh_.point(node)).second;
        fit_.boundary_node_distance = std::max(fit_.boundary_node_distance, away);
        if (away > tolerance_ && node == edge[0]) fault("a node of boundary " + boundary.name + " lies off it", mesh_.point(node));
      }
    }
  }

  /// No point of the geometry is farther from the mesh's boundary than the cell there is long.
  void compare_points(const BoundaryEdges& boundary, const NamedOutline& outline) {
    SegmentSet edges;
    for (const auto& edge : boundary.edges) edges.add(mesh_.point(edge[0]), mesh_.point(edge[1]));
    edges.build();
    for (const Point p : outline.points) {
      const auto [edge, away] = edges.nearest(p);
      fit_.geometry_distance = std::max(fit_.geometry_distance, away);
      const auto& nodes = boundary.edges[edge];
      const std::int32_t cell = table_.cell_left_of(nodes[0], nodes[1]);
      const double allowed = cell < 0 ? 0 : longest_[static_cast<std::size_t>(cell)];
      if (away > std::max(allowed, tolerance_)) fault("a point of boundary " + boundary.name + " is farther from the mesh than a cell's edge", p);
    }
  }

  void compare_corners() {
    const std::vector<Point> sharp = sharp_points(geometry_);
    SegmentSet nodes;
    bool any = false;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& edge : boundary.edges) {
        for (const NodeId node : edge) nodes.add(mesh_.point(node), mesh_.point(node));
        any = true;
      }
    }
    nodes.build();
    fit_.sharp_corners = static_cast<std::int64_t>(sharp.size());
    fit_.sharp_corners_lost = std::count_if(sharp.begin(), sharp.end(), [&](Point p) { return !any || nodes.nearest(p).second > tolerance_; });
  }

  void compare_area() {
    long double wanted = 0, meshed = 0;
    for (const Chain& chain : geometry_) for_each_segment(chain, [&](Point a, Point b) { wanted += cross(a - centre_, b - centre_) / 2; });
    for (const OuterEdge& edge : outer_edges(mesh_, table_)) meshed += cross(mesh_.point(edge.from) - centre_, mesh_.point(edge.to) - centre_) / 2;
    fit_.area_error = static_cast<double>(std::abs(meshed - wanted) / std::abs(wanted));
    if (!(fit_.area_error <= largest_area_error)) fault("the area differs from the geometry's by more than 5 percent", centre_);
  }

  const Mesh& mesh_;
  std::span<const Chain> geometry_;
  std::map<std::string, NamedOutline> outlines_;
  EdgeTable table_;
  std::vector<double> longest_;
  Point centre_;
  double tolerance_ = 0;
  GeometryFit fit_;
};

}  // namespace

GeometryFit validate_geometry(const Mesh& mesh, std::span<const Chain> geometry, double tolerance) {
  return Comparison(mesh, geometry, tolerance).run();
}

}  // namespace quadloop
