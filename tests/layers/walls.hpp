#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::test {

/// A piece of a loop: its first points; it ends where the next piece begins.
struct Side {
  std::string name;
  std::vector<Point> points;
  std::optional<LayerSpec> layers = {};
};

/// Loops of sides that follow each other, each with the domain to its left. Sides of one name are one
/// boundary.
Geometry outline_of(const std::vector<std::vector<Side>>& loops, double spacing = 0.25);

/// So many layers of one height, so thick together.
LayerSpec equal_layers(double thickness, int count);

/// Of one height, 0.5 thick together.
inline constexpr LayerSpec four_layers{0.125, 1, 1, 4};

/// 0.519 thick together, the last one 0.103.
inline constexpr LayerSpec ten_layers{0.02, 1.2, 1.2, 10};

/// A box of 8 by 4 whose floor, y = 0, carries layers; its other sides do not.
Geometry floor_with_layers(const LayerSpec& layers);

/// A floor with a step up of height 2: two corners, at (4, 0) and (4, 2); the box ends at x = 8, y = 6.
Geometry step_with_layers(const LayerSpec& layers);

/// As step_with_layers(), with an arch of height 0.4 as its floor.
Geometry arch_and_step_with_layers(const LayerSpec& layers);

/// A box of 16 by 16 round a rhombus of layers with sharp edges at (-2, 0) and (2, 0), `half_height` high.
Geometry rhombus_with_layers(const LayerSpec& layers, double half_height);

/// With y for -y, curves included.
Geometry mirrored(const Geometry& geometry);

}  // namespace quadloop::test
