#include "smoother/sweeps/coloured_sweeps.hpp"

#include "smoother/sweeps/colouring.hpp"

namespace quadloop {

ColouredSweeps::ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars,
                               NodeFlags& stale)
    : mesh_{mesh},
      stars_{stars},
      stale_{stale},
      changed_(mesh.points().size(), 0),
      moved_(mesh.points().size(), 0) {
  const Colouring colouring = colour_stars(comm, mesh, stars);
  by_colour_.resize(colouring.count);
  colours_.reserve(stars.size());
  for (const NodeId node : stars.nodes()) colours_.push_back(colouring.colour_of[node]);
}

/// Who sees the node is to be visited again, itself among them.
void ColouredSweeps::move(std::size_t i, Point to) {
  const NodeId node = stars_.nodes()[i];
  mesh_.points()[node.value()] = to;
  moved_[node] = 1;
  own_moves_.push_back(node);
  look_again(node);
  stars_.for_each_neighbour(i, [&](NodeId other) { look_again(other); });
}

void ColouredSweeps::share_moves() {
  const auto just_moved = [&](std::int32_t n) { return moved_[NodeId{n}] != 0; };
  mesh_.exchange().update(mesh_.points(), just_moved);
  mesh_.exchange().update(moved_, just_moved);
  for (const NodeId node : own_moves_) moved_[node] = 0;
  own_moves_.clear();
  for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes()}, NodeId{size32(moved_)})) {
    if (moved_[copy] != 0)
      stars_.for_each_star_round(copy, [&](std::int32_t star) { look_again(stars_.nodes()[star]); });
    moved_[copy] = 0;
  }
}

}  // namespace quadloop
