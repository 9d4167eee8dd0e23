#pragma once

#include <vector>

#include "mesher/forest/refine_forest.hpp"
#include "tests/sizes/diamond_sizes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// The leaves of all ranks that these sizes lead to. *Collective.*
inline std::vector<Quadrant> forest_of(const DiamondSizes& sizes) {
  SizeTree tree = sizes.tree();
  const LeafGraph graph = refine_forest(world(), tree);
  std::vector<Quadrant> local;
  for (const LeafId leaf : graph.local()) local.push_back(graph.leaf(leaf));
  return world().all_gather_values(std::span<const Quadrant>(local));
}

}  // namespace quadloop::test
