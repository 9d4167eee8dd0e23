#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/mark.hpp"
#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// For each leaf of this rank's share the smallest edge length that the solver wants, the field's only
/// variable, at the nodes of its cells; 0 for leaves without cells. Throws InputError on all ranks for a size
/// that is not finite or not larger than 0, or where the tree is not this mesh's. *Collective.*
std::vector<double> leaf_sizes(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves,
                               const Field& size);

/// The level of the largest leaves whose edge is not over `size` (> 0), at most Quadrant::unit_level. Exact.
int level_for_size(double tree_edge, double size);

/// The mark of each leaf of this rank's share: refine where its edge is over its size, coarsen where twice
/// the edge is not; leaves without cells are kept. Local.
std::vector<Mark> mark_by_size(const TreeRecord& tree, std::span<const double> sizes);

}  // namespace quadloop
