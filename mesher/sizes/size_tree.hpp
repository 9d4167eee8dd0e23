#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/sizes/size_rules.hpp"

namespace quadloop {

/// The *wanted* tree: the quadrants that the rules ask to split, and the index of what lies in each. It grows
/// as it is asked for, by functions that are not const; so a rank holds no more of it than it looks at, and
/// no answer depends on what was asked before. Questions about quadrants are asked through objects that their
/// callers hold, which make it grow: SizeCursor, Gradation, LeavesAhead.
class SizeTree {
 public:
  struct Node {
    Quadrant quadrant;
    std::int32_t parent = -1;
    std::int32_t children = unknown;  ///< index of the first of four, or one of the two below
    std::int32_t segments_begin = 0, segments_end = 0;
    std::int32_t corners_begin = 0, corners_end = 0;
    bool plain = false;                            ///< as in SizeRules::Judgement
    std::int8_t finest = 0;                        ///< as there
    std::int16_t winding = 0;                      ///< number of the outline round the lower left corner
    std::int32_t demanded = DemandedSplits::none;  ///< its number there
    std::int32_t deepest_split = -1;  ///< level of the deepest split node known at or below this one
    static constexpr std::int32_t unknown = -2, leaf = -1;
  };

  /// As SizeRules. `demanded` are split beside those that case and geometry ask to, also below the case's
  /// `min`.
  SizeTree(const ShiftedOutline& outline, const Lattice& lattice, const SizeOptions& options,
           SizeRules::Unresolved unresolved, const DemandedSplits& demanded);

  const SizeRules& rules() const { return rules_; }
  const Lattice& lattice() const { return rules_.lattice(); }
  const DemandedSplits& demanded() const { return rules_.demanded(); }
  int finest_level() const { return rules_.finest_level(); }
  int coarsest_level() const { return rules_.coarsest_level(); }

  /// The nodes of level 0, row by row.
  const std::vector<std::int32_t>& roots() const { return roots_; }
  std::int32_t root_of(const Quadrant& q) const;
  /// Whether the node has children; it has got them then. References to nodes and spans of segments may be
  /// stale after it.
  bool is_split(std::int32_t node);
  const Node& node(std::int32_t n) const { return nodes_[n]; }
  std::int32_t size() const { return size32(nodes_); }
  /// Makes room for the nodes that a forest with about so many cut leaves asks for: without it all nodes are
  /// copied each time their number doubles. Room that is not filled takes no memory.
  void expect_cut_leaves(double leaves);
  /// Gives up all nodes but the roots, and their memory. They grow again where they are asked for: objects
  /// that ask are to be made anew.
  void forget();
  /// The segments that meet the inside of the node, in ascending order.
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
  std::vector<std::uint8_t> passed_;  ///< of the node that grows: by segment, the quarters that it meets
};

}  // namespace quadloop
