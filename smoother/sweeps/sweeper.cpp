#include "smoother/sweeps/sweeper.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "smoother/node/untangle.hpp"

namespace quadloop::smoother {

Sweeper::Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, BoundarySlide& slide,
                 const Rule& rule, const NodeFlags& bad, NodeFlags& stale)
    : comm_{comm},
      mesh_{mesh},
      stars_{stars},
      slide_{slide},
      rule_{rule},
      solver_{make_node_solver(rule.method)},
      any_quads_{comm.any(mesh.has_quads())},
      sweeps_(comm, mesh, stars, stale),
      bad_(mesh.points().size(), 0) {
  if (!rule.angles) star_.leave_out_angles();
  for (const NodeId free : stars.nodes()) bad_[free] = bad[free];
  mesh.exchange().update(bad_);
}

std::int64_t Sweeper::sweep() {
  const auto visit = [&](const std::vector<std::int32_t>& stars) {
    return comm_.sum(sweeps_.sweep(
        stars, [&](std::size_t i) { return is_near_bad(i); }, [&](std::size_t i) { return better_place(i); },
        [&](std::span<const std::int32_t> order, std::size_t k) {
          slide_.fetch_ahead(stars_.nodes(), order, k);
        }));
  };
  if (done_++ == 0) return visit(stars_.all());
  return visit(update_bad());
}

/// Flags the nodes of cells above the threshold, ghost copies included. Returns a superset of the stars that
/// are stale and near a bad node: those that have changed, and those whose node has become bad.
std::vector<std::int32_t> Sweeper::update_bad() {
  const std::vector<std::int32_t> changed = sweeps_.take_changed(), doubtful = doubtful_among(changed);
  const std::vector<char> ghosts_before(bad_.begin() + mesh_.owned_nodes(), bad_.end());
  std::vector<NodeId> turned_bad;
  for (std::size_t k = 0; k < doubtful.size(); ++k) {
    stars_.fetch_corners_ahead(doubtful, k);
    stars_.fetch_points_ahead(doubtful, k);
    const NodeId node = this->node(doubtful[k]);
    const bool was_bad = bad_[node] != 0, is_bad = stars_.costs_more(doubtful[k], rule_.threshold);
    bad_[node] = is_bad ? 1 : 0;
    if (is_bad && !was_bad) turned_bad.push_back(node);
  }
  mesh_.exchange().update(bad_);
  for (const NodeId copy : ids_between(NodeId{mesh_.owned_nodes()}, NodeId{size32(bad_)})) {
    if (bad_[copy] != 0 && ghosts_before[copy.value() - mesh_.owned_nodes()] == 0) turned_bad.push_back(copy);
  }
  std::vector<std::int32_t> waiting;
  std::ranges::set_union(changed, stars_near(turned_bad), std::back_inserter(waiting));
  return waiting;
}

/// The stars whose flags have to be recomputed. A star that was visited and has not changed since keeps its
/// flag, even if something moved in the same sweep before the visit. After the open sweeps its flag is
/// recomputed. With quadrilaterals all flags are: moved lines may have made a cell bad unnoticed, and a node
/// does not see the opposite corner of a quadrilateral.
std::vector<std::int32_t> Sweeper::doubtful_among(const std::vector<std::int32_t>& changed) {
  const bool are_over = done_ == open_sweeps + 1;
  if (are_over && any_quads_) return stars_.all();
  std::vector<std::int32_t> doubtful;
  for (const std::int32_t i : changed) (sweeps_.is_stale(i) ? doubtful : passed_over_).push_back(i);
  if (are_over) doubtful.insert(doubtful.end(), passed_over_.begin(), passed_over_.end());
  return doubtful;
}

/// The stars of these nodes and of nodes that share a cell with one, ascending.
std::vector<std::int32_t> Sweeper::stars_near(const std::vector<NodeId>& turned_bad) const {
  std::vector<std::int32_t> near;
  const auto add = [&](std::int32_t star) {
    if (star >= 0) near.push_back(star);
  };
  for (const NodeId node : turned_bad) {
    if (!mesh_.owns(node)) {
      stars_.for_each_star_round(node, add);
      continue;
    }
    add(stars_.star_of(node));
    stars_.for_each_neighbour(stars_.star_of(node), [&](NodeId other) { add(stars_.star_of(other)); });
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

bool Sweeper::is_near_bad(std::size_t i) const {
  char near = bad_[node(i)];
  stars_.for_each_neighbour(i, [&](NodeId other) { near |= bad_[other]; });
  return near != 0;
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

}  // namespace quadloop::smoother
