#include "smoother/sweeper.hpp"

#include "smoother/colouring.hpp"
#include "smoother/node/untangle.hpp"

namespace quadloop {

Sweeper::Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, const BoundarySlide& slide,
                 Method method, Objective objective, double threshold)
    : comm_{comm},
      mesh_{mesh},
      stars_{stars},
      slide_{slide},
      objective_{objective},
      threshold_{threshold},
      solver_{make_node_solver(method)},
      moved_at_(mesh.points().size(), 0),
      visited_at_(stars.size(), -1),
      bad_(mesh.points().size(), 0) {
  const Colouring colouring = colour_stars(comm, mesh, stars);
  by_colour_.resize(colouring.count);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    by_colour_[colouring.colour_of[node(i)]].push_back(i);
  }
}

std::int64_t Sweeper::sweep() {
  find_bad();
  std::int64_t moves = 0;
  for (const auto& nodes : by_colour_) {
    ++clock_;
    for (const std::size_t i : nodes) {
      if (is_active(i) && is_stale(i)) moves += visit(i) ? 1 : 0;
    }
    share_moves();
  }
  return comm_.sum(moves);
}

/// Whether the node or one that it shares a cell with has moved since it was last visited.
bool Sweeper::is_stale(std::size_t i) const {
  bool stale = moved_at_[node(i)] >= visited_at_[i];
  stars_.for_each_neighbour(i, [&](NodeId other) { stale = stale || moved_at_[other] >= visited_at_[i]; });
  return stale;
}

/// Flags the nodes of cells above the threshold, of other ranks too.
void Sweeper::find_bad() {
  for (std::size_t i = 0; i < stars_.size(); ++i) {
    if (!is_stale(i)) continue;
    stars_.gather(i, star_);
    bad_[node(i)] = star_.worst_cost(mesh_.point(node(i))) > threshold_ ? 1 : 0;
  }
  mesh_.exchange().update(bad_);
}

bool Sweeper::is_active(std::size_t i) const {
  bool active = bad_[node(i)] != 0;
  stars_.for_each_neighbour(i, [&](NodeId other) { active = active || bad_[other] != 0; });
  return active;
}

bool Sweeper::visit(std::size_t i) {
  stars_.gather(i, star_);
  visited_at_[i] = clock_;
  const NodeId n = node(i);
  Point& p = mesh_.points()[n.value()];
  const auto better = better_place(n, p);
  if (!better) return false;
  p = *better;
  moved_at_[n] = clock_;
  return true;
}

std::optional<Point> Sweeper::better_place(NodeId n, Point p) {
  if (slide_.freedom(n) == NodeFreedom::sliding) return slide_.improve(n, star_, objective_);
  if (star_.cost(p, objective_).valid[0]) return solver_->improve(star_, p, objective_);
  return untangle(star_, p, objective_);
}

void Sweeper::share_moves() {
  const auto just_moved = [&](std::int32_t n) { return moved_at_[NodeId{n}] == clock_; };
  mesh_.exchange().update(mesh_.points(), just_moved);
  mesh_.exchange().update(moved_at_, just_moved);
}

}  // namespace quadloop
