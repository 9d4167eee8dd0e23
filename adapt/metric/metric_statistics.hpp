#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/json.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Statistics of how a mesh of triangles conforms to a metric; the same on every rank.
struct MetricStatistics {
  /// Limits of edge lengths in the metric; the first count is below the first limit, the last from the last
  /// limit on.
  static constexpr std::array length_limits{0.5, 0.70710678118654752, 1.0, 1.4142135623730951, 2.0};
  static constexpr std::array quality_limits{0.2, 0.4, 0.6, 0.8};

  double complexity = 0;  ///< of the metric on this mesh: the integral of its density
  std::array<std::int64_t, length_limits.size() + 1> edges{};
  std::array<std::int64_t, quality_limits.size() + 1> triangles{};  ///< by quality_in() the metric
  double worst_quality = 1;
};

/// {"complexity": ..., "edges": {"limits": [...], "counts": [...]}, "quality": {..., "worst": ...}}
JsonObject record_of(const MetricStatistics& statistics);

/// Two histograms as text, one line each.
std::string lines_of(const MetricStatistics& statistics);

/// `metrics` has one entry per owned node and ghost copy. *Collective.*
MetricStatistics metric_statistics(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<LogMetric>& metrics);

}  // namespace quadloop::adapt
