#include "adapt/metric/leaf_shares.hpp"

#include <algorithm>
#include <compare>

#include "mesher/base/morton.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::adapt {

namespace {

/// Key of a unit square on the curve: the tree, then the square in it.
struct SquareKey {
  std::int64_t tree = 0;
  std::uint64_t square = 0;
  friend auto operator<=>(const SquareKey&, const SquareKey&) = default;
};

/// All ranks' leaves, searchable by point.
class LeafIndex {
 public:
  /// *Collective.*
  LeafIndex(const Communicator& comm, const TreeGrid& grid, const std::vector<LeafRecord>& leaves)
      : grid_{grid} {
    list_trees(comm, leaves);
    for (const LeafRecord& leaf : leaves) {
      keys_.push_back({number_of(leaf.tree_x, leaf.tree_y),
                       morton_key(static_cast<std::uint32_t>(leaf.x), static_cast<std::uint32_t>(leaf.y))});
    }
    const SquareKey beyond{std::ssize(trees_), 0};
    begins_ = comm.all_gather(keys_.empty() ? beyond : keys_.front());
    for (std::size_t rank = begins_.size() - 1; rank-- > 0;)
      begins_[rank] = std::min(begins_[rank], begins_[rank + 1]);  // for ranks without leaves
  }

  SquareKey key_of(Point p) const {
    constexpr std::int64_t within = (std::int64_t{1} << Quadrant::unit_level) - 1;
    const std::int64_t x = grid_.column_at(p.x), y = grid_.row_at(p.y);
    return {number_of(x >> Quadrant::unit_level, y >> Quadrant::unit_level),
            morton_key(static_cast<std::uint32_t>(x & within), static_cast<std::uint32_t>(y & within))};
  }
  int rank_of(const SquareKey& key) const {
    return static_cast<int>(std::ranges::upper_bound(begins_, key) - begins_.begin()) - 1;
  }
  /// Local index.
  std::int32_t leaf_of(const SquareKey& key) const {
    return static_cast<std::int32_t>(std::ranges::upper_bound(keys_, key) - keys_.begin()) - 1;
  }

 private:
  using Tree = std::array<std::int64_t, 2>;

  /// Lists the trees in the order of the curve.
  void list_trees(const Communicator& comm, const std::vector<LeafRecord>& leaves) {
    std::vector<Tree> own;
    for (const LeafRecord& leaf : leaves) {
      const Tree tree{leaf.tree_x, leaf.tree_y};
      if (own.empty() || own.back() != tree) own.push_back(tree);
    }
    trees_ = comm.all_gather_values(std::span<const Tree>(own));
    trees_.erase(std::ranges::unique(trees_).begin(), trees_.end());
  }
  std::int64_t number_of(std::int64_t column, std::int64_t row) const {
    return std::ranges::find(trees_, Tree{column, row}) - trees_.begin();
  }

  const TreeGrid& grid_;
  std::vector<Tree> trees_;
  std::vector<SquareKey> keys_, begins_;
};

/// A triangle with its leaf.
struct PlacedTriangle {
  std::int32_t leaf = 0;
  LooseTriangle triangle;

  auto order() const {
    std::array<std::int64_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) ids[k] = triangle.nodes[k].id;
    return std::pair{leaf, ids};
  }
};

/// Rotated so that the smallest id is first.
LooseTriangle turned(LooseTriangle t) {
  const auto first = std::ranges::min_element(t.nodes, {}, &TileNode::id) - t.nodes.begin();
  std::rotate(t.nodes.begin(), t.nodes.begin() + first, t.nodes.end());
  std::rotate(t.boundaries.begin(), t.boundaries.begin() + first, t.boundaries.end());
  return t;
}

/// *Collective.*
std::vector<PlacedTriangle> placed(const Communicator& comm, const LeafIndex& index, const Mesh& mesh) {
  const std::vector<LogMetric> none(mesh.points.size());
  Outbox<LooseTriangle> travelling;
  for (const LooseTriangle& t : loosened(comm, mesh, none))
    travelling.add(index.rank_of(index.key_of(t.centroid())), turned(t));
  std::vector<PlacedTriangle> found;
  for (const LooseTriangle& t : travelling.deliver(comm))
    found.push_back({index.leaf_of(index.key_of(t.centroid())), t});
  std::ranges::sort(found, {}, &PlacedTriangle::order);
  return found;
}

}  // namespace

void share_among_leaves(const Communicator& comm, const TreeGrid& grid, const Mesh& mesh,
                        MeshResult& result) {
  std::vector<LeafRecord>& leaves = result.tree.leaves;
  const LeafIndex index(comm, grid, leaves);
  const std::vector<PlacedTriangle> all = placed(comm, index, mesh);
  for (LeafRecord& leaf : leaves) leaf.triangles = leaf.quads = 0;
  result.edge_leaves.assign(mesh.boundaries.size(), {});
  std::vector<LooseTriangle> triangles;
  for (const PlacedTriangle& p : all) {
    ++leaves[p.leaf].triangles;
    for (const std::int32_t boundary : p.triangle.boundaries) {
      if (boundary >= 0) result.edge_leaves[boundary].push_back(p.leaf);
    }
    triangles.push_back(p.triangle);
  }
  for (LeafRecord& leaf : leaves) leaf.block = leaf.triangles > 0 ? 1 : 0;
  result.mesh = joined(comm, triangles, mesh.boundaries);
  count_entries(comm, result);
}

}  // namespace quadloop::adapt
