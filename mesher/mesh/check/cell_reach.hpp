#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// For validate_geometry() only: the local mesh size, where the cells themselves may be fragments of larger
/// quadtree cells. Quadtree cell sizes change by at most half of their distance (largest gradation), so a
/// long cell nearby implies that quadtree cells here are not much smaller.
class CellReach {
 public:
  /// `mesh` must outlive the object; `longest` has the longest edge of each of this rank's cells, triangles
  /// first.
  CellReach(const Mesh& mesh, const std::vector<double>& longest) : mesh_{mesh}, longest_{longest} {}

  /// Returns the maximum of longest edge minus half the distance to the point, over nearby cells of this
  /// rank; 0 if none is nearby. The search stops at `enough` and extends to 16 times `enough` at most. Builds
  /// the index on first use.
  double size_at(Point p, double enough);

  /// Returns the longest edge of this rank's cells within `distance` of the point; 0 if there is none.
  double longest_within(Point p, double distance);

  /// A cell of this rank, by its number here, with its longest edge.
  struct Nearest {
    double squared_distance = std::numeric_limits<double>::infinity();  ///< to its bounding box
    std::int64_t cell = -1;
    double longest = 0;
  };
  /// Returns the cell whose bounding box is nearest, of equal ones the first.
  Nearest nearest(Point p);

 private:
  void build();
  std::span<const NodeId> nodes_of(std::int32_t cell) const;
  Box box_of_cell(std::int32_t cell) const;
  double largest_within(Point p, double distance, double slope) const;
  double distance_to(std::int32_t cell, Point p) const;

  const Mesh& mesh_;
  const std::vector<double>& longest_;
  BoxTree cells_;
};

/// A place at which the local mesh size is wanted.
struct ReachQuestion {
  Point place;
  double distance = 0;   ///< argument of size_at() or of longest_within()
  bool is_size = false;  ///< that of size_at()
};

/// Returns the answers to the root's questions on the root, over the cells of all ranks: the longest edge of
/// the nearest cell if none is nearby. Independent of the number of ranks, but for a size_at() beyond
/// `distance`, which is only known to be so large. *Collective.*
std::vector<double> answers_over(const Communicator& comm, const Mesh& mesh,
                                 const std::vector<double>& longest, std::vector<ReachQuestion> questions);

}  // namespace quadloop
