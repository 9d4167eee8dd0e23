#pragma once

#include <array>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A place on the layer front: at a station, or between it and the next one.
struct FrontPlace {
  std::int32_t station = WallLine::none;
  /// Fractions of the distance to the next station: from this one, and from the next one; 0 and 1 at the
  /// station.
  double share = 0, rest = 1;

  bool valid() const { return station != WallLine::none; }
  bool at_station() const { return share == 0; }
};

/// The place of the column that stands there: at a foot of an inner line, that of WallLine::column_at().
FrontPlace place_of_column(const WallLine& line, const FrontPlace& place);
/// The places of both ends of an edge of the front, at feet of inner lines those of the run that the edge
/// lies on.
std::array<FrontPlace, 2> places_of_edge(const WallLine& line, const std::array<FrontPlace, 2>& ends);

/// Locates nodes of the mesh outside on the front.
class FrontPlaces {
 public:
  /// On fronts whose nodes have columns, i.e. not those of columns that stand on interfaces. `front` must
  /// outlive it.
  explicit FrontPlaces(const LayerFront& front) : FrontPlaces(front, false, false) {}
  /// On the fronts of columns that stand on interfaces.
  static FrontPlaces on_interface_fronts(const LayerFront& front) { return {front, true, false}; }
  /// On these interfaces, for nodes of the blocks on their other sides.
  static FrontPlaces on_interfaces(const LayerFront& front) { return {front, true, true}; }

  /// The place nearest to a node of the boundary; none if the boundary has no front. At a foot of an inner
  /// line it may be that of either side. O(log n).
  FrontPlace locate(Point node, BoundaryId boundary) const;
  std::array<FrontPlace, 2> locate_edge(Point from, Point to, BoundaryId boundary) const {
    return places_of_edge(front_->line, {locate(from, boundary), locate(to, boundary)});
  }

  /// Whether the second place follows the first one on the same run; on a loop each place follows all others.
  /// An edge of the mesh outside, with the domain to its left, runs along the front; in a coarse mesh it may
  /// span most stations of a small body.
  bool follows(const FrontPlace& first, const FrontPlace& second) const;
  const WallLine& line() const { return front_->line; }

 private:
  FrontPlaces(const LayerFront& front, bool on_interfaces, bool on_wall);
  Point point(std::int32_t i) const { return on_wall_ ? front_->line[i].wall : front_->points[i]; }
  struct OfBoundary {
    std::vector<std::int32_t> stations;  ///< where segments begin
    BoxTree tree;
  };

  const LayerFront* front_;
  bool on_wall_;
  IdVector<BoundaryId, OfBoundary> of_boundary_;
};

/// The place of the column of each mesh node that is on a front: on the rank that owns it and on ranks with
/// an edge there. *Collective.*
IdVector<NodeId, FrontPlace> places_of_nodes(const Communicator& comm, const FrontPlaces& places,
                                             const Mesh& mesh);

}  // namespace quadloop
