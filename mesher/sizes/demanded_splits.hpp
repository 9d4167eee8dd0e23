#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// A leaf and which of its ancestors, and itself, are to be split: bit l for the quadrant of level l that
/// holds it.
struct SplitDemand {
  Quadrant leaf;
  std::uint32_t levels = 0;
};

/// The quadrants that adaptation has asked to split, whatever case and geometry say, with all quadrants above
/// them. Every rank has them all, in little more than two bytes for each: two thirds of a byte for a leaf of
/// the tree.
class DemandedSplits {
 public:
  static constexpr std::int32_t none = -1;

  /// No demands.
  DemandedSplits() = default;
  /// Of all ranks' demands; the order does not matter. *Collective.*
  DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands);
  /// These, for layers that cannot stand on larger leaves, beside those of `before`. *Collective.*
  DemandedSplits(const Communicator& comm, std::span<const SplitDemand> demands,
                 const DemandedSplits& before);

  bool empty() const { return masks_.empty(); }
  /// Whether layers have asked for some of them.
  bool for_layers() const { return for_layers_; }
  /// The level of the finest leaves that they ask for; 0 for none.
  int finest_level() const { return finest_; }

  /// The number of a tree's root if it is split, else none.
  std::int32_t root(std::int64_t tree_x, std::int64_t tree_y) const;
  /// The number of a quarter of a split quadrant if it is split too, else none.
  std::int32_t child(std::int32_t number, Corner quarter) const;

  /// Whether this quadrant was asked for itself.
  bool asked(std::int32_t number) const;
  /// The level of the finest leaves that are asked for inside a split quadrant.
  int finest_level_in(std::int32_t number) const { return finest_in_[number]; }

 private:
  /// Key of a quadrant on the Morton curve over all trees, among those of its level.
  using Key = std::uint64_t;
  using KeysOfLevels = std::array<std::vector<Key>, Quadrant::unit_level>;
  static KeysOfLevels gather_asked(const Communicator& comm, std::span<const SplitDemand> demands);
  void assign(const KeysOfLevels& asked);
  void append_asked(KeysOfLevels& asked) const;
  void append_level(std::span<const Key> all, std::span<const Key> asked, std::span<const Key> above,
                    std::int32_t first_above);
  void raise_finest();

  // In the order of levels, then along the curve: bits 0 to 3 for children that are split, bit 4 where the
  // quadrant itself was asked for.
  std::vector<std::uint8_t> masks_;
  std::vector<std::int8_t> finest_in_;         ///< of each its finest_level_in()
  std::vector<std::int32_t> children_before_;  ///< for each block of masks: split quadrants below the roots
                                               ///< that come before the block's children
  std::vector<Key> roots_;
  int finest_ = 0;
  bool for_layers_ = false;
};

/// The way down to one leaf after another: few steps for each where they come in the order of the curve.
class DemandPath {
 public:
  /// The demands must outlive the path.
  explicit DemandPath(const DemandedSplits& demanded) : demanded_{&demanded} {}

  /// As in SplitDemand, for the quadrants above a leaf: only those that were asked for themselves.
  std::uint32_t levels_above(const Quadrant& leaf);

 private:
  struct Step {
    std::int32_t number = DemandedSplits::none;  ///< of the quadrant of this level
    std::uint32_t levels = 0;                    ///< asked for above it
  };
  void keep_above(const Quadrant& leaf);

  const DemandedSplits* demanded_;
  Quadrant last_;
  std::vector<Step> steps_;  ///< from the root of the last leaf's tree down, one a level
};

}  // namespace quadloop
