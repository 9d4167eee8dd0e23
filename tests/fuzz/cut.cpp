// The unit square cut by loops with corners on a grid finer than the square: the cells are positive, and as
// large together as the loops within the square.
#include <cmath>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/leaf_cells.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/outlines.hpp"

namespace quadloop::fuzz {

namespace {

using Points = std::vector<Point>;

Geometry outline_from(Bytes& bytes) {
  AssembleOptions options;
  options.domain_is_known = true;
  Warnings warnings;
  return assemble(loops_from(bytes), options, warnings);
}

/// The part of a polygon with dot(p, normal) <= limit.
Points clipped(const Points& polygon, Point normal, double limit) {
  Points kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point p = polygon[k], q = polygon[(k + 1) % polygon.size()];
    const double at_p = dot(p, normal) - limit, at_q = dot(q, normal) - limit;
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

double area_in_unit_square(const Geometry& geometry) {
  double area = 0;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    Points polygon;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v)
      polygon.push_back(geometry.point(v));
    polygon = clipped(clipped(polygon, {1, 0}, 1), {-1, 0}, 0);
    polygon = clipped(clipped(polygon, {0, 1}, 1), {0, -1}, 0);
    for (std::size_t k = 0; k < polygon.size(); ++k)
      area += 0.5 * cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  }
  return area;
}

double area_of(const CutLeaf& leaf, const LeafCells& cells) {
  const auto at = [&](std::int32_t n) { return leaf.nodes[n].position; };
  double area = 0;
  for (const auto& t : cells.triangles) {
    QUADLOOP_REQUIRE(is_positive(at(t[0]), at(t[1]), at(t[2])), "a triangle is not positive");
    area += 0.5 * cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
  }
  for (const auto& q : cells.quads) {
    for (std::size_t k = 0; k < 4; ++k)
      QUADLOOP_REQUIRE(is_positive(at(q[k]), at(q[(k + 1) % 4]), at(q[(k + 2) % 4])), "a quad is not convex");
    area += 0.5 * cross(at(q[2]) - at(q[0]), at(q[3]) - at(q[1]));
  }
  return area;
}

}  // namespace

int cut_leaf(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Geometry geometry = outline_from(bytes);
  const ShiftedOutline outline(geometry);
  const Interior inside(outline);
  const Box box{{0, 0}, {1, 1}};
  std::vector<std::int32_t> segments;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (outline.meets(s, box)) segments.push_back(s);
  }
  LeafTraces traces;
  traces.add(outline, box, segments);
  LeafCutter cutter(outline, inside);
  LeafCellMaker maker;
  for (const Detail detail : {Detail::merged, Detail::full, Detail::exact}) {
    const bool sound = cutter.cut({traces[0], box.centre(), {}, {}, {}}, detail);
    QUADLOOP_REQUIRE(sound || detail != Detail::exact, "the exact loops of a leaf are not sound");
    LeafCells cells;
    if (!sound || !maker.make({0, 0, 0}, box, cutter.result(), cells)) continue;
    const double area = area_of(cutter.result(), cells);
    if (detail == Detail::exact)
      QUADLOOP_REQUIRE(std::abs(area - area_in_unit_square(geometry)) < 1e-12, "the cells miss a part");
  }
  return 0;
}

}  // namespace quadloop::fuzz
