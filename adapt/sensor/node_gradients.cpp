#include "adapt/sensor/node_gradients.hpp"

#include "mesher/base/error.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

namespace {

/// Integrals over cells.
struct Integral {
  double area = 0;
  Point gradient;
};

/// Of one cell, from its outline: the field is linear along each edge. Counted from the first node, so that a
/// constant field has no gradient at all and little is lost far from the origin.
template <class Nodes>
Integral integral_over(const Nodes& nodes, const HaloMesh& halo, std::span<const double> values) {
  const auto value = [&](NodeId node) { return values[node.value()] - values[nodes[0].value()]; };
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
  QUADLOOP_REQUIRE(values.size() == mesh.points.size(), "there must be one value for each node");
  const HaloMesh halo(comm, mesh);
  std::vector<double> halo_values(values.begin(), values.end());
  halo_values.resize(halo.points().size());
  halo.exchange().update(halo_values);

  std::vector<Integral> round_node(mesh.owned_nodes);
  halo.for_each_cell([&](const auto& nodes) {  // in global order, so that ranks add up alike
    const Integral cell = integral_over(nodes, halo, halo_values);
    for (const NodeId node : nodes) {
      if (node.value() >= mesh.owned_nodes) continue;
      Integral& sum = round_node[node.value()];
      sum.area += cell.area;
      sum.gradient = sum.gradient + cell.gradient;
    }
  });

  std::vector<Point> gradients(halo.points().size());
  for (std::size_t node = 0; node < round_node.size(); ++node) {
    if (round_node[node].area > 0) gradients[node] = (1 / round_node[node].area) * round_node[node].gradient;
  }
  halo.exchange().update(gradients);
  gradients.resize(mesh.points.size());  // the mesh's own copies come before the halo's
  return gradients;
}

}  // namespace quadloop
