#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

inline std::span<const Point> owned_points(const Mesh& mesh) {
  return std::span(mesh.points).first(mesh.owned_nodes);
}

/// The old side of a linear transfer.
struct LinearSource {
  const Mesh& mesh;
  const Field& field;  ///< with rows of ghosts
  Point centre;        ///< centre_of_nodes()
  const CurvePartition& shares;
  const BafflePlaces& baffles;
};

struct LinearRows {
  std::vector<double> values;
  std::int64_t outside = 0;  ///< nodes outside the old mesh, over all ranks
};

/// Rows at the owned nodes of a new mesh, evaluated at `places` (column_places()), by the rules of
/// transfer(). *Collective.*
LinearRows linear_rows(const Communicator& comm, const LinearSource& old, const Mesh& new_mesh,
                       std::span<const Point> places, Combine combine = combine_values);

}  // namespace quadloop::adapt
