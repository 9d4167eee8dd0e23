#include "adapt/sensor/solver_error.hpp"

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

namespace {

template <std::size_t width>
double area_of(const HaloMesh& halo, const std::array<NodeId, width>& nodes) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < width; ++i)
    twice +=
        cross(halo.point(nodes[i]) - halo.point(nodes[0]), halo.point(nodes[i + 1]) - halo.point(nodes[0]));
  return 0.5 * twice;
}

/// Nodal errors per area of the node, where each cell's area is divided equally among its nodes. At owned
/// nodes and ghost copies.
std::vector<double> per_area(const Communicator& comm, const Mesh& mesh, const std::vector<double>& errors) {
  const HaloMesh halo(comm, mesh);
  std::vector<double> areas(halo.points().size(), 0.0);
  halo.for_each_cell([&](const auto& nodes) {
    const double share = area_of(halo, nodes) / static_cast<double>(nodes.size());
    for (const NodeId node : nodes) areas[node.value()] += share;
  });
  for (std::size_t node = 0; node < static_cast<std::size_t>(mesh.owned_nodes); ++node)
    areas[node] = areas[node] > 0 ? errors[node] / areas[node] : 0;
  halo.exchange().update(areas);
  return areas;
}

}  // namespace

std::vector<double> error_densities(const Communicator& comm, const Mesh& mesh, const Field& field) {
  check_field(comm, mesh, field, FieldSign::not_negative);
  std::vector<double> densities = per_area(comm, mesh, field.column(0));
  densities.resize(mesh.points.size());  // the mesh's own ghost copies come before those of the halo
  return densities;
}

InterpolationError solver_error(const Communicator& comm, const Mesh& mesh, const Field& field) {
  check_field(comm, mesh, field, FieldSign::not_negative);
  InterpolationError error;
  for (const CellShape& shape : cell_shapes(mesh)) error.areas.push_back(shape.area);
  error.mean.resize(error.areas.size(), 0);
  if (field.cells.width() > 0) {
    error.mean = field.cells.column(0);
    for (std::size_t i = 0; i < error.mean.size(); ++i) error.mean[i] /= error.areas[i];
  } else {
    const std::vector<double> densities = per_area(comm, mesh, field.column(0));
    std::vector<double> corners(error.areas.size(), 0);
    for_each_cell_edge(mesh, [&](NodeId from, NodeId, std::int32_t cell) {
      error.mean[cell] += densities[from.value()];
      corners[cell] += 1;
    });
    for (std::size_t i = 0; i < corners.size(); ++i) error.mean[i] /= corners[i];
  }
  for (std::size_t i = 0; i < error.mean.size(); ++i) error.bends.push_back(error.mean[i] / error.areas[i]);
  return error;
}

}  // namespace quadloop::adapt
