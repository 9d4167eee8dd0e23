#include "adapt/remesh/demands/finest_levels.hpp"

#include "generate/leaf_quadrant.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop::adapt {

namespace {

int finest_of_size(const TreeGrid& grid, double least, int finest) {
  int level = 0;
  while (level < finest && grid.edge(level + 1) >= least) ++level;
  return level;
}

}  // namespace

std::vector<std::int8_t> finest_levels(const Geometry& geometry, const TreeRecord& tree, int finest,
                                       bool facets_may_be_resolved) {
  std::vector<std::int8_t> levels(tree.leaves.size(), static_cast<std::int8_t>(finest));
  if (facets_may_be_resolved) return levels;
  const FacetZones facets(geometry);
  if (facets.empty()) return levels;
  const TreeAttributes& a = tree.attributes;
  const TreeGrid grid(root_box(a), a.trees_x, a.trees_y);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double least = facets.least_size(grid.box_of(quadrant_of(tree.leaves[i])));
    levels[i] = static_cast<std::int8_t>(finest_of_size(grid, least, finest));
  }
  return levels;
}

}  // namespace quadloop::adapt
