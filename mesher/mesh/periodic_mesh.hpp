#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/periodic_images.hpp"

namespace quadloop {

/// The other side of a boundary of a mesh, where it is a side of a pair.
struct OppositeSide {
  std::int32_t boundary = -1;  ///< -1: none
  PeriodicShift shift = 0;     ///< the map from this side to that one

  bool exists() const { return boundary >= 0; }
};

/// A mesh in which the nodes on the two sides of periodic pairs are joined. Of the nodes that belong together
/// one remains, on a side `from`; in the cells on the other side its image takes the place of its partner. An
/// image is a ghost with an image_number(), on every rank.
struct PeriodicMesh {
  Mesh mesh;  ///< without pairs and strips
  PeriodicMaps maps;
  std::vector<Point> originals;        ///< for each node its position; for an image that of its original
  IdVector<NodeId, NodeId> node_of;    ///< for each owned node of the given mesh the node that replaces it
  std::vector<OppositeSide> opposite;  ///< of each boundary
};

/// Whether the sides of pairs have their edges in the joined mesh.
enum class SideEdges { left_out, kept };

/// Returns the mesh with its pairs joined; the order of the nodes is kept. Throws InputError if the nodes of
/// a pair do not match, if the maps of the pairs do not commute, or if a node is its own partner.
/// *Collective.*
PeriodicMesh join_pairs(const Communicator& comm, const Mesh& mesh, SideEdges edges = SideEdges::left_out);

/// Same; none for a mesh without pairs, and where join_pairs() throws InputError. *Collective.*
std::optional<PeriodicMesh> join_pairs_if_possible(const Communicator& comm, const Mesh& mesh,
                                                   SideEdges edges = SideEdges::left_out);

}  // namespace quadloop
