#include "smoother/outline/nodes_on_curves.hpp"

#include <map>
#include <string>

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

namespace {

/// For the right side of each baffle its left side, on which the nodes of both are located, so that they move
/// to the same points, bit by bit.
std::map<std::string, std::string> left_sides(const Geometry& geometry) {
  const auto name_of = [&](std::int32_t s) { return geometry.boundary(geometry.boundary_of(s)).name; };
  std::map<std::string, std::string> found;
  for (std::int32_t s = 0; geometry.has_inner_lines() && s < geometry.size(); ++s) {
    if (geometry.returns(s)) found[name_of(s)] = name_of(geometry.twin(s));
  }
  return found;
}

}  // namespace

NodeFlags move_nodes_to_curves(const Communicator& comm, const Geometry& geometry, Mesh& mesh) {
  if (!geometry.has_curves()) return {};
  const Geometry chords = chords_of(geometry);
  const OutlinePath path(chords);
  const std::map<std::string, std::string> left_of = left_sides(geometry);
  const std::vector<Point> before = mesh.points;
  const HaloMesh halo(comm, mesh);
  for (const HaloEdge& edge : halo.boundary_edges()) {
    const std::string& name = mesh.boundaries[edge.boundary].name;
    const auto left = left_of.find(name);
    for (const NodeId node : {edge.from, edge.to}) {
      if (!halo.owns(node)) continue;
      const Point p = before[node.value()];
      const OutlinePlace place = path.locate(p, left == left_of.end() ? name : left->second);
      if (place.valid()) mesh.points[node.value()] = geometry.on_curve(place.segment, p);
    }
  }
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts).update(mesh.points);
  NodeFlags moved(mesh.points.size(), 0);
  for (const NodeId node : moved.ids()) moved[node] = mesh.point(node) != before[node.value()] ? 1 : 0;
  return moved;
}

}  // namespace quadloop::smoother
