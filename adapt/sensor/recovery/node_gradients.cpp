#include "adapt/sensor/recovery/node_gradients.hpp"

#include "mesher/base/error.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::adapt {

namespace {

/// Integrals over cells.
struct Integral {
  double area = 0;
  Point gradient;
};

/// Integral over one cell by its boundary, with the field linear along each edge. Values are relative to the
/// first node, so that a constant field has exactly zero gradient and precision is kept far from the origin.
template <class Nodes>
Integral integral_over(const Nodes& nodes, const HaloMesh& halo, const IdVector<NodeId, double>& values) {
  const auto value = [&](NodeId node) { return values[node] - values[nodes[0]]; };
  const auto place = [&](NodeId node) { return halo.point(node) - halo.point(nodes[0]); };
  Integral sum;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const NodeId from = nodes[k], to = nodes[(k + 1) % nodes.size()];
    const Point edge = place(to) - place(from), normal{edge.y, -edge.x};
    sum.area += 0.5 * cross(place(from), place(to));
    sum.gradient = sum.gradient + 0.5 * (value(from) + value(to)) * normal;
  }
  return sum;
}

}  // namespace

std::vector<Point> node_gradients(const Communicator& comm, const Mesh& mesh,
                                  std::span<const double> values) {
  QUADLOOP_REQUIRE(values.size() == mesh.points.size(), "there must be one value for each node",
                   values.size(), mesh.points.size());
  const HaloMesh halo(comm, mesh);
  IdVector<NodeId, double> halo_values(std::vector<double>(values.begin(), values.end()));
  halo_values.resize(halo.points().size());
  halo.exchange().update(halo_values);

  IdVector<NodeId, Integral> round_node(mesh.owned_nodes);
  halo.for_each_cell([&](const auto& nodes) {  // in global order, so that all ranks sum alike
    const Integral cell = integral_over(nodes, halo, halo_values);
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) continue;
      Integral& sum = round_node[node];
      sum.area += cell.area;
      sum.gradient = sum.gradient + cell.gradient;
    }
  });

  std::vector<Point> gradients;
  for (const Integral& sum : round_node)
    gradients.push_back(sum.area > 0 ? (1 / sum.area) * sum.gradient : Point{});
  gradients.resize(halo.points().size());
  halo.exchange().update(gradients);
  gradients.resize(mesh.points.size());  // the mesh's own ghost copies come before those of the halo
  return gradients;
}

}  // namespace quadloop::adapt
