#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/sensor/indicator.hpp"
#include "adapt/sensor/telling_edges.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop::adapt {

/// Indicators from cell values: jumps across the edges between cells, or changes of gradients along edges.
class CellJumps {
 public:
  /// `mesh` and `edges` must outlive it. *Collective.*
  CellJumps(const Communicator& comm, const Mesh& mesh, const TellingEdges& edges, Indicator kind);

  /// Raises each cell's value to the largest indicator of its edges, for a variable with one value per local
  /// cell. *Collective.*
  void raise(const ScaledField& field, std::vector<double>& of_cells) const;

 private:
  void raise_by_jumps(const ScaledField& field, std::vector<double>& of_cells) const;
  void raise_by_bends(const ScaledField& field, std::vector<double>& of_cells) const;

  /// An edge of a local cell that has a cell on its other side.
  struct Pair {
    std::int32_t cell;
    double distance;  ///< between the two centroids
  };

  const Communicator& comm_;
  const Mesh& mesh_;
  const TellingEdges& edges_;
  Indicator kind_;
  CellsRoundNodes round_nodes_;
  CellOwners owners_;
  std::vector<std::int64_t> across_;  ///< global number of the other cell of each pair
  std::vector<Pair> pairs_;
};

}  // namespace quadloop::adapt
