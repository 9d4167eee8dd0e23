#include "mesher/forest/forest.hpp"

#include <p4est_bits.h>
#include <p4est_communication.h>
#include <p4est_extended.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <new>
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

/// The first line that p4est has logged of what ends it.
std::string& last_words() {
  static std::string words;
  return words;
}

void keep_words(FILE*, const char*, int, int, int, int, const char* message) {
  if (last_words().empty()) last_words() = message;
}

/// In the place of p4est's stack trace and abort(). Nothing is used after it but to be destroyed.
void throw_for_p4est() {
  const std::string words = std::exchange(last_words(), {});
  if (words.find("lloc") != std::string::npos) throw std::bad_alloc();  // "Allocation", "Reallocation"
  throw Fault("p4est: " + words);
}

/// p4est is to be set up once in a program.
void set_up_p4est() {
  if (p4est_package_id >= 0) return;
  sc_set_log_defaults(nullptr, keep_words, SC_LP_ERROR);
  sc_set_abort_handler(throw_for_p4est);
  p4est_init(keep_words, SC_LP_ERROR);
}

/// What p4est's callback reaches through its user pointer.
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

/// Makes one tree's leaves anew, from those that it had.
class TreeRefiner {
 public:
  TreeRefiner(p4est_tree_t& tree, const Quadrant& corner, const std::function<bool(const Quadrant&)>& split,
              int deepest_level)
      : tree_{tree}, corner_{corner}, split_{split}, deepest_level_{deepest_level} {}

  void refine() {
    sc_array_t before = tree_.quadrants;
    sc_array_init_count(&tree_.quadrants, sizeof(p4est_quadrant_t), before.elem_count);
    sc_array_truncate(&tree_.quadrants);
    const std::unique_ptr<sc_array_t, Releaser<sc_array_reset>> released(&before);
    std::fill(std::begin(tree_.quadrants_per_level), std::end(tree_.quadrants_per_level), 0);
    for (std::size_t i = 0; i < before.elem_count; ++i) add(*p4est_quadrant_array_index(&before, i));
  }

 private:
  /// The quadrant, or what it is split into.
  void add(const p4est_quadrant_t& q) {
    if (q.level >= deepest_level_ || !split_({corner_.x + q.x, corner_.y + q.y, q.level})) {
      *p4est_quadrant_array_push(&tree_.quadrants) = q;
      ++tree_.quadrants_per_level[q.level];
      tree_.maxlevel = std::max(tree_.maxlevel, q.level);
      return;
    }
    p4est_quadrant_t child = q;
    ++child.level;
    const p4est_qcoord_t size = P4EST_QUADRANT_LEN(child.level);
    for (int k = 0; k < P4EST_CHILDREN; ++k) {
      child.x = q.x + (k % 2) * size;
      child.y = q.y + (k / 2) * size;
      add(child);
    }
  }

  p4est_tree_t& tree_;
  const Quadrant& corner_;
  const std::function<bool(const Quadrant&)>& split_;
  int deepest_level_;
};

}  // namespace

struct Forest::Impl {
  std::unique_ptr<p4est_connectivity_t, Releaser<p4est_connectivity_destroy>>
      connectivity;  // outlives the forest
  std::unique_ptr<p4est_t, Releaser<p4est_destroy>> forest;
  std::vector<Quadrant> tree_corners;
  std::vector<std::int32_t> tree_numbers;  ///< row by row
  int trees_x = 1;
};

Forest::Forest(const Communicator& comm, const Lattice& lattice) : impl_{std::make_unique<Impl>()} {
  set_up_p4est();
  impl_->trees_x = lattice.trees_x();
  impl_->connectivity.reset(p4est_connectivity_new_brick(lattice.trees_x(), lattice.trees_y(), 0, 0));
  p4est_connectivity_t& trees = *impl_->connectivity;
  impl_->tree_numbers.resize(trees.num_trees);
  for (p4est_topidx_t t = 0; t < trees.num_trees; ++t) {
    const double* corner = trees.vertices + 3 * trees.tree_to_vertex[P4EST_CHILDREN * t];
    const std::int64_t column = std::llround(corner[0]), row = std::llround(corner[1]);
    impl_->tree_corners.push_back({column << Quadrant::unit_level, row << Quadrant::unit_level, 0});
    impl_->tree_numbers[row * lattice.trees_x() + column] = t;
  }
  impl_->forest.reset(p4est_new_ext(comm.raw(), impl_->connectivity.get(), 0, 1, 1, 0, nullptr, nullptr));
}

Forest::~Forest() = default;
Forest::Forest(Forest&&) noexcept = default;

/// As p4est_refine_ext, which takes twice the time: it keeps lists of quadrants that are yet to be asked
/// about.
void Forest::refine(const std::function<bool(const Quadrant&)>& split, int deepest_level) {
  p4est_t& forest = *impl_->forest;
  p4est_locidx_t leaves = 0;
  for (p4est_topidx_t t = std::max(forest.first_local_tree, 0); t < forest.connectivity->num_trees; ++t) {
    p4est_tree_t& tree = *p4est_tree_array_index(forest.trees, t);
    if (t <= forest.last_local_tree) TreeRefiner(tree, impl_->tree_corners[t], split, deepest_level).refine();
    tree.quadrants_offset = leaves;
    leaves += static_cast<p4est_locidx_t>(tree.quadrants.elem_count);
  }
  forest.local_num_quadrants = leaves;
  p4est_comm_count_quadrants(&forest);
}

void Forest::split_marked(const std::vector<char>& marked) {
  QUADLOOP_REQUIRE(std::ssize(marked) == local_leaves(), "one mark for each local leaf");
  std::size_t next = 0;
  int children = 0;  // of the last marked one, that are yet to come
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

void Forest::partition() { p4est_partition_ext(impl_->forest.get(), 0, nullptr); }

void Forest::partition(const std::function<int(const Quadrant&)>& weight) {
  Weights weights{&impl_->tree_corners, &weight};
  impl_->forest->user_pointer = &weights;
  p4est_partition_ext(impl_->forest.get(), 0,
                      weight_by_function);  // on every rank, also on one without leaves
}

std::int32_t Forest::local_leaves() const { return impl_->forest->local_num_quadrants; }
std::int64_t Forest::global_leaves() const { return impl_->forest->global_num_quadrants; }

std::vector<Quadrant> Forest::leaves(std::size_t room) const {
  std::vector<Quadrant> leaves;
  leaves.reserve(local_leaves() + room);
  p4est_t& forest = *impl_->forest;
  for (p4est_topidx_t t = forest.first_local_tree; t <= forest.last_local_tree; ++t) {
    sc_array_t& quadrants = p4est_tree_array_index(forest.trees, t)->quadrants;
    for (std::size_t i = 0; i < quadrants.elem_count; ++i)
      leaves.push_back(quadrant_of(impl_->tree_corners, t, *p4est_quadrant_array_index(&quadrants, i)));
  }
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
