#pragma once

#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// Locations of the worst cells of a mesh; the first in the order of the cells if there are several.
struct WorstPlaces {
  Point smallest_angle, largest_angle;  ///< the corners
  Point worst_quality;                  ///< the mean of the cell's nodes
  Point largest_area_ratio;             ///< the middle of the edge
};

/// The mesh must have cells, be whole on this rank and have valid node numbers. Angles and quality are those
/// of cells outside layers; `places` is empty if there are none. Linear in time.
WorstPlaces worst_places(const Mesh& whole_mesh, const MeshTopology& topology, const LayerPlaces& places);

}  // namespace quadloop
