#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/forest/forest.hpp"

namespace quadloop {

/// This rank's leaves and their ghost leaves, in the order of the curve, with their neighbours. Ids number
/// both kinds; `none` means no leaf (outside the root, or not known to this rank). Data of local leaves only
/// are indexed by the local index, counted from this rank's first leaf.
class LeafGraph {
 public:
  static constexpr LeafId none{};

  /// *Collective.*
  LeafGraph(const Communicator& comm, const TreeGrid& grid, const Forest& forest);

  std::int32_t size() const { return size32(leaves_); }
  /// Number of ghost leaves before the local ones.
  std::int32_t local_begin() const { return local_begin_; }
  std::int32_t local_size() const { return local_count_; }
  auto all() const { return ids_below(LeafId{size()}); }
  auto local() const { return ids_between(from_local(0), from_local(local_count_)); }
  bool is_local(LeafId leaf) const { return 0 <= local_index(leaf) && local_index(leaf) < local_count_; }
  /// Conversion between a local leaf and its local index.
  std::int32_t local_index(LeafId leaf) const { return leaf.value() - local_begin_; }
  LeafId from_local(std::int32_t index) const { return LeafId{local_begin_ + index}; }
  const Quadrant& leaf(LeafId leaf) const { return leaves_[leaf.value()]; }
  const std::vector<Quadrant>& leaves() const { return leaves_; }

  /// The rank of a leaf, and its local index there.
  struct Owner {
    int rank = 0;
    std::int32_t index = 0;
  };
  Owner owner_of(LeafId leaf) const;

  /// The leaf that contains the unit square with lower left grid vertex (x, y); none if it is not known. For
  /// many queries use a LeafFinder.
  LeafId leaf_at(std::int64_t x, std::int64_t y) const;
  /// The rank of the leaf that contains this unit square, known or not; it must be in the root.
  int rank_at(std::int64_t x, std::int64_t y) const { return owners_.rank_of(owners_.key_at(x, y)); }

  /// Neighbours at the lower left part of a leaf, each named by the point that they touch. Such a leaf is the
  /// first along the curve of all leaves that touch the point.
  struct Around {
    LeafId south_west;  ///< beyond the lower left corner, diagonally
    LeafId south;       ///< below the lower right corner, adjacent to the bottom side
    LeafId west;        ///< left of the upper left corner, adjacent to the left side
    LeafId south_half;  ///< below the left half of the bottom side, if the leaves below are finer
    LeafId west_half;   ///< left of the lower half of the left side, if the leaves there are finer
    SideSet finer;      ///< sides with finer neighbours: each has a hanging node
  };
  const Around& around(LeafId leaf) const { return around_[leaf.value()]; }
  bool has_hanging(LeafId leaf, Side side) const { return around(leaf).finer.contains(side); }

 private:
  friend class LeafFinder;
  using Ref = std::int32_t;  ///< a leaf's id (>= 0), no_ref, or an inner node of the tree (-2 and below)
  static constexpr Ref no_ref = none.value();
  struct Neighbours {
    Ref west = no_ref, south = no_ref, east = no_ref, north = no_ref, south_west = no_ref;
  };
  static constexpr bool is_inner(Ref ref) { return ref < no_ref; }
  Ref& child(Ref inner, Corner quarter) { return inner_[-2 - inner][index_of(quarter)]; }
  Ref down(Ref ref, Corner quarter) const {
    return is_inner(ref) ? inner_[-2 - ref][index_of(quarter)] : ref;
  }
  bool in_root(std::int64_t x, std::int64_t y) const {
    return x >= 0 && y >= 0 && x >> Quadrant::unit_level < trees_x_ && y >> Quadrant::unit_level < trees_y_;
  }
  Ref root_at(std::int64_t x, std::int64_t y) const {
    return roots_[(y >> Quadrant::unit_level) * trees_x_ + (x >> Quadrant::unit_level)];
  }
  Ref new_inner();
  void build_trees(const TreeGrid& grid);
  void visit(Ref ref, const Neighbours& n);
  void visit_leaf(LeafId leaf, const Neighbours& n);

  CurveOwners owners_;
  std::vector<Quadrant> leaves_;
  std::int32_t local_begin_ = 0, local_count_ = 0;
  int rank_ = 0;
  std::vector<Owner> ghost_owners_;
  std::vector<Around> around_;
  std::vector<std::array<Ref, 4>> inner_;  ///< children by Corner
  std::vector<Ref> roots_;
  int trees_x_ = 1, trees_y_ = 1;
};

}  // namespace quadloop
