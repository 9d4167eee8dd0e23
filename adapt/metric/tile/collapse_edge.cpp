#include <algorithm>
#include <iterator>
#include <utility>

#include "adapt/metric/tile/operations.hpp"
#include "mesher/delaunay/flipper.hpp"

namespace quadloop::adapt {

namespace {

/// A triangle of this quality is always acceptable.
constexpr double good = 0.5;

/// Whether some triangles at the node are outside the tile.
bool on_rim(const TileMesh& mesh, std::int32_t n) {
  return std::ranges::any_of(mesh.star(n), [&](std::int32_t t) {
    const auto k = static_cast<std::size_t>(mesh.corner(t, n));
    const auto is_rim = [](const TileSide& side) { return side.locked && side.boundary < 0; };
    const auto& sides = mesh.triangle(t).sides;
    return is_rim(sides[k]) || is_rim(sides[(k + 2) % 3]);
  });
}

/// A boundary node may only move along its boundary: a-b must be one of its two boundary edges. A hole with
/// three edges is kept.
bool may_go(const TileMesh& mesh, std::int32_t gone, const TileMesh::Edge& edge) {
  if (mesh.freedom(gone) == TileMesh::Freedom::fixed) return false;
  if (mesh.freedom(gone) == TileMesh::Freedom::free) return true;
  if (edge.side.boundary < 0) return false;
  const auto [before, after] = mesh.neighbours_on_wall(gone);
  if (before == after || mesh.edge(before, after)) return false;
  // A third edge of the hole may be outside the tile.
  if (on_rim(mesh, before) && on_rim(mesh, after)) return false;
  const Walls& walls = mesh.walls();
  Walls::Chord whole = mesh.chord(before, after, edge.side.boundary);
  const smoother::OutlinePlace at = walls.place_of(mesh.point(gone), edge.side.boundary);
  return at.valid() && walls.may_change(whole) && walls.may_join(whole, at, mesh.point(gone));
}

/// The only nodes joined to both ends must be those of the edge's triangles.
bool keeps_topology(const TileMesh& mesh, std::int32_t gone, std::int32_t stays, const TileMesh::Edge& edge) {
  const auto of_one = mesh.neighbours(gone), of_other = mesh.neighbours(stays);
  std::vector<std::int32_t> both;
  std::ranges::set_intersection(of_one, of_other, std::back_inserter(both));
  return both.size() == (edge.right < 0 ? 1U : 2U) && mesh.star(gone).size() > both.size();
}

/// The worst quality after the collapse; none if it is not allowed.
std::optional<double> worst_after(const TileMesh& mesh, std::int32_t gone, std::int32_t stays,
                                  double longest) {
  double worst = 1;
  for (const std::int32_t t : mesh.star(gone)) {
    if (mesh.corner(t, stays) >= 0) continue;
    auto nodes = mesh.triangle(t).nodes;
    nodes[static_cast<std::size_t>(mesh.corner(t, gone))] = stays;
    if (!is_positive(mesh.point(nodes[0]), mesh.point(nodes[1]), mesh.point(nodes[2]))) return {};
    worst = std::min(worst, mesh.quality(nodes));
  }
  for (const std::int32_t other : mesh.neighbours(gone)) {
    if (other != stays && mesh.edge_length(other, stays) > longest) return {};
  }
  if (worst < std::min(good, mesh.worst_round(gone))) return {};
  return worst;
}

/// Removes the triangles beside the edge; the neighbour across the edge not containing `stays` becomes the
/// neighbour of the triangle that replaces it.
void join(TileMesh& mesh, std::int32_t gone, std::int32_t stays, const TileMesh::Edge& edge) {
  struct Kept {
    std::int32_t apex;
    TileSide side;
  };
  std::vector<Kept> kept;
  for (const std::int32_t t : {edge.left, edge.right}) {
    if (t < 0) continue;
    const auto at = static_cast<std::size_t>(mesh.corner(t, gone));
    const TileTriangle& triangle = mesh.triangle(t);
    const std::int32_t next = triangle.nodes[(at + 1) % 3], last = triangle.nodes[(at + 2) % 3];
    kept.push_back({next == stays ? last : next, triangle.sides[(at + 1) % 3]});
    mesh.remove_triangle(t);
  }
  for (const std::int32_t t : std::vector<std::int32_t>(mesh.star(gone))) mesh.replace_node(t, gone, stays);
  for (const Kept& k : kept) mesh.set_side(stays, k.apex, k.side);
}

}  // namespace

bool collapse_edge(TileMesh& mesh, std::int32_t a, std::int32_t b, double longest) {
  const auto edge = mesh.edge(a, b);
  if (!edge || edge->side.locked) return false;
  std::optional<double> best;
  std::int32_t gone = -1, stays = -1;
  for (const auto& [from, to] : {std::pair{edge->a, edge->b}, std::pair{edge->b, edge->a}}) {
    if (!may_go(mesh, from, *edge) || !keeps_topology(mesh, from, to, *edge)) continue;
    const auto worst = worst_after(mesh, from, to, longest);
    if (!worst || (best && *worst <= *best)) continue;
    best = worst;
    gone = from;
    stays = to;
  }
  if (!best) return false;
  join(mesh, gone, stays, *edge);
  return true;
}

}  // namespace quadloop::adapt
