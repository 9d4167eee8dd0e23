#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/sensor/cell_share.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// Assigns cells to leaves: along the curve each leaf has the next triangles and the next quadrilaterals of
/// the mesh, as many as its record states. The partitions of leaves and of cells may differ.
class CellsOfLeaves {
 public:
  /// `leaves` are those of this rank and must outlive it. Throws InputError if the numbers of cells in tree
  /// and mesh differ. *Collective.*
  CellsOfLeaves(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves);

  /// The largest (smallest) value among each local leaf's cells; `of_cells` has one value per local cell,
  /// triangles first, then quadrilaterals. 0 for a leaf without cells. *Collective.*
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

}  // namespace quadloop::adapt
