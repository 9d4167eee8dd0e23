#pragma once

#include <string>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Why a mesh cannot be what smoothing makes of another one, both whole on this rank; empty where it can.
/// Smoothing keeps the cells (of a Delaunay mesh it may flip edges), leaves boundary nodes on their outline,
/// and lowers the cost of every patch of cells whose nodes it moves: nodes that were displaced by other
/// means, be it a little, break one of these. `outline` is the one that the mesh was made for; without it
/// boundary nodes must stay. Nodes that lie within same_place_tolerance of a local edge count as not moved.
/// The mesh found needs no boundaries.
std::string fault_of_smoothed(const Mesh& before, const Mesh& found, const Geometry* outline);

}  // namespace quadloop
