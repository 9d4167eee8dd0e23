#pragma once

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A place on the front: a station, or between it and the next one.
struct FrontPlace {
  std::int32_t station = WallLine::none;
  /// Of the way to the next station, from this one and from the next one; 0 and 1 at the station.
  double share = 0, rest = 1;

  bool valid() const { return station != WallLine::none; }
  bool at_station() const { return share == 0; }
};

/// Finds nodes of the mesh outside on the front.
class FrontPlaces {
 public:
  /// `front` must outlive it.
  explicit FrontPlaces(const LayerFront& front);

  /// The place nearest to a node of the boundary; none where the boundary has no front. O(log n).
  FrontPlace locate(Point node, BoundaryId boundary) const;

  /// Whether the second place follows the first one on the same line of wall; round a loop each place follows
  /// all others. An edge of the mesh outside has the domain to its left and leads on along the front, in a
  /// coarse mesh past most of a small body's stations.
  bool follows(const FrontPlace& first, const FrontPlace& second) const;

 private:
  struct OfBoundary {
    std::vector<std::int32_t> segments;  ///< of outer, that are front
    BoxTree tree;
  };

  const LayerFront* front_;
  IdVector<BoundaryId, OfBoundary> of_boundary_;
};

/// Of each of a mesh's nodes that are on a front: on the ranks that own them and on those with an edge there.
/// *Collective.*
IdVector<NodeId, FrontPlace> places_of_nodes(const Communicator& comm, const FrontPlaces& places,
                                             const Mesh& mesh);

}  // namespace quadloop
