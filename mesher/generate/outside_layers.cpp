#include "mesher/generate/outside_layers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/build/islands.hpp"
#include "mesher/build/outline_losses.hpp"

namespace quadloop {

bool has_layers(const MeshInput& input) {
  return !input.lines.empty() || std::ranges::any_of(input.geometry.boundaries(),
                                                     [](const Boundary& b) { return b.layers.has_value(); });
}

bool wants_y_plus(const Geometry& geometry) {
  return std::ranges::any_of(geometry.boundaries(),
                             [](const Boundary& b) { return b.layers && b.layers->y_plus > 0; });
}

Geometry geometry_with_layers(const MeshInput& input, MeshReport& dropped) {
  Geometry kept = without_small_islands(input.geometry, input.mesh.size.min, dropped);
  if (!input.mesh.may_vanish && !dropped.boundaries_vanished.empty()) {
    refuse_vanished(input.geometry, dropped.boundaries_vanished,
                    fmt::format("is smaller than spacing.min = {}", input.mesh.size.min));
  }
  return kept;
}

LayerFront front_of(const MeshInput& input, const Geometry& geometry, const MeasuredWall& measured) {
  return layer_front(geometry, input.mesh.size.curvature, input.lines, measured);
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
