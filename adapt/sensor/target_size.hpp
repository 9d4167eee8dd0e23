#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/mark.hpp"
#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// For each local leaf the smallest edge length that the solver requests (the field's only variable) at the
/// nodes of its cells; 0 for leaves without cells. Throws InputError on all ranks for a size that is not
/// finite or not positive, or if the tree does not belong to this mesh. *Collective.*
std::vector<double> leaf_sizes(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves,
                               const Field& size);

/// The level of the largest leaves with edges of at most `size` (> 0), at most Quadrant::unit_level. Exact.
int level_for_size(double tree_edge, double size);

/// The mark of each local leaf: refine if its edge exceeds its size, coarsen if twice the edge does not;
/// leaves without cells are kept. Local.
std::vector<RefinementFlag> mark_by_size(const TreeRecord& tree, std::span<const double> sizes);

}  // namespace quadloop::adapt
