#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// A leaf with the set of its ancestors, and possibly itself, that are to be split: bit l for the quadrant of
/// level l that contains it.
struct SplitDemand {
  Quadrant leaf;
  std::uint32_t levels = 0;
};

/// The quadrants that adaptation has requested to split, regardless of case and geometry, with all their
/// ancestors. Every rank stores all of them, in little more than two bytes each: two thirds of a byte per
/// leaf of the tree.
class DemandedSplits {
 public:
  static constexpr std::int32_t none = -1;

  /// No demands.
  DemandedSplits() = default;
  /// The demands of all ranks; their order does not matter. *Collective.*
  DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands);
  /// Adds these demands, for layers that are not valid on larger leaves, to those of `before`. *Collective.*
  DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands,
                 const DemandedSplits& before);

  bool empty() const { return masks_.empty(); }
  /// Whether some of them were requested for layers.
  bool for_layers() const { return for_layers_; }
  /// Level of the finest requested leaves; 0 if there are none.
  int finest_level() const { return finest_; }

  /// Returns the number of a tree's root if it is split, else none.
  std::int32_t root(std::int64_t tree_x, std::int64_t tree_y) const;
  /// Returns the number of a child of a split quadrant if it is split too, else none.
  std::int32_t child(std::int32_t number, Corner quarter) const;

  /// Whether this quadrant was requested itself.
  bool asked(std::int32_t number) const;
  /// Level of the finest requested leaves inside a split quadrant.
  int finest_level_in(std::int32_t number) const { return finest_in_[number]; }

 private:
  /// Key of a quadrant on the Morton curve over all trees, for its level.
  using Key = std::uint64_t;
  using KeysOfLevels = std::array<std::vector<Key>, Quadrant::unit_level>;
  static KeysOfLevels keys_of(std::span<const SplitDemand> demands);
  static KeysOfLevels gather_asked(const Communicator& comm, std::span<const SplitDemand> demands);
  void assign(const KeysOfLevels& asked);
  static void append_asked(std::span<const Key> roots, std::span<const std::uint8_t> masks,
                           KeysOfLevels& asked);
  void append_level(std::span<const Key> all, std::span<const Key> asked, std::span<const Key> above,
                    std::int32_t first_above);
  void raise_finest();

  // By level, then along the curve: bits 0 to 3 for children that are split, bit 4 if the quadrant itself was
  // requested.
  std::vector<std::uint8_t> masks_;
  std::vector<std::int8_t> finest_in_;  ///< finest_level_in() of each
  /// For each block of masks: number of split quadrants below the roots before the block's children.
  std::vector<std::int32_t> children_before_;
  std::vector<Key> roots_;
  int finest_ = 0;
  bool for_layers_ = false;
};

/// The paths to a sequence of leaves; few steps each if they are in curve order.
class DemandPath {
 public:
  /// The demands must outlive the path.
  explicit DemandPath(const DemandedSplits& demanded) : demanded_{&demanded} {}

  /// As SplitDemand::levels, for the ancestors of a leaf that were requested themselves.
  std::uint32_t levels_above(const Quadrant& leaf);

 private:
  struct Step {
    std::int32_t number = DemandedSplits::none;  ///< of the quadrant of this level
    std::uint32_t levels = 0;                    ///< requested above it
  };
  void keep_above(const Quadrant& leaf);

  const DemandedSplits* demanded_;
  Quadrant last_;
  std::vector<Step> steps_;  ///< from the root of the last leaf's tree, one per level
};

}  // namespace quadloop
