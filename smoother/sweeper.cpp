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
      bad_(mesh.points().size(), 0),
      moved_(mesh.points().size(), 0),
      bad_near_(stars.size(), 0),
      stale_(stars.size(), 1),
      unmeasured_(stars.size(), 1) {
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
    for (const std::size_t i : nodes) {
      if (stale_[i] != 0 && bad_near_[i] > 0) moves += visit(i) ? 1 : 0;
    }
    share_moves();
  }
  return comm_.sum(moves);
}

/// Flags the nodes of cells above the threshold, of other ranks too. One that was visited and round which all
/// has stayed since keeps its flag, even where something moved in the sweep before it was visited.
void Sweeper::find_bad() {
  const NodeFlags before = bad_;
  for (std::size_t i = 0; i < stars_.size(); ++i) {
    if (stale_[i] == 0 || unmeasured_[i] == 0) continue;
    unmeasured_[i] = 0;
    stars_.gather(i, star_);
    bad_[node(i)] = star_.worst_cost(mesh_.point(node(i))) > threshold_ ? 1 : 0;
  }
  mesh_.exchange().update(bad_);
  for (const NodeId node : bad_.ids()) {
    if (bad_[node] != before[node]) count_bad_near(node);
  }
}

/// A node has become bad, or good.
void Sweeper::count_bad_near(NodeId node) {
  const std::int32_t more = bad_[node] != 0 ? 1 : -1;
  if (const std::int32_t own = stars_.star_of(node); own >= 0) bad_near_[own] += more;
  stars_.for_each_star_round(node, [&](std::int32_t star) { bad_near_[star] += more; });
}

bool Sweeper::visit(std::size_t i) {
  stars_.gather(i, star_);
  stale_[i] = 0;
  const NodeId n = node(i);
  Point& p = mesh_.points()[n.value()];
  const auto better = better_place(n, p);
  if (!better) return false;
  p = *better;
  moved_[n] = 1;
  moves_.push_back(n);
  say_moved(n);
  return true;
}

/// Who sees the node is to be looked at again, itself among them.
void Sweeper::say_moved(NodeId n) {
  const auto look_again = [&](std::int32_t star) { stale_[star] = unmeasured_[star] = 1; };
  if (const std::int32_t own = stars_.star_of(n); own >= 0) look_again(own);
  stars_.for_each_star_round(n, look_again);
}

std::optional<Point> Sweeper::better_place(NodeId n, Point p) {
  if (slide_.freedom(n) == NodeFreedom::sliding) return slide_.improve(n, star_, objective_);
  if (star_.cost(p, objective_).valid[0]) return solver_->improve(star_, p, objective_);
  return untangle(star_, p, objective_);
}

void Sweeper::share_moves() {
  const auto just_moved = [&](std::int32_t n) { return moved_[NodeId{n}] != 0; };
  mesh_.exchange().update(mesh_.points(), just_moved);
  mesh_.exchange().update(moved_, just_moved);
  for (const NodeId n : moves_) moved_[n] = 0;
  moves_.clear();
  for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes()}, NodeId{size32(moved_)})) {
    if (moved_[copy] != 0) say_moved(copy);
    moved_[copy] = 0;
  }
}

}  // namespace quadloop
