#include "adapt/sensor/target_size.hpp"

#include <algorithm>
#include <limits>

#include "adapt/sensor/cells_of_leaves.hpp"
#include "mesher/base/error.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

std::vector<double> leaf_sizes(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves,
                               const Field& size) {
  const CellsOfLeaves cells_of_leaves(comm, mesh, leaves);
  check_field(comm, mesh, size, FieldSign::positive);
  if (size.cells.width() > 0) return cells_of_leaves.smallest(comm, size.cells.column(0));
  const std::vector<double> values = with_ghosts(comm, mesh, size).column(0);
  std::vector<double> of_cells(mesh.cell_count(), std::numeric_limits<double>::infinity());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId, std::int32_t cell) {
    double& value = of_cells[cell];
    value = std::min(value, values[from.value()]);
  });
  return cells_of_leaves.smallest(comm, of_cells);
}

int level_for_size(double tree_edge, double size) {
  int level = 0;
  for (double edge = tree_edge; edge > size && level < Quadrant::unit_level; edge *= 0.5) ++level;
  return level;
}

std::vector<RefinementFlag> mark_by_size(const TreeRecord& tree, std::span<const double> sizes) {
  QUADLOOP_REQUIRE(sizes.size() == tree.leaves.size(), "there must be one size for each leaf", sizes.size(),
                   tree.leaves.size());
  std::vector<RefinementFlag> flags;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const LeafRecord& leaf = tree.leaves[i];
    const int wanted = has_cells(leaf) ? level_for_size(tree.attributes.tree_edge, sizes[i]) : leaf.level;
    flags.push_back(wanted > leaf.level   ? RefinementFlag::refine
                    : wanted < leaf.level ? RefinementFlag::coarsen
                                          : RefinementFlag::keep);
  }
  return flags;
}

}  // namespace quadloop::adapt
