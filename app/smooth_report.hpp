#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/quality.hpp"
#include "smoother/shape_histogram.hpp"

namespace quadloop {

/// What a mesh was like at one moment, over all ranks.
struct ShapeReport {
  QualitySummary quality;
  std::vector<Histogram> histograms;
};

/// *Collective.*
ShapeReport report_shapes(const Communicator& comm, const Mesh& mesh);

/// Worst and mean quality, angles and histograms in two columns.
std::string comparison_table(const ShapeReport& before, const ShapeReport& after);

}  // namespace quadloop
