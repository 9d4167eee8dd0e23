#include "smoother/sweeps/coloured_sweeps.hpp"

#include <utility>

#include "smoother/sweeps/colouring.hpp"

namespace quadloop {

ColouredSweeps::ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars,
                               NodeFlags& stale)
    : mesh_{mesh},
      stars_{stars},
      stale_{stale},
      is_changed_(stars.size(), 0),
      moved_(mesh.points().size(), 0) {
  const Colouring colouring = colour_stars(comm, mesh, stars);
  by_colour_.resize(colouring.count);
  for (std::int32_t i = 0; i < std::ssize(stars); ++i)
    by_colour_[colouring.colour_of[stars.nodes()[i]]].push_back(i);
}

std::vector<std::int32_t> ColouredSweeps::take_changed() {
  std::vector<std::int32_t> changed;
  for (std::int32_t i = 0; i < std::ssize(is_changed_); ++i) {
    if (std::exchange(is_changed_[i], 0) != 0) changed.push_back(i);
  }
  return changed;
}

void ColouredSweeps::move(std::size_t i, Point to) {
  const NodeId node = stars_.nodes()[i];
  mesh_.points()[node.value()] = to;
  moved_[node] = 1;
  own_moves_.push_back(node);
  say_moved(node);
}

/// Who sees the node is to be visited again, itself among them.
void ColouredSweeps::say_moved(NodeId node) {
  const auto look_again = [&](std::int32_t star) {
    stale_[stars_.nodes()[star]] = 1;
    is_changed_[star] = 1;
  };
  if (const std::int32_t own = stars_.star_of(node); own >= 0) look_again(own);
  stars_.for_each_star_round(node, look_again);
}

void ColouredSweeps::share_moves() {
  const auto just_moved = [&](std::int32_t n) { return moved_[NodeId{n}] != 0; };
  mesh_.exchange().update(mesh_.points(), just_moved);
  mesh_.exchange().update(moved_, just_moved);
  for (const NodeId node : own_moves_) moved_[node] = 0;
  own_moves_.clear();
  for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes()}, NodeId{size32(moved_)})) {
    if (moved_[copy] != 0) say_moved(copy);
    moved_[copy] = 0;
  }
}

}  // namespace quadloop
