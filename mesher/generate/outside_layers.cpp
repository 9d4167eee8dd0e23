#include "mesher/generate/outside_layers.hpp"

#include <algorithm>

namespace quadloop {

bool has_layers(const MeshInput& input) {
  return !input.lines.empty() || std::ranges::any_of(input.geometry.boundaries(),
                                                     [](const Boundary& b) { return b.layers.has_value(); });
}

bool wants_y_plus(const Geometry& geometry) {
  return std::ranges::any_of(geometry.boundaries(),
                             [](const Boundary& b) { return b.layers && b.layers->y_plus > 0; });
}

LayerFront front_of(const MeshInput& input, const MeasuredWall& measured) {
  return layer_front(input.geometry, input.mesh.size.curvature, input.lines, measured);
}

MeshInput outside(const MeshInput& input, const LayerFront& front) {
  MeshInput outer = input;
  outer.geometry = front.outer;
  outer.smooth.front_heights = front.last_heights;
  const Lattice lattice = choose_root(input.geometry, input.mesh.size.root);
  outer.mesh.size.root =
      RootOptions{lattice.box().low, lattice.tree_edge(), lattice.trees_x(), lattice.trees_y()};
  return outer;
}

}  // namespace quadloop
