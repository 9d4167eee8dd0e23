#pragma once

#include <span>
#include <vector>

#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The nodal values of a distributed mesh at any points: linear in each triangle (quads are split,
/// parts_of()), exactly those of a node at its place. Of several triangles at a point the one with the lowest
/// global number counts, so that values do not depend on the partition.
class PointValues {
 public:
  /// `field` has values at ghost nodes too; `centre`: centre_of_nodes(). All must outlive the object.
  /// *Collective.*
  PointValues(const Communicator& comm, const Mesh& mesh, const Field& field, Point centre,
              const CurvePartition& shares);

  /// Rows at places, and whether these are inside the mesh; elsewhere rows are 0.
  struct Answers {
    std::vector<double> values;
    std::vector<char> is_inside;
  };
  /// For this rank's places. O(cells) on each rank. *Collective.*
  Answers at(std::span<const Point> places, Combine combine = combine_values) const;

  const Mesh& mesh() const { return mesh_; }
  const Field& field() const { return field_; }
  Point centre() const { return centre_; }
  const CurvePartition& shares() const { return shares_; }
  /// Flags of owned nodes within the mesh (inner_nodes()).
  const NodeFlags& is_inner() const { return is_inner_; }

 private:
  const Communicator& comm_;
  const Mesh& mesh_;
  const Field& field_;
  Point centre_;  ///< determines how quadrilaterals are split
  const CurvePartition& shares_;
  NodeFlags is_inner_;
};

}  // namespace quadloop::adapt
