#pragma once

#include <random>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::shapes {

using Random = std::mt19937_64;

/// A geometry of small loops, made to be hard, and what it is called.
struct Shape {
  std::string name;
  std::vector<Chain> chains;
};

/// One of the families below, at random: star polygons, polygons on grid points, staircases, spikes, Koch
/// curves, nearly touching loops, islands with lakes, combs, thin walls, loops of several boundaries.
/// Coordinates within about [-1, 1].
Shape random_shape(Random& random);

}  // namespace quadloop::shapes
