#include "adapt/remesh/mark_family.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/sensor/wanted_size.hpp"

namespace quadloop {

namespace {

std::vector<double> leaf_values(const Communicator& comm, const AdaptOptions& options,
                                const SolvedMesh& solved) {
  const Field field = selected(solved.solution, options.variables, "adapt.variable");
  const auto& leaves = solved.tree.leaves;
  if (options.source == AdaptOptions::Source::size) return leaf_sizes(comm, solved.mesh, leaves, field);
  if (options.source == AdaptOptions::Source::error) return leaf_errors(comm, solved.mesh, leaves, field);
  return leaf_indicator(comm, solved.mesh, leaves, field, options.indicator);
}

ThresholdRule rule_of(const AdaptOptions& options) {
  if (options.threshold == AdaptOptions::Threshold::fraction)
    return FractionRule{options.refine, options.coarsen};
  if (options.threshold == AdaptOptions::Threshold::nodes) return NodesRule{options.coarsen};
  return DeviationRule{options.refine, options.coarsen};
}

}  // namespace

MarkFamily::MarkFamily(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved)
    : comm_{comm},
      solved_{solved},
      by_size_{options.source == AdaptOptions::Source::size},
      values_{leaf_values(comm, options, solved)} {
  if (by_size_) return;
  order_.emplace(comm, solved.tree.leaves, values_);
  statistics_ = statistics_of(comm, *order_);
  rule_ = thresholds_by(rule_of(options), *order_, statistics_);
  MarkedLeaves marked{marks_above(solved.tree.leaves, values_, rule_), {}};
  count_marks(comm, marked);
  const auto all = static_cast<double>(std::max<std::int64_t>(order_->count(), 1));
  if (options.threshold != AdaptOptions::Threshold::nodes)
    refined_share_ = static_cast<double>(marked.report.refined) / all;
  if (statistics_.flat) refined_share_ = 0;
  coarsened_share_ = static_cast<double>(marked.report.coarsened) / all;
}

std::vector<Mark> MarkFamily::marks(double at) const {
  if (by_size_) return size_marks(at);
  Thresholds thresholds = rule_;
  if (at < 1 || rule_.refine == Thresholds{}.refine)
    thresholds.refine = order_->refine_threshold(refined_share_ * std::max(at, 0.0));
  if (-at > coarsened_share_) thresholds.coarsen = order_->coarsen_threshold(-at);
  return marks_above(solved_.tree.leaves, values_, thresholds);
}

std::vector<Mark> MarkFamily::size_marks(double at) const {
  constexpr double most = 16;
  std::vector<double> sizes = values_;
  for (double& size : sizes) size *= std::pow(most, (1 - at) / 2);
  return mark_by_size(comm_, solved_.tree, sizes).marks;
}

}  // namespace quadloop
