#include "mesher/build/split_baffles.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace quadloop {

namespace {

using Edge = std::pair<GlobalNodeId, GlobalNodeId>;

/// A cell's corner at a node of a baffle, with the neighbouring nodes of the cell, counter-clockwise.
struct CellCorner {
  GlobalNodeId node, next, before;
  friend auto operator<=>(const CellCorner&, const CellCorner&) = default;
};

/// The corners at the nodes of baffles on all ranks, and to which copy of its node each belongs.
class CornerCopies {
 public:
  /// `edges`: both directions of the baffles' edges, ascending; `corners` ascending.
  CornerCopies(const std::vector<Edge>& edges, std::vector<CellCorner> corners)
      : edges_{edges}, corners_{std::move(corners)}, copy_(corners_.size(), 0) {
    for (auto begin = corners_.begin(), end = begin; begin != corners_.end(); begin = end) {
      while (end != corners_.end() && end->node == begin->node) ++end;
      number(begin - corners_.begin(), end - corners_.begin());
    }
    for (std::size_t c = 0; c < corners_.size(); ++c) by_before_[{corners_[c].node, corners_[c].before}] = c;
  }

  /// The number of a node after all copies have their numbers, for its first copy.
  GlobalNodeId renumbered(GlobalNodeId node) const {
    const auto found = std::ranges::lower_bound(extra_, node, {}, &Extra::node);
    return GlobalNodeId{node.value() + (found == extra_.begin() ? 0 : (found - 1)->sum)};
  }
  std::int32_t copies_of(GlobalNodeId node) const {
    const auto found = std::ranges::lower_bound(extra_, node, {}, &Extra::node);
    return found == extra_.end() || found->node != node ? 1 : found->copies;
  }
  /// The copy at the corner of the cell to the left of an edge, at its start or end.
  GlobalNodeId at_start(GlobalNodeId from, GlobalNodeId to) const {
    if (copies_of(from) == 1) return renumbered(from);
    const auto found = std::ranges::lower_bound(
        corners_, std::pair(from, to), {}, [](const CellCorner& c) { return std::pair(c.node, c.next); });
    return GlobalNodeId{renumbered(from).value() + copy_[found - corners_.begin()]};
  }
  GlobalNodeId at_end(GlobalNodeId from, GlobalNodeId to) const {
    if (copies_of(to) == 1) return renumbered(to);
    return GlobalNodeId{renumbered(to).value() + copy_[by_before_.at({to, from})]};
  }

 private:
  /// A node with several copies, and the number of copies beyond the first of it and of all lower nodes.
  struct Extra {
    GlobalNodeId node;
    std::int32_t copies = 1;
    std::int64_t sum = 0;
  };

  /// Numbers the sectors at one node in the order of their first corners.
  void number(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> sector(end - begin);
    std::iota(sector.begin(), sector.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (sector[i] != i) i = sector[i];
      return i;
    };
    for (std::size_t i = 0; i < sector.size(); ++i) {
      for (std::size_t j = 0; j < sector.size(); ++j) {
        const CellCorner &a = corners_[begin + i], &b = corners_[begin + j];
        if (a.before != b.next || std::ranges::binary_search(edges_, Edge{a.node, a.before})) continue;
        const auto [low, high] = std::minmax({root(i), root(j)});
        sector[high] = low;
      }
    }
    std::int32_t copies = 0;
    for (std::size_t i = 0; i < sector.size(); ++i)
      copy_[begin + i] = root(i) == i ? copies++ : copy_[begin + root(i)];
    if (copies == 1) return;
    extra_.push_back({corners_[begin].node, copies, (extra_.empty() ? 0 : extra_.back().sum) + copies - 1});
  }

  const std::vector<Edge>& edges_;
  std::vector<CellCorner> corners_;
  std::vector<std::int32_t> copy_;
  std::vector<Extra> extra_;  ///< ascending
  std::map<Edge, std::size_t> by_before_;
};

/// This rank's part of the mesh with new numbers.
class SplitMesh {
 public:
  SplitMesh(const Mesh& mesh, const CornerCopies& copies) : mesh_{mesh}, copies_{copies} {
    made_.strips = mesh.strips;
    made_.blocks = mesh.blocks;
    made_.first_node = copies.renumbered(GlobalNodeId{mesh.first_node}).value();
    for (const NodeId node : ids_below(NodeId{mesh.owned_nodes}))
      made_.points.insert(made_.points.end(), copies.copies_of(mesh.global(node)), mesh.point(node));
    made_.owned_nodes = size32(made_.points);
    find_ghosts();
    for (const auto& nodes : mesh.triangles) made_.triangles.push_back(local(renumbered(nodes)));
    for (const auto& nodes : mesh.quads) made_.quads.push_back(local(renumbered(nodes)));
    for (const BoundaryEdges& boundary : mesh.boundaries) {
      made_.boundaries.push_back(boundary);
      for (auto& edge : made_.boundaries.back().edges) edge = local(ends(edge));
    }
  }

  Mesh take() { return std::move(made_); }

 private:
  template <std::size_t width>
  std::array<GlobalNodeId, width> renumbered(const std::array<NodeId, width>& nodes) const {
    std::array<GlobalNodeId, width> numbers;
    for (std::size_t k = 0; k < width; ++k)
      numbers[k] = copies_.at_start(mesh_.global(nodes[k]), mesh_.global(nodes[(k + 1) % width]));
    return numbers;
  }
  std::array<GlobalNodeId, 2> ends(const std::array<NodeId, 2>& edge) const {
    const GlobalNodeId from = mesh_.global(edge[0]), to = mesh_.global(edge[1]);
    return {copies_.at_start(from, to), copies_.at_end(from, to)};
  }

  bool owns(GlobalNodeId node) const {
    return node.value() >= made_.first_node && node.value() < made_.first_node + made_.owned_nodes;
  }

  /// Those that cells and boundary edges have, ascending.
  void find_ghosts() {
    std::map<GlobalNodeId, Point> found;
    const auto look_at = [&](const auto& numbers, const auto& nodes) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (!owns(numbers[k])) found.emplace(numbers[k], mesh_.point(nodes[k]));
      }
    };
    mesh_.for_each_cell([&](const auto& nodes) { look_at(renumbered(nodes), nodes); });
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& edge : boundary.edges) look_at(ends(edge), edge);
    }
    for (const auto& [node, point] : found) {
      made_.ghosts.push_back(node);
      made_.points.push_back(point);
    }
  }

  template <std::size_t width>
  std::array<NodeId, width> local(const std::array<GlobalNodeId, width>& numbers) const {
    std::array<NodeId, width> nodes;
    for (std::size_t k = 0; k < width; ++k) {
      const auto ghost = std::ranges::lower_bound(made_.ghosts, numbers[k]) - made_.ghosts.begin();
      nodes[k] = owns(numbers[k]) ? NodeId{static_cast<std::int32_t>(numbers[k].value() - made_.first_node)}
                                  : NodeId{static_cast<std::int32_t>(made_.owned_nodes + ghost)};
    }
    return nodes;
  }

  const Mesh& mesh_;
  const CornerCopies& copies_;
  Mesh made_;
};

/// Both directions of the baffles' edges on all ranks, ascending. *Collective.*
std::vector<Edge> edges_of_baffles(const Communicator& comm, const Geometry& geometry, const Mesh& mesh) {
  std::vector<std::array<GlobalNodeId, 2>> own;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    if (!geometry.boundaries()[b].baffle) continue;
    for (const auto& [from, to] : mesh.boundaries[b].edges)
      own.push_back({mesh.global(from), mesh.global(to)});
  }
  std::vector<Edge> edges;
  for (const auto& [from, to] : comm.all_gather_values(std::span<const std::array<GlobalNodeId, 2>>(own)))
    edges.insert(edges.end(), {{from, to}, {to, from}});
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The cells' corners at the starts of the edges, on all ranks, ascending. *Collective.*
std::vector<CellCorner> corners_at(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<Edge>& edges) {
  std::vector<CellCorner> own;
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t width = nodes.size();
    for (std::size_t k = 0; k < width; ++k) {
      const GlobalNodeId node = mesh.global(nodes[k]);
      const auto at = std::ranges::lower_bound(edges, node, {}, &Edge::first);
      if (at != edges.end() && at->first == node)
        own.push_back(
            {node, mesh.global(nodes[(k + 1) % width]), mesh.global(nodes[(k + width - 1) % width])});
    }
  });
  std::vector<CellCorner> all = comm.all_gather_values(std::span<const CellCorner>(own));
  std::ranges::sort(all);
  return all;
}

}  // namespace

void split_baffles(const Communicator& comm, const Geometry& geometry, Mesh& mesh) {
  if (std::ranges::none_of(geometry.boundaries(), &Boundary::baffle)) return;
  const std::vector<Edge> edges = edges_of_baffles(comm, geometry, mesh);
  const CornerCopies copies(edges, corners_at(comm, mesh, edges));
  mesh = SplitMesh(mesh, copies).take();
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    if (geometry.boundaries()[b].baffle) mesh.boundaries[b].inner_line = false;
  }
}

}  // namespace quadloop
