#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/overlap/broken_field.hpp"
#include "adapt/transfer/overlap/triangle_overlap.hpp"
#include "mesher/geometry/box_tree.hpp"

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
  void set(std::size_t triangle, double area, std::span<const CoveredValue> row) {
    areas[triangle] = area;
    std::ranges::copy(row, values.begin() + triangle * width);
  }
};

/// Intersects new triangles with all old ones that they meet: the common refinement of both meshes
/// (supermesh) of Farrell, Piggott, Pain, Gorman and Wilson, "Conservative interpolation between unstructured
/// meshes via supermesh construction", Comput. Methods Appl. Mech. Engrg. 198 (2009). A pair is intersected
/// on the rank whose part of the plane contains the lower left corner of the intersection of their boxes.
/// Overlaps of triangles on opposite sides of a baffle do not count. Sums are ordered by the numbers of the
/// old triangles: the same bits on any number of ranks.
class OldTriangles {
 public:
  /// Sends the old triangles to the ranks whose parts of the plane they meet. `comm`, `shares` and `baffles`
  /// must outlive the object. *Collective.*
  OldTriangles(const Communicator& comm, const CurvePartition& shares, const BrokenField& field,
               const BafflePlaces* baffles = nullptr);

  /// Integrals over local new triangles. *Collective.*
  OverlapIntegrals integrate(std::span<const std::array<Point, 3>> new_triangles);

 private:
  struct Parts;
  void cut(const std::array<Point, 3>& triangle, std::int64_t item, int rank, OverlapIntegrals& own,
           Parts& parts);
  void look_up(const Box& box);
  bool is_mine(const Box& a, const Box& b) const;
  void fill(std::size_t old, const std::array<Point, 3>& cut, const TriangleOverlap& overlap,
            double smaller_area);
  void add_up(const Parts& parts, OverlapIntegrals& integrals) const;

  const Communicator& comm_;
  const CurvePartition& shares_;
  const BafflePlaces* baffles_;  ///< null: there are none
  BrokenField field_;            ///< of the triangles that meet this rank's part of the plane
  BoxTree tree_;
  Box last_;                              ///< the box of the last look_up()
  std::vector<int> meeting_;              ///< the ranks whose parts it meets
  std::vector<std::int32_t> candidates_;  ///< the old triangles that it meets
  std::vector<CoveredValue> row_;
};

}  // namespace quadloop::adapt
