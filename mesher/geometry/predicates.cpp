#include "mesher/geometry/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace quadloop {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 exact(Point p) { return {p.x, p.y}; }

}  // namespace

int exact_orientation(Point a, Point b, Point c) {
  return static_cast<int>(CGAL::orientation(exact(a), exact(b), exact(c)));
}

int in_circle(Point a, Point b, Point c, Point d) {
  return static_cast<int>(CGAL::side_of_oriented_circle(exact(a), exact(b), exact(c), exact(d)));
}

bool on_segment(Point p, Point a, Point b) {
  return orientation(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

bool segments_meet(Point a, Point b, Point c, Point d) {
  const int abc = orientation(a, b, c), abd = orientation(a, b, d);
  const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return on_segment(c, a, b) || on_segment(d, a, b) || on_segment(a, c, d) || on_segment(b, c, d);
}

}  // namespace quadloop
