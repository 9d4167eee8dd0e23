#include "mesher/layers/grown_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesher/base/error.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

GrownMesh::GrownMesh(const Communicator& comm, const std::vector<std::int32_t>& added, const DivideBy& divide,
                     Mesh& mesh, std::vector<LeafRecord>& leaves)
    : comm_{comm},
      divide_{divide},
      mesh_{mesh},
      leaves_{leaves},
      after_(mesh.points.size()),
      edges_(mesh.boundaries.size()) {
  const auto owned = ids_below(NodeId{mesh_.owned_nodes});
  for (const NodeId node : owned) owned_nodes_ += 1 + added[node.value()];
  first_node_ = comm_.exclusive_sum(owned_nodes_);
  std::int64_t next = first_node_;
  for (const NodeId node : owned) {
    after_[node] = GlobalNodeId{next};
    next += 1 + added[node.value()];
  }
  NodeExchange(comm_, NodeOwners(comm_, mesh_.first_node), mesh_.owned_nodes, mesh_.ghosts).update(after_);
}

std::map<GlobalNodeId, GrownNode> GrownMesh::nodes(std::span<const GlobalNodeId> before) const {
  struct Renumbered {
    GlobalNodeId before;
    GrownNode node;
  };
  const NodeOwners owners(comm_, mesh_.first_node);
  std::vector<Renumbered> own;
  for (const GlobalNodeId id : before) {
    if (owners.rank_of(id) == comm_.rank()) own.push_back({id, node(owners.local(id))});
  }
  std::map<GlobalNodeId, GrownNode> all;
  for (const Renumbered& r : comm_.all_gather_values(std::span<const Renumbered>(own)))
    all.emplace(r.before, r.node);
  return all;
}

void GrownMesh::use(const GrownNode& node) {
  if (!owns(node.id)) ghosts_.emplace(node.id, node.point);
}

void GrownMesh::add_triangle(std::int32_t leaf, const GrownNode& a, const GrownNode& b, const GrownNode& c) {
  triangles_.push_back({leaf, {a.id, b.id, c.id}, block_});
}

/// Whether both diagonals of a quadrilateral have equally ranked ends.
bool GrownMesh::diagonals_rank_alike(std::span<const GrownNode> corners) const {
  const auto ends = [&](std::size_t from, std::size_t to) {
    std::array ranks{divide_(corners[from].point), divide_(corners[to].point)};
    std::ranges::sort(ranks);
    return ranks;
  };
  return ends(0, 2) == ends(1, 3);
}

void GrownMesh::add_cell(std::int32_t leaf, std::span<const GrownNode> corners, std::size_t outer) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    use(corners[k]);
    const Point a = corners[k].point, b = corners[(k + 1) % n].point, c = corners[(k + 2) % n].point;
    if (orientation(a, b, c) <= 0 && !bad_) bad_ = {b, whose_, cure_};
  }
  if (n == 3) return add_triangle(leaf, corners[0], corners[1], corners[2]);
  const Point one = corners[2].point - corners[0].point, other = corners[3].point - corners[1].point;
  const double first = dot(one, one), second = dot(other, other);
  if (!divide_ || (first == second && diagonals_rank_alike(corners))) {
    quads_.push_back({leaf, {corners[0].id, corners[1].id, corners[2].id, corners[3].id}, block_});
    return;
  }
  const bool takes_first =
      first != second ? first < second : divide_(corners[outer].point) > divide_(corners[outer + 1].point);
  add_triangle(leaf, corners[0], corners[1], corners[takes_first ? 2 : 3]);
  add_triangle(leaf, corners[takes_first ? 0 : 1], corners[2], corners[3]);
}

void GrownMesh::add_edge(std::size_t boundary, std::int32_t leaf, const GrownNode& from,
                         const GrownNode& to) {
  use(from);
  use(to);
  edges_[boundary].push_back({leaf, {from.id, to.id}});
}

void GrownMesh::keep_edge(std::size_t boundary, std::int32_t leaf, const std::array<NodeId, 2>& edge) {
  edges_[boundary].push_back({leaf, {after_[edge[0]], after_[edge[1]]}});
}

void GrownMesh::refuse_bad_cells() const {
  comm_.together([&] {
    if (bad_)
      throw InputError(fmt::format("{}near ({:.6g}, {:.6g}): a cell of the layers would be inverted; {}",
                                   bad_->whose, bad_->corner.x, bad_->corner.y, bad_->cure));
  });
}

void GrownMesh::put_together(const std::function<void(NodeId, std::vector<Point>&)>& append_behind) {
  refuse_bad_cells();
  place_nodes(append_behind);
  merge_boundaries();
  merge_cells(mesh_.triangles, triangles_, dropped_triangles_, &LeafRecord::triangles,
              mesh_.blocks.of_triangles);
  merge_cells(mesh_.quads, quads_, dropped_quads_, &LeafRecord::quads, mesh_.blocks.of_quads);
  for (LeafRecord& leaf : leaves_)
    leaf.block = has_cells(leaf) ? std::max<std::int16_t>(leaf.block, 1) : std::int16_t{0};
}

void GrownMesh::place_nodes(const std::function<void(NodeId, std::vector<Point>&)>& append_behind) {
  std::vector<Point> points;
  points.reserve(owned_nodes_);
  for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes})) {
    points.push_back(mesh_.point(node));
    append_behind(node, points);
  }
  QUADLOOP_REQUIRE(size32(points) == owned_nodes_, "as many nodes as are numbered", points.size(),
                   owned_nodes_);
  for (std::size_t i = mesh_.owned_nodes; i < mesh_.points.size(); ++i)
    ghosts_.emplace(after_[NodeId{static_cast<std::int32_t>(i)}], mesh_.points[i]);
  mesh_.ghosts.clear();
  for (const auto& [id, point] : ghosts_) {
    local_copy_.emplace(id, NodeId{size32(points)});
    mesh_.ghosts.push_back(id);
    points.push_back(point);
  }
  mesh_.points = std::move(points);
  mesh_.first_node = first_node_;
  mesh_.owned_nodes = owned_nodes_;
}

/// Local numbers in the new mesh.
template <std::size_t width>
std::array<NodeId, width> GrownMesh::numbered(const std::array<GlobalNodeId, width>& ids) const {
  std::array<NodeId, width> nodes;
  std::ranges::transform(ids, nodes.begin(), [&](GlobalNodeId id) {
    return owns(id) ? NodeId{static_cast<std::int32_t>(id.value() - first_node_)} : local_copy_.at(id);
  });
  return nodes;
}

/// Inserts the added cells of each leaf after the leaf's own cells, of which some may be dropped, and their
/// blocks.
template <std::size_t width>
void GrownMesh::merge_cells(std::vector<std::array<NodeId, width>>& cells, std::vector<OfLeaf<width>>& added,
                            std::vector<std::int32_t>& dropped, std::int32_t LeafRecord::*count,
                            std::vector<std::int32_t>& blocks) const {
  const bool has_blocks = !mesh_.blocks.names.empty();
  std::ranges::sort(dropped);
  auto next_dropped = dropped.cbegin();
  const auto is_dropped = [&](auto cell) {
    if (next_dropped == dropped.cend() || cell - cells.cbegin() != *next_dropped) return false;
    ++next_dropped;
    return true;
  };
  std::ranges::stable_sort(added, {}, &OfLeaf<width>::leaf);
  std::vector<std::array<NodeId, width>> merged;
  std::vector<std::int32_t> merged_blocks;
  merged.reserve(cells.size() + added.size());
  auto own = cells.cbegin();
  auto next = added.cbegin();
  for (std::int32_t leaf = 0; leaf < std::ssize(leaves_); ++leaf) {
    for (const auto end = own + leaves_[leaf].*count; own != end; ++own) {
      if (is_dropped(own)) {
        --(leaves_[leaf].*count);
        continue;
      }
      std::array<GlobalNodeId, width> ids;
      std::ranges::transform(*own, ids.begin(), [&](NodeId node) { return after_[node]; });
      if (has_blocks) merged_blocks.push_back(blocks[own - cells.cbegin()]);
      merged.push_back(numbered(ids));
    }
    for (; next != added.end() && next->leaf == leaf; ++next, ++(leaves_[leaf].*count)) {
      merged.push_back(numbered(next->nodes));
      if (has_blocks) merged_blocks.push_back(next->block);
    }
  }
  cells = std::move(merged);
  blocks = std::move(merged_blocks);
}

std::vector<std::vector<std::int32_t>> GrownMesh::edge_leaves() const {
  std::vector<std::vector<std::int32_t>> leaves(edges_.size());
  for (std::size_t b = 0; b < edges_.size(); ++b) {
    for (const OfLeaf<2>& edge : edges_[b]) leaves[b].push_back(edge.leaf);
  }
  return leaves;
}

void GrownMesh::merge_boundaries() {
  for (std::size_t b = 0; b < edges_.size(); ++b) {
    std::ranges::stable_sort(edges_[b], {}, &OfLeaf<2>::leaf);
    mesh_.boundaries[b].edges.clear();
    for (const OfLeaf<2>& edge : edges_[b]) mesh_.boundaries[b].edges.push_back(numbered(edge.nodes));
  }
}

}  // namespace quadloop
