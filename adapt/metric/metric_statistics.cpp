#include "adapt/metric/metric_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::adapt {

namespace {

template <class Limits, class Bins>
void count(const Limits& limits, double value, Bins& bins) {
  ++bins[std::ranges::upper_bound(limits, value) - limits.begin()];
}

}  // namespace

MetricStatistics metric_statistics(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<LogMetric>& metrics) {
  MetricStatistics statistics;
  std::vector<Metric> at;
  at.reserve(metrics.size());
  for (const LogMetric& m : metrics) at.push_back(exp_of(m));
  const auto count_edge = [&](NodeId a, NodeId b) {
    const double length = length_between(at[a.value()], at[b.value()], mesh.point(b) - mesh.point(a));
    count(MetricStatistics::length_limits, length, statistics.edges);
  };
  std::vector<double> terms;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) count_edge(t[k], t[(k + 1) % 3]);
    const Metric &a = at[t[0].value()], &b = at[t[1].value()], &c = at[t[2].value()];
    const Point p = mesh.point(t[0]), q = mesh.point(t[1]), r = mesh.point(t[2]);
    const double quality = quality_in(1.0 / 3 * (a + b + c), p, q, r);
    count(MetricStatistics::quality_limits, quality, statistics.triangles);
    statistics.worst_quality = std::min(statistics.worst_quality, quality);
    terms.push_back(0.5 * cross(q - p, r - p) * (density_of(a) + density_of(b) + density_of(c)) / 3);
  }
  // Counts edges with one triangle again, so that every edge is counted twice.
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges) count_edge(edge[0], edge[1]);
  }
  for (auto& edges : statistics.edges) edges = comm.sum(edges) / 2;
  for (auto& triangles : statistics.triangles) triangles = comm.sum(triangles);
  statistics.worst_quality = comm.minimum(statistics.worst_quality);
  statistics.complexity = reproducible_sum(comm, terms);
  return statistics;
}

namespace {

template <class Limits, class Counts>
JsonObject histogram(const Limits& limits, const Counts& counts) {
  JsonObject json;
  json.add("limits", std::vector<double>(limits.begin(), limits.end()));
  json.add("counts", std::vector<std::int64_t>(counts.begin(), counts.end()));
  return json;
}

/// Fractions in percent, with the limits between them.
template <class Limits, class Counts>
std::string shares(const Limits& limits, const Counts& counts) {
  const auto all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (i > 0) text += fmt::format(" |{:.2g}| ", limits[i - 1]);
    text += fmt::format("{:.1f} %", 100 * static_cast<double>(counts[i]) / std::max(all, 1.0));
  }
  return text;
}

}  // namespace

JsonObject record_of(const MetricStatistics& statistics) {
  JsonObject json, quality = histogram(MetricStatistics::quality_limits, statistics.triangles);
  quality.add("worst", statistics.worst_quality);
  json.add("complexity", statistics.complexity);
  json.add("edges", histogram(MetricStatistics::length_limits, statistics.edges));
  json.add("quality", quality);
  return json;
}

std::string lines_of(const MetricStatistics& statistics) {
  return fmt::format(
      "complexity of the metric {:.1f}\nedges by length in the metric {}\ntriangles by quality in the metric "
      "{}, worst {:.3f}\n",
      statistics.complexity, shares(MetricStatistics::length_limits, statistics.edges),
      shares(MetricStatistics::quality_limits, statistics.triangles), statistics.worst_quality);
}

}  // namespace quadloop::adapt
