#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "adapt/sensor/mark.hpp"
#include "adapt/sensor/ordered_values.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// Refines where log10 e is more than `refine` standard deviations above the mean, coarsens where it is more
/// than `coarsen` below.
struct DeviationRule {
  double refine = 1, coarsen = 0.5;
};

/// Refines the fraction `refine` of the leaves with cells that have the largest indicators, coarsens the
/// fraction `coarsen` with the smallest.
struct FractionRule {
  double refine = 0.2, coarsen = 0.1;
};

/// For a target number of nodes: refines nothing, coarsens like DeviationRule. The caller, who can count
/// nodes, finds the refinement threshold with OrderedValues::refine_threshold and flags_above.
struct NodesRule {
  double coarsen = 0.5;
};

using ThresholdRule = std::variant<DeviationRule, FractionRule, NodesRule>;

/// Mean and standard deviation of log10 max(e, 1e-6 of the largest e) over the leaves with cells; both 0 if
/// no e is positive.
struct IndicatorStatistics {
  double mean = 0, deviation = 0;
  double floor = 0;   ///< 1e-6 of the largest
  bool flat = false;  ///< all e are equal within 1e-9 of the largest, a difference that rounding may cause
};

/// The same bits on any number of ranks. *Collective.*
IndicatorStatistics statistics_of(const Communicator& comm, const OrderedValues& values);

/// Thresholds by a rule; they mark nothing if all indicators are equal. *Collective.*
Thresholds thresholds_by(const ThresholdRule& rule, const OrderedValues& values,
                         const IndicatorStatistics& statistics);

/// The marks by given thresholds, one per local leaf; leaves without cells are kept. Local.
std::vector<RefinementFlag> flags_above(std::span<const LeafRecord> leaves, std::span<const double> values,
                                        const Thresholds& thresholds);

/// The number of leaves with the mark, over all ranks. *Collective.*
std::int64_t count_of(const Communicator& comm, std::span<const RefinementFlag> flags, RefinementFlag mark);

}  // namespace quadloop::adapt
