#include <algorithm>

#include "adapt/metric/tile/operations.hpp"
#include "mesher/delaunay/flipper.hpp"

namespace quadloop::adapt {

bool flip_edge(TileMesh& mesh, std::int32_t from, std::int32_t to) {
  constexpr double gain = 1.001;  // prevents repeated flips by rounding
  const auto edge = mesh.edge(from, to);
  if (!edge || edge->side.locked || edge->right < 0) return false;
  const auto [a, b, left, right, side] = *edge;
  const auto at_left = static_cast<std::size_t>(mesh.corner(left, a)),
             at_right = static_cast<std::size_t>(mesh.corner(right, b));
  const TileTriangle over = mesh.triangle(left), under = mesh.triangle(right);
  const std::int32_t c = over.nodes[(at_left + 2) % 3], d = under.nodes[(at_right + 2) % 3];
  if (mesh.edge(c, d)) return false;
  const Point pa = mesh.point(a), pb = mesh.point(b), pc = mesh.point(c), pd = mesh.point(d);
  if (!is_positive(pa, pd, pc) || !is_positive(pd, pb, pc)) return false;
  const double before = std::min(mesh.quality(left), mesh.quality(right));
  const double after = std::min(mesh.quality({a, d, c}), mesh.quality({d, b, c}));
  if (!(after > gain * before)) return false;
  mesh.remove_triangle(left);
  mesh.remove_triangle(right);
  mesh.add_triangle(
      {{a, d, c}, {under.sides[(at_right + 1) % 3], TileSide{}, over.sides[(at_left + 2) % 3]}});
  mesh.add_triangle(
      {{d, b, c}, {under.sides[(at_right + 2) % 3], over.sides[(at_left + 1) % 3], TileSide{}}});
  return true;
}

}  // namespace quadloop::adapt
