#pragma once

#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/periodic_images.hpp"

namespace quadloop {

/// A mesh in which the nodes on the two sides of periodic pairs are joined. Of the nodes that belong together
/// the first remains; in the cells on the other side its image takes the place of its partner. An image is a
/// ghost with an image_number(), on every rank.
struct PeriodicMesh {
  Mesh mesh;  ///< without pairs and strips; the boundaries of pairs have no edges
  PeriodicMaps maps;
  std::vector<Point> originals;      ///< for each node its position; for an image that of its original
  IdVector<NodeId, NodeId> node_of;  ///< for each owned node of the given mesh the node that replaces it
};

/// Returns the mesh with its pairs joined; the order of the nodes is kept. Throws InputError if the nodes of
/// a pair do not match, if the maps of the pairs do not commute, or if a node is its own partner.
/// *Collective.*
PeriodicMesh join_pairs(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
