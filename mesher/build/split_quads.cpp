#include "mesher/build/split_quads.hpp"

#include <algorithm>

#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

using Corners = std::array<Point, 4>;

bool is_parallelogram(const Corners& p) { return skew_of(p) <= parallel_skew; }

/// By the plain products in doubles that every reader of the mesh will use, at each corner.
bool is_positive(Point a, Point b, Point c) {
  return cross(b - a, c - a) > 0 && cross(c - b, a - b) > 0 && cross(a - c, b - c) > 0;
}

/// Whether the diagonal from the first corner to the third divides the quadrilateral, and not the other one.
bool takes_first_diagonal(const Corners& p, const std::function<TieRank(Point)>& rank) {
  if (!is_positive(p[0], p[1], p[2]) || !is_positive(p[0], p[2], p[3])) return false;
  if (!is_positive(p[0], p[1], p[3]) || !is_positive(p[1], p[2], p[3])) return true;
  const int inside = in_circle(p[0], p[1], p[2], p[3]);
  if (inside != 0) return inside < 0;
  return std::max(rank(p[0]), rank(p[2])) > std::max(rank(p[1]), rank(p[3]));
}

}  // namespace

void split_skew_quads(Mesh& mesh, std::vector<LeafRecord>& leaves,
                      const std::function<TieRank(Point)>& rank) {
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<std::array<NodeId, 4>> quads;
  triangles.reserve(mesh.triangles.size() + mesh.triangles.size() / 4);
  quads.reserve(mesh.quads.size());
  auto triangle = mesh.triangles.cbegin();
  auto quad = mesh.quads.cbegin();
  for (LeafRecord& leaf : leaves) {
    const std::size_t triangles_before = triangles.size(), quads_before = quads.size();
    triangles.insert(triangles.end(), triangle, triangle + leaf.triangles);
    triangle += leaf.triangles;
    for (const auto end = quad + leaf.quads; quad != end; ++quad) {
      const auto& [a, b, c, d] = *quad;
      const Corners corners{mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d)};
      if (is_parallelogram(corners)) {
        quads.push_back(*quad);
      } else if (takes_first_diagonal(corners, rank)) {
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
    leaf.triangles = static_cast<std::int32_t>(triangles.size() - triangles_before);
    leaf.quads = static_cast<std::int32_t>(quads.size() - quads_before);
  }
  mesh.triangles = std::move(triangles);
  mesh.quads = std::move(quads);
}

}  // namespace quadloop
