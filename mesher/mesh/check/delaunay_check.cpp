#include "mesher/mesh/check/delaunay_check.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "mesher/geometry/blunt_corners.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// The edges of inner lines, lower nodes first, ascending.
std::vector<std::array<NodeId, 2>> edges_of_lines(const Mesh& whole) {
  std::vector<std::array<NodeId, 2>> edges;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    if (!boundary.inner_line) continue;
    for (const auto& [from, to] : boundary.edges) edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::ranges::sort(edges);
  return edges;
}

}  // namespace

bool is_delaunay(const Mesh& whole, std::span<const std::int32_t> triangle_to_block) {
  if (!whole.quads.empty() || whole.triangles.empty()) return false;
  const EdgeTable table(whole);
  const std::vector<std::array<NodeId, 2>> of_lines = edges_of_lines(whole);
  const auto same_block = [&](std::size_t a, std::size_t b) {
    return triangle_to_block.empty() || triangle_to_block[a] == triangle_to_block[b];
  };
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& nodes = whole.triangles[t];
    const Point a = whole.point(nodes[0]), b = whole.point(nodes[1]), c = whole.point(nodes[2]);
    if (orientation(a, b, c) <= 0) return false;
    // An edge that is not Delaunay is opposite an obtuse corner of one of its triangles.
    for (unsigned blunt = blunt_corners(a, b, c); blunt != 0; blunt &= blunt - 1) {
      const std::size_t k = (std::countr_zero(blunt) + std::size_t{1}) % 3;
      const std::int32_t across = table.cell_left_of(nodes[(k + 1) % 3], nodes[k]);
      if (across < 0 || !same_block(t, across)) continue;
      const auto [low, high] = std::minmax({nodes[k], nodes[(k + 1) % 3]});
      if (std::ranges::binary_search(of_lines, std::array{low, high})) continue;
      for (const NodeId node : whole.triangles[across]) {
        if (node != nodes[k] && node != nodes[(k + 1) % 3] && in_circle(a, b, c, whole.point(node)) > 0)
          return false;
      }
    }
  }
  return true;
}

}  // namespace quadloop
