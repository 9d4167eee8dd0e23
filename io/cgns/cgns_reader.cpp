#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/model/serialize_mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

namespace {

/// Keeps each edge between two zones once: its first occurrence, with the cell of the smaller block on its
/// left.
void keep_first_mentions(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  const EdgeTable table(mesh);
  std::set<std::array<NodeId, 2>> taken;
  for (BoundaryEdges& boundary : mesh.boundaries) {
    std::erase_if(boundary.edges, [&](std::array<NodeId, 2>& edge) {
      const std::int32_t left = table.cell_left_of(edge[0], edge[1]),
                         right = table.cell_left_of(edge[1], edge[0]);
      if (left < 0 || right < 0) return false;
      if (block_of_cell(loaded, right) < block_of_cell(loaded, left)) std::swap(edge[0], edge[1]);
      return !taken.insert(edge).second;
    });
  }
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
}

}  // namespace

MeshOfFile read_cgns(const std::string& path) {
  FileMesh mesh = read_separately<FileMesh>("cgns", path);
  require_consistent(mesh, path);
  if (mesh.dimension == 3) return mesh;
  LoadedMesh loaded = loaded_mesh_of(std::move(mesh));
  if (loaded.blocks > 1) keep_first_mentions(loaded);
  return loaded;
}

}  // namespace quadloop::io
