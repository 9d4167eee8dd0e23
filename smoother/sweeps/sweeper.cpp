#include "smoother/sweeps/sweeper.hpp"

#include <span>

#include "smoother/node/untangle.hpp"

namespace quadloop {

Sweeper::Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, const BoundarySlide& slide,
                 const Rule& rule, const NodeFlags& bad, NodeFlags& stale)
    : comm_{comm},
      mesh_{mesh},
      stars_{stars},
      slide_{slide},
      rule_{rule},
      solver_{make_node_solver(rule.method)},
      sweeps_(comm, mesh, stars, stale),
      bad_(mesh.points().size(), 0),
      bad_near_(mesh.points().size(), 0) {
  if (!rule.angles) star_.leave_out_angles();
  for (const NodeId free : stars.nodes()) bad_[free] = bad[free];
  mesh.exchange().update(bad_);
  count_bad_near(NodeFlags(bad_.size(), 0));
}

std::int64_t Sweeper::sweep() {
  update_bad();
  ++done_;
  return comm_.sum(sweeps_.sweep([&](std::size_t i) { return bad_near_[node(i)] > 0; },
                                 [&](std::size_t i) { return better_place(i); },
                                 [&](std::span<const std::int32_t> order, std::size_t k) {
                                   slide_.fetch_ahead(stars_.nodes(), order, k);
                                 }));
}

/// Flags the nodes of cells above the threshold, of other ranks too. One that was visited and round which all
/// has stayed since keeps its flag, even where something moved in the sweep before it was visited; after the
/// open sweeps it loses that.
void Sweeper::update_bad() {
  const NodeFlags before = bad_;
  doubtful_.clear();
  for (std::int32_t i = 0; i < std::ssize(stars_); ++i) {
    const bool changed = sweeps_.take_changed(i);
    if (done_ == open_sweeps || (changed && sweeps_.is_stale(i))) doubtful_.push_back(i);
  }
  for (std::size_t k = 0; k < doubtful_.size(); ++k) {
    stars_.fetch_ahead(doubtful_, k);
    const std::int32_t i = doubtful_[k];
    bad_[node(i)] = stars_.costs_more(i, rule_.threshold) ? 1 : 0;
  }
  mesh_.exchange().update(bad_);
  count_bad_near(before);
}

/// Nodes have become bad, or good.
void Sweeper::count_bad_near(const NodeFlags& before) {
  for (std::size_t i = 0; i < stars_.size(); ++i) {
    const std::int32_t more = bad_[node(i)] - before[node(i)];
    if (more == 0) continue;
    bad_near_[node(i)] += more;
    stars_.for_each_neighbour(i, [&](NodeId other) { bad_near_[other] += more; });
  }
  for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes()}, NodeId{size32(bad_)})) {
    const std::int32_t more = bad_[copy] - before[copy];
    if (more != 0) stars_.for_each_star_round(copy, [&](std::size_t i) { bad_near_[node(i)] += more; });
  }
}

std::optional<Point> Sweeper::better_place(std::size_t i) {
  stars_.gather(i, star_);
  const Point p = mesh_.point(node(i));
  if (slide_.freedom(node(i)) == NodeFreedom::sliding)
    return slide_.improve(node(i), star_, rule_.objective, rule_.even_up_to);
  if (!rule_.tangled || star_.cost(p, rule_.objective).valid[0])
    return solver_->improve(star_, p, rule_.objective);
  return untangle(star_, p, rule_.objective);
}

}  // namespace quadloop
