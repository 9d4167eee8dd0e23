#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesher/geometry/shifted_outline.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/size_options.hpp"
#include "mesher/sizes/demanded_splits.hpp"
#include "mesher/sizes/proximity.hpp"

namespace quadloop {

/// A quadrant as the rules of sizes see it.
struct SizedQuadrant {
  Quadrant quadrant;
  Box box;
  std::span<const std::int32_t> segments;  ///< that meet its inside
  std::span<const std::int32_t> corners;   ///< vertices with a size of their own that it touches
  int finest_demanded = 0;  ///< level of the finest leaves demanded inside; 0: it need not be split for any
  bool made_by_demand = false;  ///< its parent was
};

/// What the case and the geometry in a quadrant ask of the leaves there, one quadrant alone. The answers
/// depend on geometry and options alone, so that every rank can give them for every quadrant.
class SizeRules {
 public:
  /// Tells whether this quadrant as a leaf, holding these segments, cannot be cut as it is.
  using Unresolved = std::function<bool(const Quadrant&, std::span<const std::int32_t>)>;

  /// The arguments but the options must outlive the rules.
  SizeRules(const ShiftedOutline& outline, const Lattice& lattice, const SizeOptions& options,
            Unresolved unresolved, const DemandedSplits& demanded);

  const ShiftedOutline& outline() const { return *outline_; }
  const Lattice& lattice() const { return *lattice_; }
  const DemandedSplits& demanded() const { return *demanded_; }
  std::span<const SizeSource> sources() const { return options_.sources; }
  int finest_level() const { return finest_; }      ///< of case and demands
  int coarsest_level() const { return coarsest_; }  ///< at which leaves are no larger than `max`
  /// (g - 1) / 2 for the gradation g, in units of 2^-slope_bits.
  std::int64_t slope() const { return slope_; }
  static constexpr int slope_bits = 20;
  /// The vertices that ask for a size of their own.
  std::vector<std::int32_t> sized_corners() const;

  bool wants_split(const SizedQuadrant& q) const;

  /// What can be said of a quadrant's leaves without splitting it. It may promise more than wants_split()
  /// then asks for, never less: wherever that holds, for the quadrant itself or one inside it, the level
  /// there is less than `finest` and, if the quadrant is plain, less than coarsest_level().
  struct Judgement {
    bool plain = false;  ///< nothing inside asks for leaves finer than `max` does; no leaf made by a demand
    int finest = 0;      ///< no leaf inside is deeper than this level; it may be reached or not
  };
  Judgement judge(const SizedQuadrant& q) const;

  /// The coarsest level that a source of this spacing is content with.
  int level_for(double spacing) const;
  /// The level that these segments ask for in a quadrant: by their spacing, and by curvature as if the
  /// outline turned evenly along it.
  int level_of_outline(const Quadrant& q, std::span<const std::int32_t> segments) const;

  /// Whether any of the domain can lie in the quadrant. Where none does, leaves may be larger than `max`: a
  /// wide root costs nothing.
  bool in_domains_box(const Quadrant& q) const;
  /// As chebyshev_gap.
  std::int64_t gap_to_domain(const Quadrant& q) const;

 private:
  /// The coarsest level of leaves no larger than this, as the case has them, looked for from another one.
  int level_within(double spacing, int from) const;
  bool turns_too_far(std::span<const std::int32_t> segments, const Box& box) const;

  const ShiftedOutline* outline_;
  const Lattice* lattice_;
  SizeOptions options_;
  const DemandedSplits* demanded_;
  Unresolved unresolved_;
  std::optional<Proximity> proximity_;
  std::vector<std::int8_t>
      level_of_segment_;  ///< the coarsest at which leaves are as small as it asks, or the finest
  std::vector<double> corner_spacing_;  ///< of each vertex, or 0; empty where no boundary asks
  /// Of each vertex, in turning_unit, 0 where it is kept as a corner; none without options_.curvature.
  std::vector<std::int64_t> turning_;
  int finest_of_case_;
  int finest_;
  int coarsest_;
  std::array<std::int64_t, 4> domain_{};  ///< lattice lines round the domain's box: left, right, bottom, top
  std::int64_t slope_;
};

}  // namespace quadloop
