#include "smoother/sweeps/coloured_sweeps.hpp"

#include "smoother/sweeps/colouring.hpp"

namespace quadloop::smoother {

ColouredSweeps::ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars,
                               NodeFlags& stale)
    : mesh_{mesh},
      stars_{stars},
      stale_{stale},
      colouring_{colour_stars(comm, mesh, stars)},
      by_colour_(colouring_.count),
      changed_(mesh.points().size(), 0),
      moved_(mesh.points().size(), 0) {}

std::vector<std::int32_t> ColouredSweeps::take_changed() {
  std::vector<std::int32_t> stars;
  for_each_flagged(changed_, [&](NodeId node) {
    changed_[node] = 0;
    if (const std::int32_t star = stars_.star_of(node); star >= 0) stars.push_back(star);
  });
  return stars;
}

void ColouredSweeps::look_again(NodeId node) {
  changed_[node] = 1;
  const bool was_stale = std::exchange(stale_[node], 1) != 0;
  if (!was_stale && colouring_.colour_of[node] > colour_ && mesh_.owns(node))
    woken_.push_back(stars_.star_of(node));
}

/// Flags the node and all nodes that share a cell with it for a new visit.
void ColouredSweeps::move(std::size_t i, Point to) {
  const NodeId node = stars_.nodes()[i];
  mesh_.points()[node.value()] = to;
  moved_[node] = 1;
  own_moves_.push_back(node);
  look_again(node);
  stars_.for_each_neighbour(i, [&](NodeId other) { look_again(other); });
}

void ColouredSweeps::share_moves() {
  struct Place {
    Point point;
    bool is_new;
  };
  mesh_.exchange().update_some(
      [&](std::int32_t n) {
        return Place{mesh_.points()[n], moved_[NodeId{n}] != 0};
      },
      [&](std::int32_t n, const Place& place) {
        if (!place.is_new) return;
        mesh_.points()[n] = mesh_.place(NodeId{n}, place.point);
        stars_.for_each_star_round(NodeId{n}, [&](std::int32_t star) { look_again(stars_.nodes()[star]); });
      });
  for (const NodeId node : own_moves_) moved_[node] = 0;
  own_moves_.clear();
}

}  // namespace quadloop::smoother
