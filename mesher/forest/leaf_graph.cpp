#include "mesher/forest/leaf_graph.hpp"

#include <bit>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/forest/ghost_layer.hpp"

namespace quadloop {

namespace {

/// Sufficient for most cases, so that adding ghosts does not reallocate. Unused capacity occupies no memory.
std::size_t room_for_ghosts(std::int32_t leaves) {
  constexpr std::int32_t share = 16, least = 1024;
  return leaves / share + least;
}

}  // namespace

LeafGraph::LeafGraph(const Communicator& comm, const TreeGrid& grid, const Forest& forest)
    : owners_{forest.owners()}, rank_{comm.rank()}, trees_x_{grid.trees_x()}, trees_y_{grid.trees_y()} {
  std::vector<Quadrant> local = forest.leaves(comm.size() == 1 ? 0 : room_for_ghosts(forest.local_leaves()));
  const std::vector<Ghost> ghosts = ghost_layer(comm, grid, owners_, local);
  for (const auto& ghost : ghosts) local_begin_ += ghost.owner < rank_ ? 1 : 0;
  local_count_ = size32(local);
  std::vector<Quadrant> before, after;
  for (const auto& ghost : ghosts) {
    (ghost.owner < rank_ ? before : after).push_back(ghost.quadrant);
    ghost_owners_.push_back({ghost.owner, ghost.index});
  }
  leaves_ = std::move(local);
  leaves_.insert(leaves_.begin(), before.begin(), before.end());
  leaves_.insert(leaves_.end(), after.begin(), after.end());
  build_trees(grid);
  around_.resize(leaves_.size());
  const int nx = grid.trees_x(), ny = grid.trees_y();
  const auto root = [&](int x, int y) {
    return x < 0 || y < 0 || x >= nx || y >= ny ? no_ref : roots_[y * nx + x];
  };
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      visit(root(x, y), {root(x - 1, y), root(x, y - 1), root(x + 1, y), root(x, y + 1), root(x - 1, y - 1)});
    }
  }
}

LeafGraph::Owner LeafGraph::owner_of(LeafId leaf) const {
  if (is_local(leaf)) return {rank_, local_index(leaf)};
  return ghost_owners_[leaf.value() - (local_index(leaf) < 0 ? 0 : local_count_)];
}

LeafId LeafGraph::leaf_at(std::int64_t x, std::int64_t y) const {
  if (!in_root(x, y)) return none;
  Ref ref = root_at(x, y);
  for (int level = 0; is_inner(ref); ++level) ref = down(ref, quarter_at(x, y, level));
  return LeafId{ref};
}

LeafGraph::Ref LeafGraph::new_inner() {
  inner_.push_back({no_ref, no_ref, no_ref, no_ref});
  return static_cast<Ref>(-1 - std::ssize(inner_));
}

/// Adds each leaf to its tree, starting from the path to the previous leaf instead of the root.
void LeafGraph::build_trees(const TreeGrid& grid) {
  roots_.assign(grid.trees_x() * grid.trees_y(), no_ref);
  inner_.reserve(leaves_.size() / 3 + leaves_.size() / 16 + 64);
  std::array<Ref, Quadrant::unit_level + 1> path{};
  std::int64_t last_tree = -1;
  Quadrant last;
  for (std::int32_t i = 0; i < size(); ++i) {
    const Quadrant& q = leaves_[i];
    const std::int64_t tree = (q.y >> Quadrant::unit_level) * grid.trees_x() + (q.x >> Quadrant::unit_level);
    int common = 0;  // level of the deepest inner node on both paths
    if (tree == last_tree) {
      const std::uint64_t differing = (q.x ^ last.x) | (q.y ^ last.y);
      common = Quadrant::unit_level - static_cast<int>(std::bit_width(differing));
    } else {
      path[0] = roots_[tree] = new_inner();
    }
    for (int level = common; level < q.level; ++level) {
      const Ref below = level + 1 == q.level ? i : new_inner();
      child(path[level], quarter_at(q.x, q.y, level)) = below;
      path[level + 1] = below;
    }
    last = q;
    last_tree = tree;
  }
}

/// Passes each child its neighbours: its siblings, and the children of its parent's neighbours (or these
/// themselves if they are leaves).
void LeafGraph::visit(Ref ref, const Neighbours& n) {
  if (ref == no_ref) return;
  if (!is_inner(ref)) {
    visit_leaf(LeafId{ref}, n);
    return;
  }
  using enum Corner;
  const Ref sw = down(ref, south_west), se = down(ref, south_east), nw = down(ref, north_west),
            ne = down(ref, north_east);
  visit(sw, {down(n.west, south_east), down(n.south, north_west), se, nw, down(n.south_west, north_east)});
  visit(se, {sw, down(n.south, north_east), down(n.east, south_west), ne, down(n.south, north_west)});
  visit(nw, {down(n.west, north_east), sw, ne, down(n.north, south_west), down(n.west, south_east)});
  visit(ne, {nw, se, down(n.east, north_west), down(n.north, south_east), sw});
}

void LeafGraph::visit_leaf(LeafId leaf, const Neighbours& n) {
  using enum Corner;
  const auto deepest = [&](Ref ref, Corner quarter) {
    while (is_inner(ref)) ref = down(ref, quarter);
    return LeafId{ref};
  };
  Around& around = around_[leaf.value()];
  around.south_west = deepest(n.south_west, north_east);
  around.south = deepest(n.south, north_east);
  around.west = deepest(n.west, north_east);
  if (is_inner(n.south)) around.south_half = deepest(down(n.south, north_west), north_east);
  if (is_inner(n.west)) around.west_half = deepest(down(n.west, south_east), north_east);
  if (is_inner(n.south)) around.finer.add(Side::bottom);
  if (is_inner(n.east)) around.finer.add(Side::right);
  if (is_inner(n.north)) around.finer.add(Side::top);
  if (is_inner(n.west)) around.finer.add(Side::left);
}

}  // namespace quadloop
