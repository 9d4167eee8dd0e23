#include "adapt/metric/gradation.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::adapt {

namespace {

constexpr int most_sweeps = 100;         ///< each propagates a size by one edge
constexpr double settled_change = 1e-3;  ///< largest relative change of the density per sweep at any node

/// The neighbours of each owned node, in global order.
class Neighbours {
 public:
  explicit Neighbours(const HaloMesh& halo) : of_(static_cast<std::size_t>(halo.owned_nodes())) {
    halo.for_each_cell([&](const auto& nodes) {
      for (const NodeId node : nodes) {
        if (!halo.owns(node)) continue;
        for (const NodeId other : nodes) {
          if (other != node) of_[node.value()].push_back(other);
        }
      }
    });
    const auto number = [&](NodeId node) { return halo.global(node); };
    for (auto& list : of_) {
      std::ranges::sort(list, {}, number);
      list.erase(std::ranges::unique(list).begin(), list.end());
    }
  }
  const std::vector<NodeId>& of(std::size_t node) const { return of_[node]; }

 private:
  std::vector<std::vector<NodeId>> of_;
};

}  // namespace

void limit_growth(const Communicator& comm, const Mesh& mesh, double slope, std::vector<Metric>& metrics) {
  const HaloMesh halo(comm, mesh);
  const Neighbours neighbours(halo);
  std::vector<Metric> all = metrics;
  all.resize(halo.points().size());
  halo.exchange().update(all);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    std::vector<Metric> next = all;
    double change = 0;
    for (std::int32_t n = 0; n < halo.owned_nodes(); ++n) {
      for (const NodeId other : neighbours.of(static_cast<std::size_t>(n))) {
        const Point edge = halo.point(NodeId{n}) - halo.point(other);
        next[n] = intersection(next[n], grown(all[other.value()], edge, slope));
      }
      change = std::max(change, density_of(next[n]) / density_of(all[n]) - 1);
    }
    all = std::move(next);
    halo.exchange().update(all);
    if (comm.maximum(change) < settled_change) break;
  }
  std::copy_n(all.begin(), metrics.size(), metrics.begin());
}

}  // namespace quadloop::adapt
