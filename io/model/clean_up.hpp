#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop {

/// How many members the groups have that the boundaries and blocks of a mesh were made from, by number; those
/// behind the end have none.
struct GroupSizes {
  std::vector<std::int64_t> of_boundaries, of_blocks;
};

/// Keeps one of the cells, with its values, and one of the boundary faces that have the same nodes: an
/// element that belongs to several groups is in the file once for each. The one of the smallest group is
/// kept, the first where several are as small. A warning names the groups.
void drop_repeated(FileMesh& mesh, const std::string& path, const GroupSizes& sizes = {});

/// Which nodes a cell or a boundary face names.
std::vector<char> used_nodes(const FileMesh& mesh);

/// Drops nodes that neither a cell nor a boundary face names; the others keep their order. Rows of
/// node values must be those of the nodes that stay.
void drop_unused_nodes(FileMesh& mesh, const std::string& path);

/// Makes one node of all nodes at the same place: the first, with its values. Where `first_nodes` say where
/// the nodes of each zone of a file begin, a node stays that lies in the same zone as the first.
void unite_nodes(FileMesh& mesh, std::span<const std::size_t> first_nodes = {});

/// Drops blocks without cells, and boundaries without faces.
void drop_empty_groups(FileMesh& mesh);

/// Puts the cells of a block one after another, with their values.
void order_by_blocks(LoadedMesh& loaded);

/// The plane mesh of a file as this program defines one: cells counter-clockwise as their neighbours have it
/// (orient_cells; inverted ones are validate()'s), the cells of a block one after another with their values,
/// each boundary edge with its cell to the left, or between two blocks the one with the smaller number. Edges
/// inside a block are inner curves; boundaries without edges are left out; where no boundary is left, all
/// edges of one cell make up the boundary "boundary". What was changed or left out is said in the result's
/// warnings, with the names of boundaries. Refuses a mesh without cells, and by place an edge that no cell
/// has.
LoadedMesh plane_mesh(FileMesh mesh, const TextScanner& scan);

}  // namespace quadloop
