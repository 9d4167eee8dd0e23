#include "mesher/mesh/check/worst_places.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/check/corner_range.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

/// The place of a value, and the cell there.
struct PlacedValue {
  double value = std::numeric_limits<double>::infinity();
  std::int64_t cell = std::numeric_limits<std::int64_t>::max();
  Point place;
};

/// Returns the place of the smallest value of all ranks, of equal ones that of the first cell. *Collective.*
Point place_of_smallest(const Communicator& comm, const PlacedValue& own) {
  PlacedValue smallest;
  for (const PlacedValue& found : comm.all_gather(own)) {
    if (std::pair(found.value, found.cell) < std::pair(smallest.value, smallest.cell)) smallest = found;
  }
  return smallest.place;
}

/// The worst of this rank's cells, the first of equal ones; numbered on this rank.
class WorstCells {
 public:
  WorstCells(const Mesh& mesh, const LayerPlaces& layers) : mesh_{mesh}, layers_{layers} {
    std::int64_t number = 0;
    mesh.for_each_cell([&](const auto& nodes) { look_at(nodes, number++); });
  }

  /// *Collective.*
  WorstPlaces over(const Communicator& comm) {
    const CellOwners owners(comm, mesh_);
    for (PlacedValue* found : {&smallest_angle_, &largest_angle_, &quality_}) {
      if (found->value < std::numeric_limits<double>::infinity()) found->cell = owners.number(found->cell);
    }
    return {place_of_smallest(comm, smallest_angle_), place_of_smallest(comm, largest_angle_),
            place_of_smallest(comm, quality_)};
  }

 private:
  template <std::size_t width>
  void look_at(const std::array<NodeId, width>& nodes, std::int64_t number) {
    if (!layers_.empty() && is_layer_cell(layers_, nodes)) return;
    const std::array<Point, width> cell = corners_of(mesh_, nodes);
    look_at_corners(cell, number);
    const double quality = quality_of(cell);
    if (quality >= quality_.value) return;
    Point sum;
    for (const Point p : cell) sum = sum + p;
    quality_ = {quality, number, 1.0 / width * sum};
  }

  template <std::size_t width>
  void look_at_corners(const std::array<Point, width>& cell, std::int64_t number) {
    for (std::size_t k = 0; k < width; ++k) {
      angles_.include({cell[(k + width - 1) % width], cell[k], cell[(k + 1) % width]});
      if (angles_.smallest() < smallest_angle_.value) smallest_angle_ = {angles_.smallest(), number, cell[k]};
      if (-angles_.largest() < largest_angle_.value) largest_angle_ = {-angles_.largest(), number, cell[k]};
    }
  }

  const Mesh& mesh_;
  const LayerPlaces& layers_;
  CornerRange angles_;
  PlacedValue smallest_angle_, quality_;
  PlacedValue largest_angle_;  ///< value: minus the angle
};

}  // namespace

WorstPlaces worst_places(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places) {
  return WorstCells(mesh, places).over(comm);
}

}  // namespace quadloop
