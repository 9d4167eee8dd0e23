#pragma once

#include <array>
#include <span>
#include <vector>

#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/overlap/broken_field.hpp"

namespace quadloop::adapt {

/// Area of a triangle with counter-clockwise corners.
constexpr double area_of(const std::array<Point, 3>& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }

/// Integrals of one variable over the part of a triangle that another mesh covers.
struct CoveredValue {
  double integral = 0;
  Point slope;                       ///< integral of the gradient
  double smallest = 0, largest = 0;  ///< at the corners of the covering triangles
};

/// Integrals of an old field over each local new triangle.
struct OverlapIntegrals {
  std::size_t width = 0;
  std::vector<double> areas;         ///< covered area of each triangle
  std::vector<CoveredValue> values;  ///< `width` entries for each triangle; undefined where the area is 0

  const CoveredValue& value(std::size_t triangle, std::size_t variable) const {
    return values[triangle * width + variable];
  }
};

/// Intersects each new triangle with all old ones that it meets: the common refinement of both meshes
/// (supermesh) of Farrell, Piggott, Pain, Gorman and Wilson, "Conservative interpolation between unstructured
/// meshes via supermesh construction", Comput. Methods Appl. Mech. Engrg. 198 (2009). A pair is intersected
/// on the rank whose part of the plane contains the lower left corner of the intersection of their boxes.
/// Overlaps of triangles on opposite sides of a baffle do not count. Sums are ordered by the numbers of the
/// old triangles: the same bits on any number of ranks. *Collective.*
OverlapIntegrals integrate_overlaps(const Communicator& comm, const CurvePartition& shares,
                                    const BrokenField& old_field,
                                    std::span<const std::array<Point, 3>> new_triangles,
                                    const BafflePlaces* baffles = nullptr);

}  // namespace quadloop::adapt
