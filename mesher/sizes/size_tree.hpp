#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/sizes/size_rules.hpp"

namespace quadloop {

/// The *wanted* tree: the quadrants that must be split by the rules, with the geometry in each. It is built
/// lazily, by non-const functions; so a rank stores only what it visits, and no result depends on earlier
/// queries. Queries use objects held by the caller, which extend the tree: SizeCursor, Gradation,
/// LeavesAhead.
class SizeTree {
 public:
  struct Node {
    Quadrant quadrant;
    std::int32_t parent = -1;
    /// Index of the first of four children, or one of the two constants below.
    std::int32_t children = unknown;
    std::int32_t segments_begin = 0, segments_end = 0;
    std::int32_t corners_begin = 0, corners_end = 0;
    bool plain = false;        ///< as in SizeRules::Judgement
    std::int8_t finest = 0;    ///< as in SizeRules::Judgement
    std::int16_t winding = 0;  ///< winding number of the boundary around the lower left corner
    std::int32_t demanded = DemandedSplits::none;  ///< its number in DemandedSplits
    std::int32_t deepest_split = -1;  ///< level of the deepest known split node at or below this one
    static constexpr std::int32_t unknown = -2, leaf = -1;
  };

  /// Arguments as for SizeRules. `demanded` quadrants are split in addition to those required by case and
  /// geometry, even below the case's `min`.
  SizeTree(const ShiftedOutline& outline, const TreeGrid& grid, const SizeOptions& options,
           SizeRules::Unresolved unresolved, const DemandedSplits& demanded);

  const SizeRules& rules() const { return rules_; }
  const TreeGrid& grid() const { return rules_.grid(); }
  const DemandedSplits& demanded() const { return rules_.demanded(); }
  int finest_level() const { return rules_.finest_level(); }
  int coarsest_level() const { return rules_.coarsest_level(); }

  /// The nodes of level 0, row by row.
  const std::vector<std::int32_t>& roots() const { return roots_; }
  std::int32_t root_of(const Quadrant& q) const;
  /// Whether the node has children, which are then created. Invalidates references to nodes and spans of
  /// segments.
  bool is_split(std::int32_t node);
  const Node& node(std::int32_t n) const { return nodes_[n]; }
  std::int32_t size() const { return size32(nodes_); }
  /// Reserves memory for the nodes of a forest with about this many cut leaves, to avoid copies as the number
  /// of nodes grows. Reserved memory that is not filled costs nothing.
  void expect_cut_leaves(double leaves);
  /// Frees all nodes but the roots. They are created again by queries; objects for queries must be
  /// constructed again.
  void forget();
  /// The segments that meet the interior of the node, in ascending order.
  std::span<const std::int32_t> segments_of(const Node& node) const {
    return part(segments_, node.segments_begin, node.segments_end);
  }

 private:
  static std::span<const std::int32_t> part(const std::vector<std::int32_t>& all, std::int32_t begin,
                                            std::int32_t end) {
    return {all.data() + begin, all.data() + end};
  }
  SizedQuadrant sized(const Node& node, const Box& box) const;
  void grow(std::int32_t node);
  void add(Node node, const Box& box, const Node& parent);

  SizeRules rules_;
  std::vector<std::int32_t> roots_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> segments_;
  std::vector<std::int32_t> corners_;
  /// For the node being split: for each segment the quarters that it meets.
  std::vector<std::uint8_t> passed_;
};

}  // namespace quadloop
