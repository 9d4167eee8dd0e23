#include "adapt/sensor/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::adapt {

namespace {

/// Thresholds below `floor` select all leaves, as indicators count as at least `floor`.
double refine_threshold_from(double logarithm, double floor) {
  const double threshold = std::pow(10, logarithm);
  return threshold < floor ? -1 : threshold;  // below all indicators, 0 included
}

double coarsen_threshold_from(double logarithm, double floor) {
  const double threshold = std::pow(10, logarithm);
  return threshold > floor ? threshold : 0;
}

/// The thresholds of each kind of rule, if the indicators differ.
struct ByRule {
  const OrderedValues& values;
  const IndicatorStatistics& statistics;

  Thresholds operator()(const DeviationRule& rule) const {
    const double mean = statistics.mean, deviation = statistics.deviation;
    return {refine_threshold_from(mean + rule.refine * deviation, statistics.floor),
            coarsen_threshold_from(mean - rule.coarsen * deviation, statistics.floor)};
  }
  Thresholds operator()(const FractionRule& rule) const {
    return {values.refine_threshold(rule.refine), values.coarsen_threshold(rule.coarsen)};
  }
  Thresholds operator()(const NodesRule& rule) const {
    return {Thresholds{}.refine,
            coarsen_threshold_from(statistics.mean - rule.coarsen * statistics.deviation, statistics.floor)};
  }
};

}  // namespace

IndicatorStatistics statistics_of(const Communicator& comm, const OrderedValues& values) {
  IndicatorStatistics statistics;
  const double largest = values.largest();
  statistics.flat = largest - values.smallest() <= 1e-9 * largest;
  if (largest == 0) return statistics;
  statistics.floor = std::max(1e-6 * largest, std::numeric_limits<double>::denorm_min());
  std::vector<double> terms;
  terms.reserve(values.own().size());
  for (const double value : values.own()) terms.push_back(std::log10(std::max(value, statistics.floor)));
  const auto count = static_cast<double>(values.count());
  statistics.mean = reproducible_sum(comm, terms) / count;
  for (double& term : terms) term = (term - statistics.mean) * (term - statistics.mean);
  statistics.deviation = std::sqrt(reproducible_sum(comm, terms) / count);
  return statistics;
}

Thresholds thresholds_by(const ThresholdRule& rule, const OrderedValues& values,
                         const IndicatorStatistics& statistics) {
  return statistics.flat ? Thresholds{} : std::visit(ByRule{values, statistics}, rule);
}

std::vector<RefinementFlag> flags_above(std::span<const LeafRecord> leaves, std::span<const double> values,
                                        const Thresholds& thresholds) {
  QUADLOOP_REQUIRE(leaves.size() == values.size(), "there must be one indicator for each leaf", leaves.size(),
                   values.size());
  std::vector<RefinementFlag> flags(leaves.size(), RefinementFlag::keep);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (!has_cells(leaves[i])) continue;
    if (values[i] > thresholds.refine) {
      flags[i] = RefinementFlag::refine;
    } else if (values[i] < thresholds.coarsen) {
      flags[i] = RefinementFlag::coarsen;
    }
  }
  return flags;
}

std::int64_t count_of(const Communicator& comm, std::span<const RefinementFlag> flags, RefinementFlag mark) {
  return comm.sum(std::int64_t{std::count(flags.begin(), flags.end(), mark)});
}

}  // namespace quadloop::adapt
