#include "smoother/coloured_sweeps.hpp"

#include "smoother/colouring.hpp"

namespace quadloop {

ColouredSweeps::ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars)
    : mesh_{mesh}, stars_{stars}, moved_at_(mesh.points().size(), 0), visited_at_(stars.size(), -1) {
  const Colouring colouring = colour_stars(comm, mesh, stars);
  by_colour_.resize(colouring.count);
  for (std::size_t i = 0; i < stars.size(); ++i)
    by_colour_[colouring.colour_of[stars.nodes()[i]]].push_back(i);
}

bool ColouredSweeps::is_stale(std::size_t i) const {
  bool stale = moved_at_[stars_.nodes()[i]] >= visited_at_[i];
  stars_.for_each_neighbour(i, [&](NodeId other) { stale = stale || moved_at_[other] >= visited_at_[i]; });
  return stale;
}

void ColouredSweeps::move(std::size_t i, Point to) {
  const NodeId node = stars_.nodes()[i];
  mesh_.points()[node.value()] = to;
  moved_at_[node] = clock_;
}

void ColouredSweeps::share_moves() {
  const auto just_moved = [&](std::int32_t n) { return moved_at_[NodeId{n}] == clock_; };
  mesh_.exchange().update(mesh_.points(), just_moved);
  mesh_.exchange().update(moved_at_, just_moved);
}

}  // namespace quadloop
