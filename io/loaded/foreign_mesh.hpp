#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/loaded/loaded_mesh.hpp"
#include "io/text/name_index.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop {

/// A boundary edge as another program lists it, in either direction.
struct ForeignEdge {
  std::array<NodeId, 2> nodes;
  std::int32_t boundary = 0;  ///< index into loaded.mesh.boundaries
  std::size_t place = 0;      ///< in the file's text, for a refusal
};

/// A mesh of another program on its way in. Until finish() cells may run either way round and blocks may be
/// mixed; boundaries are there by name, their edges stand in `edges`.
struct ForeignMesh {
  LoadedMesh loaded;
  std::vector<ForeignEdge> edges;
  NameIndex boundary_names, block_names;  ///< of loaded.mesh.boundaries, and of loaded.block_names

  /// The index of the boundary or block of that name, which is added where there is none.
  std::int32_t boundary_named(const std::string& name);
  std::int32_t block_named(const std::string& name);

  void add_triangle(const std::array<NodeId, 3>& nodes, std::int32_t block) {
    loaded.mesh.triangles.push_back(nodes);
    loaded.triangle_to_block.push_back(block);
  }
  void add_quad(const std::array<NodeId, 4>& nodes, std::int32_t block) {
    loaded.mesh.quads.push_back(nodes);
    loaded.quad_to_block.push_back(block);
  }
};

/// How many members the groups have that the boundaries and blocks of a mesh were made from, by number; those
/// behind the end have none.
struct GroupSizes {
  std::vector<std::int64_t> of_boundaries, of_blocks;
};

/// Keeps one of cells, with its values, and of edges that have the same nodes: an element that belongs to
/// several groups stands once for each. It is the one of the smallest group, the first where several are as
/// small. A warning names the groups.
void drop_repeated(ForeignMesh& foreign, const std::string& path, const GroupSizes& sizes = {});

/// Drops nodes that neither a cell nor an edge names; the others keep their order.
void drop_unused_nodes(ForeignMesh& foreign, const std::string& path);

/// Puts the cells of a block one after another, with their values.
void order_by_blocks(LoadedMesh& loaded);

/// What this program calls a mesh: cells counter-clockwise as their neighbours have it (orient_cells;
/// inverted ones are validate()'s), the cells of a block one after another with their values, each boundary
/// edge with its cell to the left, or between two blocks the one with the smaller number. Edges inside a
/// block are inner curves; boundaries without edges are left out; where no boundary is left, all edges of one
/// cell make up the boundary "boundary". What was changed or left out is said in the result's warnings, with
/// the names of boundaries. Refuses a mesh without cells, and by place an edge that no cell has.
LoadedMesh finish(ForeignMesh foreign, const TextScanner& scan);

}  // namespace quadloop
