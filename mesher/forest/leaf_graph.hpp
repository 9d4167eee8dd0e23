#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/forest/forest.hpp"

namespace quadloop {

/// This rank's leaves and the ghost leaves around them, in the order of the curve, and which of them touch. A
/// leaf is known by its number here; `none` where there is no leaf (outside the root, or out of this rank's
/// sight).
class LeafGraph {
 public:
  static constexpr std::int32_t none = -1;

  /// *Collective.*
  LeafGraph(const Communicator& comm, const Lattice& lattice, const Forest& forest);

  std::int32_t size() const { return size32(leaves_); }
  std::int32_t local_begin() const { return local_begin_; }
  std::int32_t local_end() const { return local_begin_ + local_count_; }
  bool is_local(std::int32_t leaf) const { return local_begin() <= leaf && leaf < local_end(); }
  const Quadrant& leaf(std::int32_t leaf) const { return leaves_[leaf]; }
  const std::vector<Quadrant>& leaves() const { return leaves_; }

  /// The rank that a leaf belongs to, and its number there (counted from that rank's first leaf).
  struct Place {
    int rank = 0;
    std::int32_t index = 0;
  };
  Place place_of(std::int32_t leaf) const;
  /// The number here of a local leaf from its number counted from this rank's first leaf.
  std::int32_t from_local(std::int32_t index) const { return local_begin_ + index; }

  /// The leaf that holds the unit square right above the lattice corner (x, y); none where there is none in
  /// sight.
  std::int32_t leaf_at(std::int64_t x, std::int64_t y) const;
  /// The rank with the leaf that holds it, in sight or not; it must lie in the root.
  int rank_at(std::int64_t x, std::int64_t y) const { return owners_.rank_of(owners_.place_of(x, y)); }
  /// The leaves round a lattice point, as Corner counts from it; a leaf that it lies on a side of is there
  /// twice.
  std::array<std::int32_t, 4> leaves_round(LatticePoint p) const {
    return {leaf_at(p.x - 1, p.y - 1), leaf_at(p.x, p.y - 1), leaf_at(p.x, p.y), leaf_at(p.x - 1, p.y)};
  }

  /// The leaves around the lower left part of a leaf, each named by the point of it that they touch; such a
  /// leaf is the first along the curve of all that touch the point.
  struct Around {
    std::int32_t south_west = none;  ///< beyond the lower left corner, diagonally
    std::int32_t south = none;       ///< below the lower right corner (below the bottom side)
    std::int32_t west = none;        ///< left of the upper left corner (left of the left side)
    std::int32_t south_half = none;  ///< below the bottom side's left half, where the leaves below are finer
    std::int32_t west_half = none;   ///< left of the left side's lower half, where the leaves there are finer
    SideSet finer;  ///< the sides across which the neighbours are finer: each has a hanging node
  };
  const Around& around(std::int32_t leaf) const { return around_[leaf]; }
  bool has_hanging(std::int32_t leaf, Side side) const { return around(leaf).finer.contains(side); }

 private:
  using Ref = std::int32_t;  ///< a leaf (>= 0), none, or an inner node of the tree (-2 and below)
  struct Neighbours {
    Ref west = none, south = none, east = none, north = none, south_west = none;
  };
  static constexpr bool is_inner(Ref ref) { return ref < none; }
  Ref& child(Ref inner, Corner quarter) { return inner_[-2 - inner][index_of(quarter)]; }
  Ref down(Ref ref, Corner quarter) const {
    return is_inner(ref) ? inner_[-2 - ref][index_of(quarter)] : ref;
  }
  Ref new_inner();
  void build_trees(const Lattice& lattice);
  void visit(Ref ref, const Neighbours& n);
  void visit_leaf(std::int32_t leaf, const Neighbours& n);

  CurveOwners owners_;
  std::vector<Quadrant> leaves_;
  std::int32_t local_begin_ = 0, local_count_ = 0;
  int rank_ = 0;
  std::vector<Place> ghost_places_;
  std::vector<Around> around_;
  std::vector<std::array<Ref, 4>> inner_;  ///< by Corner
  std::vector<Ref> roots_;
  int trees_x_ = 1, trees_y_ = 1;
};

}  // namespace quadloop
