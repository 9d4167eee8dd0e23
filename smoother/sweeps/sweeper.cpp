#include "smoother/sweeps/sweeper.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

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
  for (const std::int32_t i : stars.all()) {
    if (bad_[node(i)] != 0) count_turned(i);
  }
  for (const NodeId copy : copies()) {
    if (bad_[copy] != 0) count_turned_copy(copy);
  }
  waiting_.assign(stars.all().begin(), stars.all().end());
}

std::int64_t Sweeper::sweep() {
  if (done_ > 0) update_bad();
  ++done_;
  return comm_.sum(sweeps_.sweep(
      waiting_, [&](std::size_t i) { return bad_near_[node(i)] > 0; },
      [&](std::size_t i) { return better_place(i); },
      [&](std::span<const std::int32_t> order, std::size_t k) {
        slide_.fetch_ahead(stars_.nodes(), order, k);
      }));
}

/// Flags the nodes of cells above the threshold, of other ranks too. Stars that are stale have changed, or
/// were near no bad node before.
void Sweeper::update_bad() {
  const std::vector<std::int32_t> changed = sweeps_.take_changed(), doubtful = doubtful_among(changed);
  const std::vector<char> copies_before(bad_.begin() + mesh_.owned_nodes(), bad_.end());
  std::vector<std::int32_t> turned;
  for (std::size_t k = 0; k < doubtful.size(); ++k) {
    stars_.fetch_ahead(doubtful, k);
    const std::int32_t i = doubtful[k];
    const char is_bad = stars_.costs_more(i, rule_.threshold) ? 1 : 0;
    if (std::exchange(bad_[node(i)], is_bad) != is_bad) turned.push_back(i);
  }
  mesh_.exchange().update(bad_);
  near_new_.clear();
  for (const std::int32_t i : turned) count_turned(i);
  for (const NodeId copy : copies()) {
    if (bad_[copy] != copies_before[copy.value() - mesh_.owned_nodes()]) count_turned_copy(copy);
  }
  std::sort(near_new_.begin(), near_new_.end());
  near_new_.erase(std::unique(near_new_.begin(), near_new_.end()), near_new_.end());
  waiting_.clear();
  std::ranges::set_union(changed, near_new_, std::back_inserter(waiting_));
}

/// The stars whose flags are to be looked at. One that was visited and round which all has stayed since keeps
/// its flag, even where something moved in the sweep before it was visited; after the open sweeps it loses
/// that. Where there are quadrilaterals all do then: lines that have moved may have made some bad unnoticed,
/// and a bad one is not seen from the node across its bad corner.
std::vector<std::int32_t> Sweeper::doubtful_among(const std::vector<std::int32_t>& changed) {
  if (done_ == open_sweeps && mesh_.has_quads()) return {stars_.all().begin(), stars_.all().end()};
  std::vector<std::int32_t> doubtful;
  for (const std::int32_t i : changed) (sweeps_.is_stale(i) ? doubtful : passed_over_).push_back(i);
  if (done_ == open_sweeps) doubtful.insert(doubtful.end(), passed_over_.begin(), passed_over_.end());
  return doubtful;
}

/// A node of this rank has become bad, or good.
void Sweeper::count_turned(std::size_t i) {
  const std::int32_t more = bad_[node(i)] != 0 ? 1 : -1;
  count_near(node(i), more);
  stars_.for_each_neighbour(i, [&](NodeId other) { count_near(other, more); });
}

/// Another rank's node has.
void Sweeper::count_turned_copy(NodeId copy) {
  const std::int32_t more = bad_[copy] != 0 ? 1 : -1;
  stars_.for_each_star_round(copy, [&](std::size_t i) { count_near(node(i), more); });
}

void Sweeper::count_near(NodeId node, std::int32_t more) {
  std::int32_t& count = bad_near_[node];
  if (count == 0) {
    if (const std::int32_t star = stars_.star_of(node); star >= 0) near_new_.push_back(star);
  }
  count += more;
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
