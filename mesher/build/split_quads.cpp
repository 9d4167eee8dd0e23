#include "mesher/build/split_quads.hpp"

#include <algorithm>

#include "mesher/delaunay/flipper.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

using Corners = std::array<Point, 4>;

bool is_parallelogram(const Corners& p) { return skew_of(p) <= parallel_skew; }

/// Whether the quadrilateral is split by the diagonal from the first to the third corner.
bool takes_first_diagonal(const Corners& p, const std::function<TieRank(Point)>& rank) {
  return is_positive(p[0], p[1], p[2]) && is_positive(p[0], p[2], p[3]) &&
         !should_flip(p[0], p[2], p[3], p[1], [&](std::size_t k) {
           const std::array<std::size_t, 4> corners{0, 2, 3, 1};
           return rank(p[corners[k]]);
         });
}

}  // namespace

void split_skew_quads(Mesh& mesh, std::vector<LeafRecord>& leaves,
                      const std::function<TieRank(Point)>& rank) {
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<std::array<NodeId, 4>> quads;
  triangles.reserve(mesh.triangles.size() + 2 * mesh.quads.size());
  MeshBlocks blocks{mesh.blocks.names, {}, {}};
  auto triangle = mesh.triangles.cbegin();
  auto quad = mesh.quads.cbegin();
  for (LeafRecord& leaf : leaves) {
    const std::int32_t triangles_before = size32(triangles), quads_before = size32(quads);
    triangles.insert(triangles.end(), triangle, triangle + leaf.triangles);
    if (!mesh.blocks.names.empty()) {
      const auto block = mesh.blocks.of_triangles.begin() + (triangle - mesh.triangles.cbegin());
      blocks.of_triangles.insert(blocks.of_triangles.end(), block, block + leaf.triangles);
    }
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
      if (mesh.blocks.names.empty()) continue;
      const std::int32_t block = mesh.blocks.of_quads[quad - mesh.quads.cbegin()];
      blocks.of_triangles.resize(triangles.size(), block);
      blocks.of_quads.resize(quads.size(), block);
    }
    leaf.triangles = size32(triangles) - triangles_before;
    leaf.quads = size32(quads) - quads_before;
  }
  mesh.blocks = std::move(blocks);
  mesh.triangles = std::move(triangles);
  mesh.quads = std::move(quads);
}

}  // namespace quadloop
