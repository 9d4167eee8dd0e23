#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "adapt/sensor/mark.hpp"
#include "adapt/sensor/ordered_values.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Refine where log10 e lies more than `refine` deviations above the mean, coarsen where more than `coarsen`
/// below it.
struct DeviationRule {
  double refine = 1, coarsen = 0.5;
};

/// Refine the share `refine` of the leaves with cells that have the largest indicators, coarsen the share
/// `coarsen` that have the smallest.
struct FractionRule {
  double refine = 0.2, coarsen = 0.1;
};

/// The mesh is to have a number of nodes: refine nothing yet, coarsen as DeviationRule does. Who can count
/// nodes then looks for the refine threshold with OrderedValues::refine_threshold and marks_above.
struct NodesRule {
  double coarsen = 0.5;
};

using ThresholdRule = std::variant<DeviationRule, FractionRule, NodesRule>;

/// Mean and deviation of log10 max(e, 1e-6 of the largest e) over the leaves with cells; both 0 where there
/// is no e > 0.
struct IndicatorStatistics {
  double mean = 0, deviation = 0;
  double floor = 0;   ///< 1e-6 of the largest
  bool flat = false;  ///< all e are equal, to a 1e-9th of the largest, which rounding alone may put between
                      ///< equal changes
};

/// The same bits on any number of ranks. *Collective.*
IndicatorStatistics statistics_of(const Communicator& comm, const OrderedValues& values);

/// Thresholds by a rule; where all indicators are equal they mark nothing, whatever the rule. *Collective.*
Thresholds thresholds_by(const ThresholdRule& rule, const OrderedValues& values,
                         const IndicatorStatistics& statistics);

/// The marks by given thresholds, one for each leaf of this rank's share, from its indicator; leaves without
/// cells are kept. Local.
std::vector<Mark> marks_above(std::span<const LeafRecord> leaves, std::span<const double> values,
                              const Thresholds& thresholds);

/// How many of all ranks' leaves have the mark. *Collective.*
std::int64_t count_of(const Communicator& comm, std::span<const Mark> marks, Mark mark);

}  // namespace quadloop
