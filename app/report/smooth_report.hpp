#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "smoother/shape_histogram.hpp"

namespace quadloop::app {

/// Shape statistics of a mesh, over all ranks.
struct ShapeReport {
  QualitySummary quality;
  std::optional<QualitySummary> outside;  ///< of the cells outside layers, if there are layers
  std::vector<smoother::Histogram> histograms;
  AreaRatios areas;
};

/// *Collective.*
ShapeReport report_shapes(const Communicator& comm, const Mesh& mesh);

/// Returns the members of a record; each histogram as {"limits", "counts"}.
JsonObject record_of(const ShapeReport& report);

/// Returns worst and mean quality and angles (of the cells outside layers, if there are layers), area ratios
/// and histograms in two columns.
std::string comparison_table(const ShapeReport& before, const ShapeReport& after);

}  // namespace quadloop::app
