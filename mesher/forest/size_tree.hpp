#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesher/forest/demanded_splits.hpp"
#include "mesher/forest/lattice.hpp"
#include "mesher/forest/size_options.hpp"
#include "mesher/geometry/gap_test.hpp"
#include "mesher/geometry/shifted_outline.hpp"

namespace quadloop {

/// Which quadrants must be split: those that the case and the geometry inside them ask to (the *wanted*
/// tree), and those that gradation then forbids to be so large. The answer depends on geometry and options
/// alone, so that every rank can give it for every quadrant without asking another one. The wanted tree grows
/// as it is asked for, and it is the index of the segments too.
///
/// Gradation: a leaf of size h at Chebyshev gap d from a leaf of the wanted tree of size h' has h <= h' +
/// (g-1)/2 d. The result is the smallest such tree. It follows that two leaves of the final tree which touch
/// differ by at most one level.
class SizeTree {
 public:
  /// Tells whether a leaf of this place, holding these segments, cannot be cut as it is.
  using Unresolved = std::function<bool(const Quadrant&, std::span<const std::int32_t>)>;

  /// The arguments but the options must outlive the tree. `demanded` are split beside those that case and
  /// geometry ask to, also below the case's `min`.
  SizeTree(const ShiftedOutline& outline, const Lattice& lattice, const SizeOptions& options,
           Unresolved unresolved, const DemandedSplits& demanded);

  const Lattice& lattice() const { return *lattice_; }
  int finest_level() const { return finest_; }
  int coarsest_level() const { return coarsest_; }  ///< at which leaves are no larger than `max`

  /// Whether the quadrant must be split. Constant time on average where the quadrants come in the order of
  /// the curve.
  bool must_split(const Quadrant& q);
  /// The segments that meet the inside of the quadrant, in ascending order; valid until the next call.
  std::span<const std::int32_t> segments_in(const Quadrant& q);
  /// The level at which case, geometry and demands alone would have stopped at this leaf's place.
  int wanted_level(const Quadrant& leaf);
  /// A guess of how many leaves a quadrant that must be split will hold in the end, at least 1: good enough
  /// to tell where most are to be looked for.
  double leaves_ahead(const Quadrant& q);
  const DemandedSplits& demanded() const { return *demanded_; }

 private:
  struct Node {
    Quadrant place;
    std::int32_t parent = -1;
    std::int32_t children = unknown;  ///< index of the first of four, or one of the two below
    std::int32_t segments_begin = 0, segments_end = 0;
    std::int32_t corners_begin = 0, corners_end = 0;  ///< those with a size of their own that it touches
    bool plain = false;  ///< nothing inside asks for leaves finer than `max` does; no leaf made by a demand
    std::int8_t finest = 0;  ///< no leaf inside is deeper than this level; it may be reached or not
    std::int32_t demanded = DemandedSplits::none;  ///< its number there
    std::int32_t deepest_split = -1;  ///< level of the deepest split node known at or below this one
    static constexpr std::int32_t unknown = -2, leaf = -1;
  };
  /// One step of the path from the root to the quadrant last asked for.
  struct Step {
    Quadrant place;
    std::vector<std::int32_t> near;  ///< split nodes of half this size that may force a child of it to split
    bool has_near = false;
  };

  std::int32_t root_of(const Quadrant& q) const;
  bool is_split(std::int32_t node);
  void grow(std::int32_t node);
  void take_corners(Node& node, const Node& parent, const Box& box);
  std::span<const std::int32_t> corners_of(const Node& node) const;
  void judge(Node& node, const Box& box) const;
  bool in_domains_box(const Quadrant& q) const;
  std::int64_t gap_to_domain(const Quadrant& q) const;
  int level_for(double spacing) const;
  bool wants_split(const Node& node);
  bool turns_too_far(std::span<const std::int32_t> segments, const Box& box);
  std::int32_t deepest_node_at(const Quadrant& q);
  int level_ahead(std::int32_t node);
  int level_of_outline(const Node& node) const;
  double source_leaves(const Quadrant& q) const;

  Step& step_above(const Quadrant& q);
  void fill_near(Step& step, const std::vector<std::int32_t>& parents);
  bool forced(const Quadrant& q, const std::vector<std::int32_t>& near);
  bool forced_by(const Quadrant& q, std::int32_t node);

  const ShiftedOutline* outline_;
  const Lattice* lattice_;
  SizeOptions options_;
  const DemandedSplits* demanded_;
  Unresolved unresolved_;
  std::optional<GapTest> gap_test_;
  std::vector<double> spacing_;         ///< of each segment
  std::vector<double> corner_spacing_;  ///< of each vertex, 0 where it asks for none
  std::vector<std::int64_t> turning_;   ///< of each vertex, in 2^-20 degrees, 0 where it is kept as a corner
  int finest_of_case_;
  int finest_;  ///< of case and demands
  int coarsest_;
  std::array<std::int64_t, 4> domain_{};  ///< lattice lines round the domain's box: left, right, bottom, top
  std::int64_t slope_;                    ///< (g-1)/2 in units of 2^-20
  std::vector<Node> nodes_;
  std::vector<std::int32_t> segments_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int32_t> found_;
  std::vector<std::pair<BoundaryId, std::int64_t>> turned_;  ///< of the quadrant looked at
  std::int32_t cursor_ = -1;                                 ///< node last asked for
  std::vector<Step> path_;
  std::vector<std::int32_t> roots_;
  std::vector<std::int8_t> levels_ahead_;  ///< of nodes, as far as they were asked for; 0: not yet
};

}  // namespace quadloop
