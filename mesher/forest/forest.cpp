#include "mesher/forest/forest.hpp"

#include <p4est_bits.h>
#include <p4est_extended.h>
#include <p4est_ghost.h>

#include <cmath>

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

/// p4est is to be set up once in a program.
void quieten_p4est() {
  if (p4est_package_id >= 0) return;
  sc_set_log_defaults(nullptr, nullptr, SC_LP_ERROR);
  p4est_init(nullptr, SC_LP_ERROR);
}

/// What p4est's callbacks reach through its user pointer.
struct Callbacks {
  const std::vector<Quadrant>* tree_corners = nullptr;
  const std::function<bool(const Quadrant&)>* split = nullptr;
  const std::vector<char>* marked = nullptr;
  const std::vector<int>* weights = nullptr;
  std::size_t next = 0;  ///< leaf that the callback is asked about
};

Quadrant place_of(const std::vector<Quadrant>& tree_corners, p4est_topidx_t tree, const p4est_quadrant_t& q) {
  const Quadrant& corner = tree_corners[static_cast<std::size_t>(tree)];
  return {corner.x + q.x, corner.y + q.y, q.level};
}

Callbacks& callbacks_of(p4est_t* forest) { return *static_cast<Callbacks*>(forest->user_pointer); }

int split_by_function(p4est_t* forest, p4est_topidx_t tree, p4est_quadrant_t* q) {
  Callbacks& callbacks = callbacks_of(forest);
  return (*callbacks.split)(place_of(*callbacks.tree_corners, tree, *q)) ? 1 : 0;
}

int split_by_mark(p4est_t* forest, p4est_topidx_t, p4est_quadrant_t*) {
  Callbacks& callbacks = callbacks_of(forest);
  return (*callbacks.marked)[callbacks.next++];
}

int weight_of(p4est_t* forest, p4est_topidx_t, p4est_quadrant_t*) {
  Callbacks& callbacks = callbacks_of(forest);
  return (*callbacks.weights)[callbacks.next++];
}

}  // namespace

struct Forest::Impl {
  std::unique_ptr<p4est_connectivity_t, Releaser<p4est_connectivity_destroy>> connectivity;  // outlives the forest
  std::unique_ptr<p4est_t, Releaser<p4est_destroy>> forest;
  std::vector<Quadrant> tree_corners;
  int size = 1;
};

Forest::Forest(const Communicator& comm, const Lattice& lattice) : impl_{std::make_unique<Impl>()} {
  quieten_p4est();
  impl_->size = comm.size();
  impl_->connectivity.reset(p4est_connectivity_new_brick(lattice.trees_x(), lattice.trees_y(), 0, 0));
  p4est_connectivity_t& trees = *impl_->connectivity;
  for (p4est_topidx_t t = 0; t < trees.num_trees; ++t) {
    const double* corner = trees.vertices + 3 * trees.tree_to_vertex[P4EST_CHILDREN * t];
    impl_->tree_corners.push_back({std::llround(corner[0]) << Quadrant::unit_level, std::llround(corner[1]) << Quadrant::unit_level, 0});
  }
  impl_->forest.reset(p4est_new_ext(comm.raw(), impl_->connectivity.get(), 0, 1, 1, 0, nullptr, nullptr));
}

Forest::~Forest() = default;
Forest::Forest(Forest&&) noexcept = default;

void Forest::refine(const std::function<bool(const Quadrant&)>& split, int deepest_level) {
  Callbacks callbacks{.tree_corners = &impl_->tree_corners, .split = &split};
  impl_->forest->user_pointer = &callbacks;
  p4est_refine_ext(impl_->forest.get(), 1, deepest_level, split_by_function, nullptr, nullptr);
}

void Forest::split_marked(const std::vector<char>& marked) {
  QUADLOOP_REQUIRE(marked.size() == static_cast<std::size_t>(local_leaves()), "one mark for each local leaf");
  Callbacks callbacks{.marked = &marked};
  impl_->forest->user_pointer = &callbacks;
  p4est_refine_ext(impl_->forest.get(), 0, P4EST_QMAXLEVEL, split_by_mark, nullptr, nullptr);
}

void Forest::partition() { p4est_partition_ext(impl_->forest.get(), 0, nullptr); }

void Forest::partition(const std::vector<int>& weights) {
  QUADLOOP_REQUIRE(weights.size() == static_cast<std::size_t>(local_leaves()), "one weight for each local leaf");
  Callbacks callbacks{.weights = &weights};
  impl_->forest->user_pointer = &callbacks;
  p4est_partition_ext(impl_->forest.get(), 0, weight_of);  // on every rank, also on one without leaves
}

std::int32_t Forest::local_leaves() const { return impl_->forest->local_num_quadrants; }
std::int64_t Forest::global_leaves() const { return impl_->forest->global_num_quadrants; }

std::vector<Quadrant> Forest::leaves() const {
  std::vector<Quadrant> leaves;
  leaves.reserve(static_cast<std::size_t>(local_leaves()));
  p4est_t& forest = *impl_->forest;
  for (p4est_topidx_t t = forest.first_local_tree; t <= forest.last_local_tree; ++t) {
    sc_array_t& quadrants = p4est_tree_array_index(forest.trees, t)->quadrants;
    for (std::size_t i = 0; i < quadrants.elem_count; ++i)
      leaves.push_back(place_of(impl_->tree_corners, t, *p4est_quadrant_array_index(&quadrants, i)));
  }
  return leaves;
}

std::vector<Forest::Ghost> Forest::ghosts() const {
  std::vector<Ghost> ghosts;
  if (impl_->size == 1) return ghosts;
  const std::unique_ptr<p4est_ghost_t, Releaser<p4est_ghost_destroy>> layer(p4est_ghost_new(impl_->forest.get(), P4EST_CONNECT_FULL));
  for (int rank = 0; rank < impl_->size; ++rank) {
    for (p4est_locidx_t i = layer->proc_offsets[rank]; i < layer->proc_offsets[rank + 1]; ++i) {
      const p4est_quadrant_t& q = *p4est_quadrant_array_index(&layer->ghosts, static_cast<std::size_t>(i));
      ghosts.push_back({place_of(impl_->tree_corners, q.p.piggy3.which_tree, q), rank, q.p.piggy3.local_num});
    }
  }
  return ghosts;
}

}  // namespace quadloop
