#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesher/geometry/shifted_outline.hpp"
#include "mesher/grid/size_options.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "mesher/sizes/demanded_splits.hpp"
#include "mesher/sizes/proximity.hpp"

namespace quadloop {

/// A quadrant with the data for the size rules.
struct SizedQuadrant {
  Quadrant quadrant;
  Box box;
  std::span<const std::int32_t> segments;  ///< segments that meet its interior
  std::span<const std::int32_t> corners;   ///< vertices with a size of their own that it touches
  int finest_demanded = 0;      ///< level of the finest leaves demanded inside; 0: no demand to split
  bool made_by_demand = false;  ///< whether its parent was split by a demand
};

/// Sizes that case and geometry require of the leaves in a quadrant, for each quadrant independently. The
/// results depend only on geometry and options, so every rank can evaluate every quadrant.
class SizeRules {
 public:
  /// Whether this quadrant as a leaf with these segments cannot be cut.
  using Unresolved = std::function<bool(const Quadrant&, std::span<const std::int32_t>)>;

  /// All arguments except the options must outlive the object.
  SizeRules(const ShiftedOutline& outline, const TreeGrid& grid, const SizeOptions& options,
            Unresolved unresolved, const DemandedSplits& demanded);

  const ShiftedOutline& outline() const { return *outline_; }
  const TreeGrid& grid() const { return *grid_; }
  const DemandedSplits& demanded() const { return *demanded_; }
  std::span<const SizeSource> sources() const { return options_.sources; }
  int finest_level() const { return finest_; }      ///< by case and demands
  int coarsest_level() const { return coarsest_; }  ///< level at which leaves are no larger than `max`
  /// (g - 1) / 2 for the gradation g, in units of 2^-slope_bits.
  std::int64_t slope() const { return slope_; }
  static constexpr int slope_bits = 20;
  /// Returns the vertices with a size of their own.
  std::vector<std::int32_t> sized_corners() const;

  bool wants_split(const SizedQuadrant& q) const;

  /// Properties of a quadrant's leaves, found without splitting it. These are bounds for wants_split():
  /// wherever that is true, for the quadrant itself or one inside it, the level there is less than `finest`
  /// and, if the quadrant is plain, less than coarsest_level().
  struct Judgement {
    bool plain = false;  ///< no leaf inside needs to be finer than by `max`, and none is made by a demand
    int finest = 0;      ///< upper bound on the level of the leaves inside
  };
  Judgement judge(const SizedQuadrant& q) const;

  /// Returns the coarsest level that satisfies a source of this spacing.
  int level_for(double spacing) const;
  /// Returns the level that these segments require in a quadrant: by their spacing, and by curvature for
  /// uniform turning along the boundary.
  int level_of_outline(const Quadrant& q, std::span<const std::int32_t> segments) const;

  /// Whether part of the domain may lie in the quadrant. Elsewhere leaves may be larger than `max`, so a
  /// large root adds no cost.
  bool in_domains_box(const Quadrant& q) const;
  /// As chebyshev_gap().
  std::int64_t gap_to_domain(const Quadrant& q) const;

 private:
  /// Returns the coarsest level of leaves no larger than this, by the case, searching from another level.
  int level_within(double spacing, int from) const;
  bool turns_too_far(std::span<const std::int32_t> segments, const Box& box) const;

  const ShiftedOutline* outline_;
  const TreeGrid* grid_;
  SizeOptions options_;
  const DemandedSplits* demanded_;
  Unresolved unresolved_;
  std::optional<Proximity> proximity_;
  /// Coarsest level at which leaves are as small as the segment requires, at most the finest level.
  std::vector<std::int8_t> level_of_segment_;
  std::vector<double> corner_spacing_;  ///< for each vertex, or 0; empty if no boundary has a corner spacing
  /// For each vertex, in turning_unit, 0 at feature points; empty without options_.curvature.
  std::vector<std::int64_t> turning_;
  int finest_of_case_;
  int finest_;
  int coarsest_;
  /// Grid lines around the domain's bounding box: left, right, bottom, top.
  std::array<std::int64_t, 4> domain_{};
  std::int64_t slope_;
};

}  // namespace quadloop
