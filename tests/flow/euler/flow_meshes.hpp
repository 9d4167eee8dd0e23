#pragma once

#include <functional>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::test {

/// A grid of n x n cells, quads and triangles, on a rectangle from the origin, its nodes moved by up to
/// `jitter_share` of the steps.
Mesh irregular_grid(std::int32_t n, Point size, double jitter_share, bool quads = true);

/// Gives each boundary edge to the boundary that `name_of(middle)` tells; the name is the condition too.
void relabel(Mesh& mesh, const std::function<std::string(Point)>& name_of);

/// A channel of 1.5 x 1 whose floor rises by this angle from x = 0.5 on: n x n quads. Inflow left, farfield
/// above, outflow right, symmetry before the corner, then wall.
Mesh wedge_mesh(std::int32_t n, double degrees);

/// Quads around the ellipse with the axes 1 and `thickness` about the origin, out to a circle of radius
/// `far`: a mirror image of itself in the x axis. The boundaries are "wall" and "farfield".
Mesh ring_mesh(std::int32_t around, std::int32_t outwards, double thickness, double far);

}  // namespace quadloop::test
