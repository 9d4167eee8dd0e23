#include "io/foam/foam_plane_file.hpp"

#include "io/foam/foam_file.hpp"
#include "io/model/extruded_mesh.hpp"
#include "io/stream/require_conforming.hpp"
#include "io/stream/stream_blocks.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop {

namespace {

/// Without the boundary edges that have cells on both sides. *Collective.*
Mesh without_interfaces(const Communicator& comm, const Mesh& mesh) {
  Mesh result = mesh;
  for (BoundaryEdges& boundary : result.boundaries) {
    for (auto& [from, to] : boundary.edges) std::swap(from, to);
  }
  const std::vector<std::int64_t> right = edge_cells(comm, result).of_boundary;
  auto at = right.begin();
  for (std::size_t b = 0; b < result.boundaries.size(); ++b) {
    auto& edges = result.boundaries[b].edges;
    edges.clear();
    for (const auto& edge : mesh.boundaries[b].edges) {
      if (*at++ == EdgeCells::none) edges.push_back(edge);
    }
  }
  return result;
}

}  // namespace

void write_foam_plane(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  const Communicator& comm = outputs.communicator();
  const Mesh plane = without_interfaces(comm, mesh.extruded()->plane);
  require_conforming(comm, plane, edge_cells(comm, plane), 0, path);
  ExtrudedMesh layer = extruded(plane, even_heights(1, 1), ExtrusionAxis::z);
  layer.blocks = mesh.extruded()->blocks;
  write_foam(outputs, MeshStream(comm, layer), path);
}

}  // namespace quadloop
