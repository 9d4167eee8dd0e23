#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/sensor/cell_share.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Which cells are whose leaf's: along the curve each leaf has the next of the mesh's triangles and the next
/// of its quads, as many as its record says. The shares of leaves and of cells that a rank holds need not
/// meet.
class CellsOfLeaves {
 public:
  /// `leaves` is this rank's share and must outlive it. Throws InputError where the tree and the mesh differ
  /// in their numbers of cells. *Collective.*
  CellsOfLeaves(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves);

  /// The largest and the smallest value of each local leaf's cells, from a value for each of this rank's
  /// cells, its triangles, then its quads. 0 for a leaf without cells. *Collective.*
  std::vector<double> largest(const Communicator& comm, std::span<const double> of_cells) const;
  std::vector<double> smallest(const Communicator& comm, std::span<const double> of_cells) const;

 private:
  template <class Better>
  std::vector<double> best(const Communicator& comm, std::span<const double> of_cells,
                           const Better& better) const;

  std::span<const LeafRecord> leaves_;
  std::size_t own_triangles_;
  CellShare triangles_, quads_;
};

}  // namespace quadloop
