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

/// One part of a mesh, for one rank of a solver: a mesh of its own. Nodes and cells stand in the order of
/// their numbers in the whole. The boundaries are the whole's, in its order, with the edges that are here, in
/// its order; then one for each neighbour with which the part shares edges, named part_name(neighbour), of
/// the condition "interface": both parts have the same edges in the same order, each with itself to the left.
/// Of strips it has the columns that are here as a whole, each run of two or more as a strip of its own.
struct MeshPart {
  /// Another part that has nodes of this one.
  struct Neighbour {
    std::int32_t part = 0;
    std::vector<NodeId> nodes;  ///< the shared ones, in the order of their numbers in the whole: both parts'
    friend bool operator==(const Neighbour&, const Neighbour&) = default;
  };

  std::int32_t number = 0;                            ///< from 0
  Mesh mesh;                                          ///< all of its nodes count as owned
  std::vector<std::int64_t> nodes, triangles, quads;  ///< their numbers in the whole, from 0
  std::vector<std::int32_t> triangle_to_block, quad_to_block;
  std::vector<std::int32_t> owners;              ///< of each node: the lowest part that has it
  std::vector<std::vector<std::int64_t>> edges;  ///< for each boundary of the whole its edges' places there
  std::vector<Neighbour> neighbours;             ///< ascending
  std::optional<Field> field;                    ///< a row for each node, and for each cell
};

/// What is divided beside the mesh itself.
struct PartData {
  const Field* field = nullptr;  ///< rows of owned nodes, others may follow
  std::span<const std::int32_t> triangle_to_block = {},
                                quad_to_block = {};  ///< of this rank's cells; none: one block
};

/// The parts that this rank holds (rank_of_part), ascending; on all ranks together each part once. The same
/// parts on any number of ranks. *Collective.* Throws InputError where the mesh has nodes without a cell, a
/// boundary edge without one to its left, or a boundary named as parts are.
std::vector<MeshPart> make_parts(const Communicator& comm, const Mesh& mesh, const CellParts& cells,
                                 const PartData& data = {});

/// How good a partition is for a solver.
struct PartFigures {
  std::int64_t parts = 0;
  std::int64_t edge_cut = 0;  ///< inner edges between two parts
  double balance = 1;  ///< weight of the heaviest part by the mean; a cell weighs as many as it has edges
  std::int64_t fewest_cells = 0, most_cells = 0;
  std::int64_t shared_nodes = 0;  ///< nodes of more than one part
  std::int64_t most_neighbours = 0;
};

/// *Collective.*
PartFigures part_figures(const Communicator& comm, std::span<const MeshPart> parts);

}  // namespace quadloop
