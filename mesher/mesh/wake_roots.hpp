#pragma once

#include <set>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The wall nodes at which the strips that come from a wall begin: one at a sharp edge, two at the ends of a
/// blunt edge's base.
inline std::set<GlobalNodeId> wake_roots(const std::vector<StripLayers>& strips) {
  std::set<GlobalNodeId> roots;
  for (const StripLayers& strip : strips) {
    if (!strip.from_wall || strip.columns() == 0) continue;
    roots.insert(strip.node(0, strip.layers.count));
    roots.insert(strip.node(0, strip.across - 1 - strip.layers.count));
  }
  return roots;
}

}  // namespace quadloop
