#include "mesher/forest/forest.hpp"

#include <p4est_bits.h>
#include <p4est_communication.h>
#include <p4est_extended.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <new>
#include <ranges>
#include <string>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

template <auto release>
struct Releaser {
  template <class T>
  void operator()(T* handle) const noexcept {
    release(handle);
  }
};

static_assert(P4EST_MAXLEVEL == Quadrant::unit_level, "lattice units are p4est's");

/// The first error message that p4est has logged.
std::string& last_words() {
  static std::string words;
  return words;
}

void keep_words(FILE*, const char*, int, int, int, int, const char* message) {
  if (last_words().empty()) last_words() = message;
}

/// Replaces p4est's stack trace and abort(). Afterwards objects may only be destroyed.
void throw_for_p4est() {
  const std::string words = std::exchange(last_words(), {});
  if (words.find("lloc") != std::string::npos) throw std::bad_alloc();  // "Allocation", "Reallocation"
  throw Fault("p4est: " + words);
}

/// Initialises p4est once per program.
void set_up_p4est() {
  if (p4est_package_id >= 0) return;
  sc_set_log_defaults(nullptr, keep_words, SC_LP_ERROR);
  sc_set_abort_handler(throw_for_p4est);
  p4est_init(keep_words, SC_LP_ERROR);
}

/// Data for p4est's callback, passed by its user pointer.
struct Weights {
  const std::vector<Quadrant>* tree_corners = nullptr;
  const std::function<int(const Quadrant&)>* weight = nullptr;
};

Quadrant quadrant_of(const std::vector<Quadrant>& tree_corners, p4est_topidx_t tree,
                     const p4est_quadrant_t& q) {
  const Quadrant& corner = tree_corners[tree];
  return {corner.x + q.x, corner.y + q.y, q.level};
}

int weight_by_function(p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* q) {
  const Weights& weights = *static_cast<const Weights*>(forest->user_pointer);
  return (*weights.weight)(quadrant_of(*weights.tree_corners, tree, *q));
}

/// Splits of p4est's quadrants of a tree since p4est received them: a flag for each quadrant; if set,
/// followed by the flags of its children, recursively. So a forest grows by one bit per quadrant, and p4est
/// receives the leaves, in arrays of the right length, only for moving them.
struct TreeSplits {
  std::vector<bool> flags;
  std::int32_t leaves = 0;  ///< number of unset flags
};

/// Advances to the quadrant after q along the curve; returns whether that is still inside the ancestor of
/// level `top`.
bool to_next(Quadrant& q, int top) {
  for (; q.level > top; --q.level) {
    const std::int64_t size = q.size();
    const bool east = (q.x & size) != 0, north = (q.y & size) != 0;
    q.x += east ? -size : size;
    if (!east) return true;
    q.y += north ? -size : size;
    if (!north) return true;
  }
  return false;
}

/// Visits the leaves below a quadrant in the order of the curve. `is_split` is called for each quadrant
/// before those below it.
template <class IsSplit, class Visit>
void for_leaves_below(Quadrant q, const IsSplit& is_split, const Visit& visit) {
  const int top = q.level;
  do {
    while (is_split(q)) ++q.level;  // first child
    visit(q);
  } while (to_next(q, top));
}

using Flag = std::vector<bool>::const_iterator;

/// Builds new flags of a tree from its previous flags.
class SplitFlags {
 public:
  SplitFlags(const std::vector<bool>& before, const std::function<bool(const Quadrant&)>& split,
             int deepest_level)
      : next_{before.begin()}, split_{split}, deepest_level_{deepest_level} {
    made_.flags.reserve(before.size());
  }

  /// Adds one of p4est's quadrants.
  void add(const Quadrant& q) {
    known_ = Quadrant::unit_level;
    for_leaves_below(
        q, [&](const Quadrant& below) { return add_flag(below); }, [&](const Quadrant&) { ++made_.leaves; });
  }

  TreeSplits made() && { return std::move(made_); }

 private:
  bool add_flag(const Quadrant& q) {
    const bool is_known = q.level <= known_, was_split = is_known && *next_++;
    if (is_known) known_ = was_split ? Quadrant::unit_level : q.level;
    const bool is_split = was_split || (q.level < deepest_level_ && split_(q));
    made_.flags.push_back(is_split);
    return is_split;
  }

  Flag next_;
  int known_ = Quadrant::unit_level;  ///< level of the last leaf: quadrants below it have no flags yet
  const std::function<bool(const Quadrant&)>& split_;
  int deepest_level_;
  TreeSplits made_;
};

}  // namespace

struct Forest::Impl {
  std::unique_ptr<p4est_connectivity_t, Releaser<p4est_connectivity_destroy>>
      connectivity;  // outlives the forest
  std::unique_ptr<p4est_t, Releaser<p4est_destroy>> forest;
  std::vector<Quadrant> tree_corners;
  std::vector<std::int32_t> tree_numbers;  ///< row by row
  std::vector<TreeSplits> splits;          ///< for each tree
  int trees_x = 1;

  /// Trees with quadrants on this rank.
  auto local_trees() const { return std::views::iota(forest->first_local_tree, forest->last_local_tree + 1); }
  p4est_tree_t& tree(p4est_topidx_t t) const { return *p4est_tree_array_index(forest->trees, t); }
  /// Visits p4est's quadrants.
  template <class Visit>
  void for_quadrants(p4est_topidx_t t, const Visit& visit) const {
    sc_array_t& quadrants = tree(t).quadrants;
    for (std::size_t i = 0; i < quadrants.elem_count; ++i)
      visit(quadrant_of(tree_corners, t, *p4est_quadrant_array_index(&quadrants, i)));
  }
  template <class Visit>
  void for_leaves(p4est_topidx_t t, const Visit& visit) const {
    Flag next = splits[t].flags.begin();
    const auto is_split = [&](const Quadrant&) { return bool{*next++}; };
    for_quadrants(t, [&](const Quadrant& q) { for_leaves_below(q, is_split, visit); });
  }

  void take_quadrants();
  void give_leaves();
  void give_leaves_of(p4est_topidx_t t) const;
};

/// Uses p4est's quadrants as the leaves.
void Forest::Impl::take_quadrants() {
  splits.assign(connectivity->num_trees, {});
  for (const p4est_topidx_t t : local_trees()) {
    const std::size_t leaves = tree(t).quadrants.elem_count;
    splits[t] = {std::vector<bool>(leaves), static_cast<std::int32_t>(leaves)};
  }
}

/// Passes the leaves to p4est. *Collective.*
void Forest::Impl::give_leaves() {
  p4est_locidx_t leaves = 0;
  for (p4est_topidx_t t = std::max(forest->first_local_tree, 0); t < connectivity->num_trees; ++t) {
    if (t <= forest->last_local_tree) give_leaves_of(t);
    tree(t).quadrants_offset = leaves;
    leaves += splits[t].leaves;
  }
  forest->local_num_quadrants = leaves;
  p4est_comm_count_quadrants(forest.get());
}

void Forest::Impl::give_leaves_of(p4est_topidx_t t) const {
  p4est_tree_t& whole = tree(t);
  sc_array_t all;
  sc_array_init_count(&all, sizeof(p4est_quadrant_t), splits[t].leaves);
  std::fill(std::begin(whole.quadrants_per_level), std::end(whole.quadrants_per_level), 0);
  std::size_t next = 0;
  for_leaves(t, [&](const Quadrant& q) {
    p4est_quadrant_t leaf{};
    leaf.x = static_cast<p4est_qcoord_t>(q.x - tree_corners[t].x);
    leaf.y = static_cast<p4est_qcoord_t>(q.y - tree_corners[t].y);
    leaf.level = static_cast<std::int8_t>(q.level);
    *p4est_quadrant_array_index(&all, next++) = leaf;
    ++whole.quadrants_per_level[leaf.level];
    whole.maxlevel = std::max(whole.maxlevel, leaf.level);
  });
  sc_array_reset(&whole.quadrants);
  whole.quadrants = all;
}

Forest::Forest(const Communicator& comm, const TreeGrid& grid) : impl_{std::make_unique<Impl>()} {
  set_up_p4est();
  impl_->trees_x = grid.trees_x();
  impl_->connectivity.reset(p4est_connectivity_new_brick(grid.trees_x(), grid.trees_y(), 0, 0));
  p4est_connectivity_t& trees = *impl_->connectivity;
  impl_->tree_numbers.resize(trees.num_trees);
  for (p4est_topidx_t t = 0; t < trees.num_trees; ++t) {
    const double* corner = trees.vertices + 3 * trees.tree_to_vertex[P4EST_CHILDREN * t];
    const std::int64_t column = std::llround(corner[0]), row = std::llround(corner[1]);
    impl_->tree_corners.push_back({column << Quadrant::unit_level, row << Quadrant::unit_level, 0});
    impl_->tree_numbers[row * grid.trees_x() + column] = t;
  }
  impl_->forest.reset(p4est_new_ext(comm.raw(), impl_->connectivity.get(), 0, 1, 1, 0, nullptr, nullptr));
  impl_->take_quadrants();
}

Forest::~Forest() = default;
Forest::Forest(Forest&&) noexcept = default;

void Forest::refine(const std::function<bool(const Quadrant&)>& split, int deepest_level) {
  for (const p4est_topidx_t t : impl_->local_trees()) {
    const std::vector<bool> before = std::exchange(impl_->splits[t].flags, {});
    SplitFlags flags(before, split, deepest_level);
    impl_->for_quadrants(t, [&](const Quadrant& q) { flags.add(q); });
    impl_->splits[t] = std::move(flags).made();
  }
}

void Forest::split_marked(const std::vector<char>& marked) {
  QUADLOOP_REQUIRE(std::ssize(marked) == local_leaves(), "one mark for each local leaf", marked.size(),
                   local_leaves());
  std::size_t next = 0;
  int children = 0;  // remaining children of the last marked leaf
  const auto split = [&](const Quadrant&) {
    if (children > 0) {
      --children;
      return false;
    }
    children = marked[next] != 0 ? P4EST_CHILDREN : 0;
    return marked[next++] != 0;
  };
  refine(split, P4EST_QMAXLEVEL);
}

void Forest::partition() {
  impl_->give_leaves();
  p4est_partition_ext(impl_->forest.get(), 0, nullptr);
  impl_->take_quadrants();
}

void Forest::partition(const std::function<int(const Quadrant&)>& weight) {
  impl_->give_leaves();
  Weights weights{&impl_->tree_corners, &weight};
  impl_->forest->user_pointer = &weights;
  p4est_partition_ext(impl_->forest.get(), 0,
                      weight_by_function);  // on every rank, even without leaves
  impl_->take_quadrants();
}

std::int32_t Forest::local_leaves() const {
  std::int32_t leaves = 0;
  for (const TreeSplits& tree : impl_->splits) leaves += tree.leaves;
  return leaves;
}

std::vector<Quadrant> Forest::leaves(std::size_t room) const {
  std::vector<Quadrant> leaves;
  leaves.reserve(local_leaves() + room);
  for (const p4est_topidx_t t : impl_->local_trees())
    impl_->for_leaves(t, [&](const Quadrant& q) { leaves.push_back(q); });
  return leaves;
}

CurveOwners Forest::owners() const {
  std::vector<CurveKey> begins;
  for (int rank = 0; rank <= impl_->forest->mpisize; ++rank) {
    const p4est_quadrant_t& first = impl_->forest->global_first_position[rank];
    begins.push_back({first.p.which_tree, p4est_quadrant_linear_id(&first, P4EST_MAXLEVEL)});
  }
  return {std::move(begins), impl_->tree_numbers, impl_->trees_x};
}

}  // namespace quadloop
