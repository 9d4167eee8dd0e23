#include "smoother/even_widths.hpp"

#include <vector>

#include "smoother/sweeps/coloured_sweeps.hpp"

namespace quadloop::smoother {

bool even_widths(const Communicator& comm, HaloMesh& mesh, BoundarySlide& slide,
                 std::span<const double> heights, int sweeps) {
  std::vector<NodeId> nodes;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (slide.freedom(node) == NodeFreedom::sliding && slide.lies_on(node, heights)) nodes.push_back(node);
  }
  const NodeStars stars(mesh, std::move(nodes), {});
  NodeFlags stale(mesh.points().size(), 1);
  ColouredSweeps coloured(comm, mesh, stars, stale);
  std::int64_t moves = 0;
  Star star;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Point> fixed = slide.widths_at_fixed(heights);
    moves += coloured.sweep(
        stars.all(), [](std::size_t) { return true; },
        [&](std::size_t i) {
          stars.gather(i, star);
          return slide.towards_middle(stars.nodes()[i], star, fixed);
        });
  }
  return comm.any(moves > 0);
}

}  // namespace quadloop::smoother
