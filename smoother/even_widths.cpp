#include "smoother/even_widths.hpp"

#include "smoother/colouring.hpp"
#include "smoother/node_stars.hpp"

namespace quadloop {

bool even_widths(const Communicator& comm, HaloMesh& mesh, const BoundarySlide& slide,
                 std::span<const char> segments, int sweeps) {
  std::vector<NodeId> nodes;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (slide.freedom(node) == NodeFreedom::sliding && slide.lies_on(node, segments)) nodes.push_back(node);
  }
  const NodeStars stars(mesh, std::move(nodes), {});
  const Colouring colouring = colour_stars(comm, mesh, stars);
  bool moved_ever = false;
  Star star;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::int8_t colour = 0; colour < colouring.count; ++colour) {
      NodeFlags moved(mesh.points().size(), 0);
      for (std::size_t i = 0; i < stars.size(); ++i) {
        const NodeId node = stars.nodes()[i];
        if (colouring.colour_of[node] != colour) continue;
        stars.gather(i, star);
        const auto to = slide.towards_middle(node, star);
        if (!to) continue;
        mesh.points()[node.value()] = *to;
        moved[node] = 1;
        moved_ever = true;
      }
      mesh.exchange().update(mesh.points(), [&](std::int32_t n) { return moved[NodeId{n}] != 0; });
    }
  }
  return comm.any(moved_ever);
}

}  // namespace quadloop
