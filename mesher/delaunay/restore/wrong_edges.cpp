#include "mesher/delaunay/restore/wrong_edges.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "mesher/delaunay/flipper.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

namespace {

/// An edge as one of its triangles has it, listed with its lower node.
struct Side {
  NodeId high, opposite;
  bool rises;  ///< the triangle lies to the left on the way from the lower to the higher node
};

/// The sides of edges with two flagged ends, one lower node after the other.
class Sides {
 public:
  Sides(const HaloMesh& mesh, const NodeFlags& named) : starts_(mesh.points().size() + 2, 0) {
    for_each(mesh, named, [&](NodeId low, const Side&) { ++starts_[low.value() + std::size_t{2}]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    sides_.resize(starts_.back());
    for_each(mesh, named, [&](NodeId low, const Side& side) {
      sides_[starts_[low.value() + std::size_t{1}]++] = side;  // which moves to where the node's sides end
    });
  }
  std::span<const Side> at(NodeId low) const {
    const std::size_t begin = starts_[low.value()], end = starts_[low.value() + std::size_t{1}];
    return std::span(sides_).subspan(begin, end - begin);
  }

 private:
  template <class Visit>
  static void for_each(const HaloMesh& mesh, const NodeFlags& named, const Visit& visit) {
    mesh.for_each_cell([&](const auto& nodes) {
      constexpr std::size_t width = std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>>;
      for (std::size_t k = 0; k < 3 && width == 3; ++k) {
        const NodeId from = nodes[k], to = nodes[(k + 1) % 3], opposite = nodes[(k + 2) % 3];
        if (named[from] == 0 || named[to] == 0) continue;
        visit(std::min(from, to), Side{std::max(from, to), opposite, from < to});
      }
    });
  }

  std::vector<std::size_t> starts_;
  std::vector<Side> sides_;
};

/// Flags that owners, or owners and copies, are known to have, for all nodes of the halo. *Collective.*
NodeFlags spread(const HaloMesh& mesh, NodeFlags flags) {
  flags.resize(mesh.points().size(), 0);
  mesh.exchange().update(flags);
  return flags;
}

}  // namespace

std::vector<GlobalNodeId> nodes_of_wrong_edges(const Communicator& comm, const Mesh& mesh,
                                               const std::vector<GlobalNodeId>& nodes, const NodeFlags& moved,
                                               const std::function<TieRank(Point)>& rank_of) {
  const HaloMesh halo(comm, mesh);
  NodeFlags named(mesh.points.size(), 0);
  flag_at_owners(comm, NodeOwners(comm, mesh.first_node), nodes, named);
  named = spread(halo, std::move(named));
  const NodeFlags stirred = spread(halo, moved.empty() ? NodeFlags(mesh.points.size(), 1) : moved);
  const Sides sides(halo, named);
  std::vector<GlobalNodeId> found;
  const auto look_at = [&](NodeId low, const Side& left, const Side& right) {
    const std::array four{low, left.high, left.opposite, right.opposite};
    if (std::none_of(four.begin(), four.end(), [&](NodeId node) { return stirred[node] != 0; })) return;
    const auto point = [&](std::size_t k) { return halo.point(four[k]); };
    if (should_flip(point(0), point(1), point(2), point(3), [&](std::size_t k) { return rank_of(point(k)); }))
      found.insert(found.end(), {halo.global(four[0]), halo.global(four[1])});
  };
  for (const NodeId low : named.ids()) {
    const std::span<const Side> at = sides.at(low);
    for (const Side& left : at) {
      const auto right = std::find_if(
          at.begin(), at.end(), [&](const Side& side) { return side.high == left.high && !side.rises; });
      if (left.rises && right != at.end()) look_at(low, left, *right);
    }
  }
  return found;
}

}  // namespace quadloop
