#include "mesher/mesh/delaunay_check.hpp"

#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

bool is_delaunay(const Mesh& whole) {
  if (!whole.quads.empty() || whole.triangles.empty()) return false;
  const EdgeTable table(whole);
  for (const auto& nodes : whole.triangles) {
    const Point a = whole.point(nodes[0]), b = whole.point(nodes[1]), c = whole.point(nodes[2]);
    if (orientation(a, b, c) <= 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t across = table.cell_left_of(nodes[(k + 1) % 3], nodes[k]);
      if (across < 0) continue;
      for (const NodeId node : whole.triangles[static_cast<std::size_t>(across)]) {
        if (node != nodes[k] && node != nodes[(k + 1) % 3] && in_circle(a, b, c, whole.point(node)) > 0) return false;
      }
    }
  }
  return true;
}

}  // namespace quadloop
