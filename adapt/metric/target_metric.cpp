#include "adapt/metric/target_metric.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/metric/gradation.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop::adapt {

namespace {

std::vector<LogMetric> logs_of(const std::vector<Metric>& metrics) {
  std::vector<LogMetric> logs;
  logs.reserve(metrics.size());
  for (const Metric& m : metrics) logs.push_back(log_of(m));
  return logs;
}

}  // namespace

TargetMetric::TargetMetric(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends,
                           double norm, SizeBounds bounds)
    : comm_{comm}, mesh_{mesh}, bounds_{std::move(bounds)} {
  for (const CellShape& shape : cell_shapes(mesh)) areas_.push_back(shape.area);
  for (const Symmetric& h : bends) {
    const double determinant = density_of(Metric{h}) * density_of(Metric{h});
    shapes_.emplace_back(std::pow(determinant, -1 / (2 * norm + 2)) * h);
  }
  if (comm.any(!shapes_.empty())) total_ = integral(shapes_);
}

double TargetMetric::integral(const std::vector<Metric>& metrics) const {
  std::vector<double> terms;
  terms.reserve(areas_.size());
  const auto add = [&](const auto& nodes) {
    double density = 0;
    for (const NodeId node : nodes) density += density_of(metrics[node.value()]);
    terms.push_back(areas_[terms.size()] * density / static_cast<double>(nodes.size()));
  };
  mesh_.for_each_cell(add);
  return reproducible_sum(comm_, terms);
}

std::vector<double> least_at_facets(const Geometry& geometry, std::span<const Point> points) {
  const FacetZones facets(geometry);
  std::vector<double> least;
  if (facets.empty()) return least;
  least.reserve(points.size());
  for (const Point p : points) least.push_back(facets.least_size({p, p}));
  return least;
}

Metric TargetMetric::within_bounds(const Metric& metric, std::size_t node) const {
  const double most = bounds_.most[node];
  const double at_node = bounds_.least.empty() ? 0 : std::min(bounds_.least[node], most);
  const double min = std::max(bounds_.min, at_node);
  const double ceiling = 1 / (min * min), excess = eigen_of(metric).larger / ceiling;
  Eigen2 e = eigen_of(intersection(excess > 1 ? Metric{1 / excess * metric} : metric, isotropic(most)));
  e.larger = std::min(e.larger, ceiling);
  e.smaller = std::min(std::max(e.smaller, 0x1p-46 * e.larger), ceiling);
  return Metric{symmetric_of(e)};
}

std::vector<Metric> TargetMetric::bounded(double factor) const {
  std::vector<Metric> metrics;
  metrics.reserve(shapes_.size());
  for (std::size_t i = 0; i < shapes_.size(); ++i)
    metrics.push_back(within_bounds(Metric{factor * shapes_[i]}, i));
  limit_growth(comm_, mesh_, bounds_.slope, metrics);
  return metrics;
}

std::vector<LogMetric> TargetMetric::of_complexity(double complexity) const {
  constexpr int most_steps = 12;
  constexpr double near = 0.02, longest_step = 8, least_factor = 1e-6;
  const double first = complexity / total_;
  double factor = first, factor_before = 0, found_before = 0;
  std::vector<Metric> metrics;
  for (int step = 0; step < most_steps; ++step) {
    metrics = bounded(factor);
    const double found = integral(metrics);
    if (std::abs(found / complexity - 1) < near || factor < least_factor * first) break;
    // The limits add a part that does not grow with the factor: secant steps, the first through the origin.
    const double slope = (found - found_before) / (factor - factor_before);
    const double next = slope > 0 ? factor + (complexity - found) / slope : factor * complexity / found;
    factor_before = factor;
    found_before = found;
    factor = std::clamp(next, factor / longest_step, factor * longest_step);
  }
  return logs_of(metrics);
}

std::vector<LogMetric> TargetMetric::before_bounds(double complexity) const {
  return logs_of(bounded(complexity / total_));
}

}  // namespace quadloop::adapt
