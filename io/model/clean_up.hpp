#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

/// Number of members of the groups from which the boundaries and blocks of a mesh were made; groups beyond
/// the end have none.
struct GroupSizes {
  std::vector<std::int64_t> of_boundaries, of_blocks;
};

/// Keeps one of several cells, with its values, or boundary faces with the same nodes: an element in several
/// groups occurs once per group in the file. That of the smallest group is kept, the first of equally small
/// ones. A warning names the groups.
void drop_repeated(FileMesh& mesh, const std::string& path, const GroupSizes& sizes = {});

/// Returns a flag for each node: whether a cell or a boundary face uses it.
std::vector<char> used_nodes(const FileMesh& mesh);

/// Removes nodes not used by a cell or a boundary face, without reordering. Rows of node values must be those
/// of the remaining nodes.
void drop_unused_nodes(FileMesh& mesh, const std::string& path);

/// Nodes of the zones of a file that are known to be equal.
struct NodeLinks {
  std::vector<std::array<std::int32_t, 2>> nodes;  ///< numbered over all zones, from 0
  std::set<std::array<std::size_t, 2>> zones;      ///< the lower one first: these list all their equal nodes
};

/// Merges all nodes that are linked, or at the same position, to the first of them, with its values.
/// `first_nodes` gives the first node of each zone of a file: nodes in zones that are linked are not merged
/// by their positions, nor are those at a position where one zone has several, as at a baffle.
void unite_nodes(FileMesh& mesh, std::span<const std::size_t> first_nodes = {}, const NodeLinks& links = {});

/// Removes boundary faces that occur twice: in a 3D mesh these lie between two of its zones.
void drop_inner_faces(FileMesh& mesh);

/// Keeps each edge between two blocks once: its first occurrence, with the cell of the smaller block on its
/// left. A file of several zones has it in both.
void keep_first_mentions(LoadedMesh& loaded);

/// Removes blocks without cells, and boundaries without faces.
void drop_empty_groups(FileMesh& mesh);

/// Makes the cells of each block contiguous, with their values.
void order_by_blocks(LoadedMesh& loaded);

/// Converts the plane mesh of a file to the program's conventions: cells counter-clockwise, consistently with
/// their neighbours (orient_cells; inverted ones are left to validate()), the cells of a block contiguous,
/// with their values, each boundary edge with its cell on the left, or between two blocks the one with the
/// smaller number. Edges inside a block become inner curves; boundaries without edges are removed; if no
/// boundary remains, all edges of one cell form the boundary "boundary". The result's warnings list the
/// changes, with the names of boundaries. Throws InputError for a mesh without cells, and for an edge that
/// belongs to no cell, with its location.
LoadedMesh plane_mesh(FileMesh mesh, const TextScanner& scan);

}  // namespace quadloop::io
