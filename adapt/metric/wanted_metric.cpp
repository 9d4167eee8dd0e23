#include "adapt/metric/wanted_metric.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/metric/gradation.hpp"
#include "adapt/sensor/recovery/hessians.hpp"
#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop {

namespace {

/// Of the largest eigenvalue anywhere: smaller ones are taken to be so large.
constexpr double least_bend = 1e-8;

/// The absolute hessians of the variables at owned nodes and copies, one within all; empty where all are
/// linear.
std::vector<Symmetric> joint_hessians(const Communicator& comm, const Mesh& mesh, const Field& field) {
  const Field shared = with_copies(comm, mesh, field);
  std::vector<Symmetric> joint;
  for (std::size_t v = 0; v < shared.width(); ++v) {
    const ScaledField scaled = scaled_by_range(comm, shared.column(v));
    if (scaled.constant) continue;
    const std::vector<Hessian> hessians = node_hessians(comm, mesh, scaled);
    double largest = 0;
    for (const Hessian& h : hessians) largest = std::max(largest, largest_eigenvalue(h));
    largest = comm.maximum(largest);
    if (!(largest > 0)) continue;
    const bool first = joint.empty();
    if (first) joint.resize(hessians.size());
    for (std::size_t i = 0; i < hessians.size(); ++i) {
      Eigen2 e = eigen_of({hessians[i].xx, hessians[i].xy, hessians[i].yy});
      e.larger = std::max(e.larger, least_bend * largest);
      e.smaller = std::max(e.smaller, least_bend * largest);
      const Metric own{symmetric_of(e)};
      joint[i] = first ? own : intersection(Metric{joint[i]}, own);
    }
  }
  return joint;
}

std::vector<LogMetric> logs_of(const std::vector<Metric>& metrics) {
  std::vector<LogMetric> logs;
  logs.reserve(metrics.size());
  for (const Metric& m : metrics) logs.push_back(log_of(m));
  return logs;
}

}  // namespace

WantedMetric::WantedMetric(const Communicator& comm, const Mesh& mesh, const Field& field, double norm,
                           SizeBounds bounds)
    : comm_{comm}, mesh_{mesh}, bounds_{std::move(bounds)} {
  check_field(comm, mesh, field, FieldSign::any);
  for (const CellShape& shape : cell_shapes(mesh)) areas_.push_back(shape.area);
  for (const Symmetric& h : joint_hessians(comm, mesh, field)) {
    const double determinant = density_of(Metric{h}) * density_of(Metric{h});
    shapes_.emplace_back(std::pow(determinant, -1 / (2 * norm + 2)) * h);
  }
  if (comm.any(!shapes_.empty())) total_ = integral(shapes_);
}

double WantedMetric::integral(const std::vector<Metric>& metrics) const {
  std::vector<double> terms;
  terms.reserve(areas_.size());
  const auto add = [&](const auto& nodes) {
    double density = 0;
    for (const NodeId node : nodes) density += density_of(metrics[node.value()]);
    terms.push_back(areas_[terms.size()] * density / static_cast<double>(nodes.size()));
  };
  for (const auto& nodes : mesh_.triangles) add(nodes);
  for (const auto& nodes : mesh_.quads) add(nodes);
  return reproducible_sum(comm_, terms);
}

Metric WantedMetric::within_bounds(const Metric& metric, double most) const {
  Eigen2 e = eigen_of(intersection(metric, isotropic(most)));
  const double ceiling = 1 / (bounds_.min * bounds_.min);
  e.larger = std::min(e.larger, ceiling);
  e.smaller = std::min(std::max(e.smaller, 0x1p-46 * e.larger), ceiling);
  return Metric{symmetric_of(e)};
}

std::vector<Metric> WantedMetric::bounded(double factor) const {
  std::vector<Metric> metrics;
  metrics.reserve(shapes_.size());
  for (std::size_t i = 0; i < shapes_.size(); ++i)
    metrics.push_back(within_bounds(Metric{factor * shapes_[i]}, bounds_.most[i]));
  limit_growth(comm_, mesh_, bounds_.slope, metrics);
  return metrics;
}

std::vector<LogMetric> WantedMetric::of_complexity(double complexity) const {
  constexpr int most_steps = 12;
  constexpr double near = 0.02, longest_step = 8, least_factor = 1e-6;
  const double first = complexity / total_;
  double factor = first, factor_before = 0, found_before = 0;
  std::vector<Metric> metrics;
  for (int step = 0; step < most_steps; ++step) {
    metrics = bounded(factor);
    const double found = integral(metrics);
    if (std::abs(found / complexity - 1) < near || factor < least_factor * first) break;
    // Bounds add what does not grow with the factor: by secants, the first of them through nought.
    const double slope = (found - found_before) / (factor - factor_before);
    const double next = slope > 0 ? factor + (complexity - found) / slope : factor * complexity / found;
    factor_before = factor;
    found_before = found;
    factor = std::clamp(next, factor / longest_step, factor * longest_step);
  }
  return logs_of(metrics);
}

std::vector<LogMetric> WantedMetric::before_bounds(double complexity) const {
  return logs_of(bounded(complexity / total_));
}

}  // namespace quadloop
