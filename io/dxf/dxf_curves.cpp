#include "io/dxf/dxf_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/transform.hpp"

namespace quadloop::io {

namespace {

Point point_at(const DxfRecord& entity, int code) { return {entity.real(code), entity.real(code + 10)}; }

/// The direction normal to an entity's plane, not normalized.
struct Extrusion {
  double x = 0, y = 0, z = 1;
};

Extrusion extrusion_of(const DxfRecord& entity) {
  const Extrusion normal{entity.real(210), entity.real(220), entity.real(230, 1)};
  const double size = std::hypot(normal.x, normal.y, normal.z);
  if (!(size > 0)) entity.refuse("its extrusion has no direction");
  return {normal.x / size, normal.y / size, normal.z / size};
}

Chain chain_from(Point p) {
  return {.name = {}, .open = true, .points = {p}, .source = {}, .directed = false};
}

Chain line_of(const DxfRecord& entity) {
  Chain chain = chain_from(point_at(entity, 10));
  append_line(chain, point_at(entity, 11));
  return chain;
}

/// A whole ellipse as four curves between the ends of its axes.
Chain ellipse_of(Point centre, Point major, Point minor) {
  Chain chain = chain_from(centre + major);
  for (int quarter = 0; quarter < 4; ++quarter) {
    append_segment(chain, {{centre + major + minor}, {1, std::numbers::sqrt2 / 2, 1}}, centre + minor);
    major = std::exchange(minor, -1 * major);
  }
  return chain;
}

double radius_of(const DxfRecord& entity) {
  const double radius = entity.real(40);
  if (radius < 0) entity.refuse("its radius is negative");
  return radius;
}

Chain arc_of(const DxfRecord& entity) {
  constexpr double whole_turn = 360, rounding = 1e-9;
  const Point centre = point_at(entity, 10);
  const double radius = radius_of(entity), begin = entity.real(50), end = entity.real(51, whole_turn);
  double sweep = std::fmod(end - begin, whole_turn);
  if (sweep < 0) sweep += whole_turn;
  if (sweep < rounding || sweep > whole_turn - rounding) return ellipse_of(centre, {radius, 0}, {0, radius});
  const Point major = radius * unit_vector(begin), minor = radius * unit_vector(begin + 90);
  Chain chain = chain_from(centre + major);
  append_arc(chain, {centre, major, minor, 0, sweep * (std::numbers::pi / 180)},
             centre + radius * unit_vector(end));
  return chain;
}

Chain elliptic_arc_of(const DxfRecord& entity) {
  constexpr double whole_turn = 2 * std::numbers::pi, rounding = 1e-5;  // programs write 6.28319
  const Point centre = point_at(entity, 10), major = point_at(entity, 11);
  const auto [x, y, z] = extrusion_of(entity);
  const double ratio = entity.real(40, 1), height = entity.real(31);
  const Point minor = ratio * Point{y * height - z * major.y, z * major.x - x * height};
  const double begin = entity.real(41);
  double sweep = std::fmod(entity.real(42, whole_turn) - begin, whole_turn);
  if (sweep < 0) sweep += whole_turn;
  if (sweep < rounding || sweep > whole_turn - rounding) return ellipse_of(centre, major, minor);
  const EllipticArc arc{centre, major, minor, begin, begin + sweep};
  Chain chain = chain_from(arc.point_at(begin));
  append_arc(chain, arc);
  return chain;
}

/// Points given by groups with this code and the next ten higher one.
std::vector<Point> points_of(const DxfRecord& entity, int code) {
  std::vector<Point> points;
  for (const DxfGroup& group : entity.groups()) {
    if (group.code == code) points.push_back({entity.real_of(group), 0});
    if (group.code == code + 10 && !points.empty()) points.back().y = entity.real_of(group);
  }
  return points;
}

std::vector<double> numbers_of(const DxfRecord& entity, int code) {
  std::vector<double> numbers;
  for (const DxfGroup& group : entity.groups()) {
    if (group.code == code) numbers.push_back(entity.real_of(group));
  }
  return numbers;
}

std::optional<Point> direction_of(const DxfRecord& entity, int code) {
  const Point p = point_at(entity, code);
  return length(p) > 0 ? std::optional(p) : std::nullopt;
}

Chain interpolated(const DxfRecord& entity, std::vector<Point> points) {
  constexpr int closed_flag = 1;
  constexpr double no_corner = 180;
  points.erase(std::ranges::unique(points).begin(), points.end());
  const bool closed = (entity.whole(70) & closed_flag) != 0;
  if (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < (closed ? 3 : 2)) entity.refuse("it has too few different fit points");
  if (closed) {
    Chain chain = chain_from(points.front());
    chain.points = std::move(points);
    chain.open = false;
    join_by_splines(chain, no_corner);
    return chain;
  }
  Chain chain = chain_from(points.front());
  append_spline(chain, std::span(points).subspan(1), {direction_of(entity, 12), direction_of(entity, 13)});
  return chain;
}

Chain spline_of(const DxfRecord& entity) {
  BSpline spline{static_cast<int>(std::clamp<std::int64_t>(entity.whole(71, 3), 0, 100)),
                 numbers_of(entity, 40), points_of(entity, 10), numbers_of(entity, 41)};
  if (spline.poles.empty()) return interpolated(entity, points_of(entity, 11));
  if (const std::string fault = fault_of(spline); !fault.empty()) entity.refuse(fault);
  Chain chain = chain_from(start_of(spline));
  append_bspline(chain, spline);
  return chain;
}

/// A vertex of a polyline, and the bulge of the segment behind it.
struct Vertex {
  Point p;
  double bulge = 0;
};

/// The vertices of an LWPOLYLINE, whose groups follow one another.
std::vector<Vertex> light_vertices(const DxfRecord& entity) {
  std::vector<Vertex> vertices;
  for (const DxfGroup& group : entity.groups()) {
    if (group.code == 10) vertices.push_back({{entity.real_of(group), 0}});
    if (vertices.empty()) continue;
    if (group.code == 20) vertices.back().p.y = entity.real_of(group);
    if (group.code == 42) vertices.back().bulge = entity.real_of(group);
  }
  return vertices;
}

/// The vertices that follow a POLYLINE, without those that only control a spline.
std::vector<Vertex> heavy_vertices(std::span<const DxfRecord> following) {
  constexpr int controls_spline = 16;
  std::vector<Vertex> vertices;
  for (const DxfRecord& vertex : following) {
    if (vertex.type() != "VERTEX") break;
    if ((vertex.whole(70) & controls_spline) == 0)
      vertices.push_back({point_at(vertex, 10), vertex.real(42)});
  }
  return vertices;
}

Chain polyline_through(const std::vector<Vertex>& vertices, bool closed) {
  Chain chain = chain_from(vertices.front().p);
  const std::size_t segments = closed ? vertices.size() : vertices.size() - 1;
  const bool curved = std::ranges::any_of(vertices, [](const Vertex& vertex) { return vertex.bulge != 0; });
  for (std::size_t i = 0; i < segments; ++i) {
    const Point next = vertices[(i + 1) % vertices.size()].p;
    if (!curved || next != chain.points.back()) append_bulge(chain, vertices[i].bulge, next);
  }
  return chain;
}

std::optional<Chain> polyline_of(std::span<const DxfRecord> entities) {
  constexpr std::int64_t closed = 1;
  const DxfRecord& entity = entities.front();
  const std::vector<Vertex> vertices =
      entity.type() == "LWPOLYLINE" ? light_vertices(entity) : heavy_vertices(entities.subspan(1));
  if (vertices.empty()) return {};
  return polyline_through(vertices, (entity.whole(70) & closed) != 0);
}

/// Whether the entity's coordinates are those of its plane; the others have those of the drawing or block.
bool has_plane(const DxfRecord& entity) {
  constexpr int in_space = 8;
  const std::string_view type = entity.type();
  return type == "ARC" || type == "CIRCLE" || type == "LWPOLYLINE" ||
         (type == "POLYLINE" && (entity.whole(70) & in_space) == 0);
}

std::optional<Chain> curve_in_plane(std::span<const DxfRecord> entities) {
  const DxfRecord& entity = entities.front();
  const std::string_view type = entity.type();
  if (type == "LINE") return line_of(entity);
  if (type == "ARC") return arc_of(entity);
  if (type == "CIRCLE") {
    const double radius = radius_of(entity);
    return ellipse_of(point_at(entity, 10), {radius, 0}, {0, radius});
  }
  if (type == "ELLIPSE") return elliptic_arc_of(entity);
  if (type == "SPLINE") return spline_of(entity);
  return polyline_of(entities);
}

void place(Chain& chain, const DxfPlacement& placement) {
  for (Point& p : chain.points) p = placement(p);
  for (Curve& curve : chain.curves) {
    for (Point& p : curve.inner) p = placement(p);
  }
}

/// The box of all points of the control polygons.
Box hull_box(const Chain& chain) {
  Box box;
  for (const Point p : chain.points) box.include(p);
  for (const Curve& curve : chain.curves) {
    for (const Point p : curve.inner) box.include(p);
  }
  return box;
}

/// A loop of at most two segments, each divided into four, as a loop needs three points.
void divide(Chain& loop) {
  Chain finer = chain_from(loop.points.front());
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Point to = loop.points[(i + 1) % loop.points.size()];
    const auto [first, second] = halves({loop.points[i], loop.curves[i], to});
    for (const CurvedSegment& half : {first, second}) {
      const auto [begin, end] = halves(half);
      append_segment(finer, begin.curve, begin.to);
      append_segment(finer, end.curve, end.to);
    }
  }
  finer.points.pop_back();
  loop.points = std::move(finer.points);
  loop.curves = std::move(finer.curves);
}

/// Joins the ends of an open chain that coincide; those of curves up to rounding.
void close(Chain& chain, double extent) {
  constexpr double rounding = 1e-13;
  const bool curved = !chain.curves.empty();
  if (!chain.open || (!curved && chain.points.size() < 3)) return;
  if (length(chain.points.back() - chain.points.front()) > (curved ? rounding * extent : 0)) return;
  chain.open = false;
  chain.points.pop_back();
  if (curved && chain.points.size() < 3) divide(chain);
}

}  // namespace

DxfPlacement DxfPlacement::after(const DxfPlacement& first) const {
  const Point moved = (*this)(first.origin);
  return {first.x.x * x + first.x.y * y, first.y.x * x + first.y.y * y, moved};
}

DxfPlacement plane_of(const DxfRecord& entity) {
  constexpr double limit = 1.0 / 64;
  if (!entity.has(210) && !entity.has(220) && !entity.has(230)) return {};
  const auto [x, y, z] = extrusion_of(entity);
  const bool steep = std::abs(x) < limit && std::abs(y) < limit;
  const Extrusion along = steep ? Extrusion{z, 0, -x} : Extrusion{-y, x, 0};
  const double size = std::hypot(along.x, along.y, along.z);
  const Point first{along.x / size, along.y / size};
  const double first_z = along.z / size;
  const Point second{y * first_z - z * first.y, z * first.x - x * first_z};
  const double height = entity.real(entity.type() == "LWPOLYLINE" ? 38 : 30);
  return {first, second, height * Point{x, y}};
}

bool is_dxf_curve(const DxfRecord& entity) {
  constexpr std::int64_t mesh = 16, faces = 64;
  static const std::set<std::string_view> types{"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE"};
  if (entity.type() == "POLYLINE") return (entity.whole(70) & (mesh | faces)) == 0;
  return types.contains(entity.type());
}

std::optional<Chain> dxf_curve(std::span<const DxfRecord> entities, const DxfPlacement& placement) {
  const DxfRecord& entity = entities.front();
  std::optional<Chain> chain = curve_in_plane(entities);
  if (!chain) return {};
  place(*chain, has_plane(entity) ? placement.after(plane_of(entity)) : placement);
  const Box box = hull_box(*chain);
  const double extent = std::max(box.width(), box.height());
  if (!(extent > 0)) return {};
  close(*chain, extent);
  return chain;
}

}  // namespace quadloop::io
