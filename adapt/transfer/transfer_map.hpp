#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::adapt {

/// Where a new mesh comes from: for each of its owned nodes the nodes of the old mesh that the linear
/// transfer() takes its values from, by their global numbers, with their weights. All functions are
/// *collective*.
class TransferMap {
 public:
  static constexpr std::size_t most = 3;  ///< old nodes of a new one
  using Nodes = std::array<GlobalNodeId, most>;
  using Weights = std::array<double, most>;

  /// `comm` must outlive the object. Throws InputError if the numbers of blocks differ.
  TransferMap(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh);

  /// Not valid beyond the number of nodes that are used, whose weights are 0.
  const std::vector<Nodes>& nodes() const { return nodes_; }
  /// Sum up to 1 at each node.
  const std::vector<Weights>& weights() const { return weights_; }
  /// For each owned node the old node at the same position, whose value it gets; not valid: a new node.
  const std::vector<GlobalNodeId>& same() const { return same_; }
  /// For each cell of this rank, triangles, then quads, the global number (CellOwners) of the old cell with
  /// the same corners (find_equal_cells()); -1: a new cell.
  const std::vector<std::int64_t>& same_cells() const { return same_cells_; }

  /// From rows of `width` values at the owned nodes of the old mesh those at nodes(): `most` rows for each
  /// owned node of the new mesh, 0 where there is no node.
  std::vector<double> rows(const std::vector<double>& values, std::size_t width) const;
  /// Their weighted sums: linear interpolation.
  std::vector<double> interpolate(const std::vector<double>& values, std::size_t width) const;

 private:
  void find_same_nodes(const Mesh& old_mesh, const Mesh& new_mesh);
  void find_same_cells(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh);

  const Communicator& comm_;
  NodeOwners owners_;  ///< of the old nodes
  std::vector<Nodes> nodes_;
  std::vector<Weights> weights_;
  std::vector<GlobalNodeId> same_;
  std::vector<std::int64_t> same_cells_;
};

}  // namespace quadloop::adapt
