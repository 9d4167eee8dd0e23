#include "smoother/sweeper.hpp"

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
      sweeps_(comm, mesh, stars),
      bad_(mesh.points().size(), 0) {}

std::int64_t Sweeper::sweep() {
  find_bad();
  return comm_.sum(sweeps_.sweep([&](std::size_t i) { return is_active(i); },
                                 [&](std::size_t i) { return better_place(i); }));
}

/// Flags the nodes of cells above the threshold, of other ranks too.
void Sweeper::find_bad() {
  for (std::size_t i = 0; i < stars_.size(); ++i) {
    if (!sweeps_.is_stale(i)) continue;
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

std::optional<Point> Sweeper::better_place(std::size_t i) {
  stars_.gather(i, star_);
  const Point p = mesh_.point(node(i));
  if (slide_.freedom(node(i)) == NodeFreedom::sliding) return slide_.improve(node(i), star_, objective_);
  if (star_.cost(p, objective_).valid[0]) return solver_->improve(star_, p, objective_);
  return untangle(star_, p, objective_);
}

}  // namespace quadloop
