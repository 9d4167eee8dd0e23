#include "smoother/even_widths.hpp"

#include <utility>
#include <vector>

#include "smoother/colouring.hpp"
#include "smoother/node_stars.hpp"

namespace quadloop {

namespace {

/// The places that decide whether a node has a better one.
std::vector<Point> places_in(const Star& star) {
  std::vector<Point> places;
  for (const StarCorner& corner : star.corners()) places.insert(places.end(), {corner.q, corner.r});
  return places;
}

}  // namespace

bool even_widths(const Communicator& comm, HaloMesh& mesh, const BoundarySlide& slide,
                 std::span<const double> heights, int sweeps) {
  std::vector<NodeId> nodes;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (slide.freedom(node) == NodeFreedom::sliding && slide.lies_on(node, heights)) nodes.push_back(node);
  }
  const NodeStars stars(mesh, std::move(nodes), {});
  const Colouring colouring = colour_stars(comm, mesh, stars);
  std::vector<std::vector<Point>> settled(stars.size());  // the star in which each node last stayed
  bool moved_ever = false;
  Star star;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::int8_t colour = 0; colour < colouring.count; ++colour) {
      NodeFlags moved(mesh.points().size(), 0);
      for (std::size_t i = 0; i < stars.size(); ++i) {
        const NodeId node = stars.nodes()[i];
        if (colouring.colour_of[node] != colour) continue;
        stars.gather(i, star);
        std::vector<Point> places = places_in(star);
        if (places == settled[i]) continue;
        const auto to = slide.towards_middle(node, star);
        settled[i] = to ? std::vector<Point>{} : std::move(places);
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
