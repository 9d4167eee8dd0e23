#include "adapt/remesh/demands/mark_family.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/sensor/target_size.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

std::vector<double> leaf_values(const Communicator& comm, const AdaptOptions& options,
                                const SolvedMesh& solved) {
  const Field field = selected(solved.solution, options.variables, "adapt.variable");
  const auto& leaves = solved.tree.leaves;
  switch (options.source) {
    case AdaptOptions::Source::variables:
      return leaf_indicator(comm, solved.mesh, leaves, field, options.indicator);
    case AdaptOptions::Source::size: return leaf_sizes(comm, solved.mesh, leaves, field);
    case AdaptOptions::Source::error: return leaf_errors(comm, solved.mesh, leaves, field);
  }
  QUADLOOP_REQUIRE(false, "a source without values for leaves");
  return {};
}

ThresholdRule rule_of(const AdaptOptions& options) {
  switch (options.threshold) {
    case AdaptOptions::Threshold::deviation: return DeviationRule{options.refine, options.coarsen};
    case AdaptOptions::Threshold::fraction: return FractionRule{options.refine, options.coarsen};
    case AdaptOptions::Threshold::nodes: return NodesRule{options.coarsen};
  }
  QUADLOOP_REQUIRE(false, "a threshold without a rule");
  return {};
}

}  // namespace

MarkFamily::MarkFamily(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
                       std::optional<MirrorAxis> mirror)
    : solved_{solved},
      by_size_{options.source == AdaptOptions::Source::size},
      values_{leaf_values(comm, options, solved)} {
  if (mirror)
    agree_with_images(comm, *mirror, solved.tree, by_size_ ? OfImages::smaller : OfImages::larger, values_);
  if (by_size_) return;
  order_.emplace(comm, solved.tree.leaves, values_);
  statistics_ = statistics_of(comm, *order_);
  rule_ = thresholds_by(rule_of(options), *order_, statistics_);
  const std::vector<RefinementFlag> flags = flags_above(solved.tree.leaves, values_, rule_);
  const auto all = static_cast<double>(std::max<std::int64_t>(order_->count(), 1));
  const auto share_of = [&](RefinementFlag mark) {
    return static_cast<double>(count_of(comm, flags, mark)) / all;
  };
  if (options.threshold != AdaptOptions::Threshold::nodes) refined_share_ = share_of(RefinementFlag::refine);
  if (statistics_.flat) refined_share_ = 0;
  coarsened_share_ = share_of(RefinementFlag::coarsen);
}

std::vector<RefinementFlag> MarkFamily::flags(double at) const {
  if (by_size_) return size_flags(at);
  Thresholds thresholds = rule_;
  if (at < 1 || rule_.refine == Thresholds{}.refine)
    thresholds.refine = order_->refine_threshold(refined_share_ * std::max(at, 0.0));
  if (-at > coarsened_share_) thresholds.coarsen = order_->coarsen_threshold(-at);
  return flags_above(solved_.tree.leaves, values_, thresholds);
}

std::vector<RefinementFlag> MarkFamily::size_flags(double at) const {
  constexpr double most = 16;
  std::vector<double> sizes = values_;
  for (double& size : sizes) size *= std::pow(most, (1 - at) / 2);
  return mark_by_size(solved_.tree, sizes);
}

}  // namespace quadloop::adapt
