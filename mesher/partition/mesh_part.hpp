#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/part_names.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// One partition of a mesh, for one rank of a solver, as a mesh of its own. Nodes and cells are in the order
/// of their numbers in the whole mesh. Its boundaries are those of the whole mesh, in its order, with the
/// edges of this part, in its order; then one for each neighbour with shared edges, named
/// part_name(neighbour), with condition "interface": both parts have the same edges in the same order, each
/// with itself on the left, except that an edge between two blocks that is a boundary edge is a boundary edge
/// of the part to its left; then the inner lines that have edges with both cells in this part. Of strips it
/// has the complete columns in this part, each run of two or more as a strip of its own. It has no pairs.
struct MeshPart {
  /// Another part that shares nodes with this one.
  struct Neighbour {
    std::int32_t part = 0;
    /// Shared nodes, in the order of their numbers in the whole mesh, which is the same in both parts.
    std::vector<NodeId> nodes;
    friend bool operator==(const Neighbour&, const Neighbour&) = default;
  };

  std::int32_t number = 0;  ///< from 0
  Mesh mesh;                ///< all of its nodes count as owned
  /// Numbers in the whole mesh, from 0. Its cells are numbered block by block, as files store them.
  std::vector<std::int64_t> nodes, triangles, quads;
  std::vector<std::int32_t> owners;  ///< for each node: the lowest part that has it
  /// For each boundary of the whole mesh that is no inner line: numbers of its edges there.
  std::vector<std::vector<std::int64_t>> edges;
  std::vector<Neighbour> neighbours;  ///< ascending
  std::optional<Field> field;         ///< values of all nodes, and of all cells
};

/// Returns the parts held by this rank (rank_of_part), ascending; over all ranks each part occurs once. The
/// parts do not depend on the number of ranks. `field` has rows of owned nodes; further rows are ignored.
/// Throws InputError if the mesh has a node without a cell, a boundary edge without a cell on its left, or a
/// boundary with the name of a part interface. *Collective.*
std::vector<MeshPart> make_parts(const Communicator& comm, const Mesh& mesh, const CellParts& cells,
                                 const Field* field = nullptr);

/// Quality of a partition.
struct PartStatistics {
  std::int64_t parts = 0;
  std::int64_t edge_cut = 0;  ///< number of inner edges between two parts
  /// Largest weight of a part over the mean; the weight of a cell is its number of edges.
  double balance = 1;
  std::int64_t fewest_cells = 0, most_cells = 0;
  std::int64_t shared_nodes = 0;  ///< number of nodes in more than one part
  std::int64_t most_neighbours = 0;
};

/// *Collective.*
PartStatistics part_statistics(const Communicator& comm, std::span<const MeshPart> parts);

}  // namespace quadloop
