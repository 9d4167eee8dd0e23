#include "smoother/outline/nodes_on_curves.hpp"

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::smoother {

Geometry chords_of(const Geometry& geometry) {
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v)
      builder.add(geometry.point(v), geometry.boundary_of(v), {}, geometry.returns(v));
    builder.end_loop();
  }
  return std::move(builder).geometry(geometry.boundaries());
}

NodeFlags move_nodes_to_curves(const Communicator& comm, const Geometry& geometry, Mesh& mesh) {
  if (!geometry.has_curves()) return {};
  const Geometry chords = chords_of(geometry);
  const OutlinePath path(chords);
  const std::vector<Point> before = mesh.points;
  const HaloMesh halo(comm, mesh);
  for (const HaloEdge& edge : halo.boundary_edges()) {
    for (const NodeId node : {edge.from, edge.to}) {
      if (!halo.owns(node)) continue;
      const Point p = before[node.value()];
      const OutlinePlace place = path.locate(p, mesh.boundaries[edge.boundary].name);
      if (place.valid()) mesh.points[node.value()] = geometry.on_curve(place.segment, p);
    }
  }
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts).update(mesh.points);
  NodeFlags moved(mesh.points.size(), 0);
  for (const NodeId node : moved.ids()) moved[node] = mesh.point(node) != before[node.value()] ? 1 : 0;
  return moved;
}

}  // namespace quadloop::smoother
