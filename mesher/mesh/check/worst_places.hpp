#pragma once

#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// Where a mesh is at its worst; the first place in the order of the cells where several are.
struct WorstPlaces {
  Point smallest_angle, largest_angle;  ///< the corners
  Point worst_quality;                  ///< the mean of the cell's nodes
  Point largest_area_ratio;             ///< the middle of the edge
};

/// Of a mesh with cells that is whole on this rank and names existing nodes. Angles and quality are those of
/// cells outside layers; `places` is empty where there are none. Linear in time.
WorstPlaces worst_places(const Mesh& whole_mesh, const MeshTopology& topology, const LayerPlaces& places);

}  // namespace quadloop
