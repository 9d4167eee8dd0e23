#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adapt/sensor/indicator.hpp"
#include "adapt/sensor/measured_friction.hpp"
#include "adapt/sensor/thresholds.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/base/word_table.hpp"

namespace quadloop::adapt {

/// Adaptation options of a case.
struct AdaptOptions {
  /// The loop ends when the changes from one cycle to the next are below these values; all that are given
  /// count.
  struct Until {
    std::optional<double> cl = {}, cd = {};
    std::optional<double> estimate = {};  ///< relative to the cycle before

    bool empty() const { return !cl && !cd && !estimate; }
    friend bool operator==(const Until&, const Until&) = default;
  };
  /// Source of the refinement flags: differences of variables, or a size or error field written by the
  /// solver.
  enum class Source { variables, size, error };
  enum class Threshold { deviation, fraction, nodes };  ///< rule for how many quadtree cells are flagged
  static constexpr WordTable<Threshold, 3> threshold_words{
      {{"deviation", Threshold::deviation}, {"fraction", Threshold::fraction}, {"nodes", Threshold::nodes}}};

  int cycles = 5;  ///< number of adaptations; there is one more solve
  int passes = 0;  ///< initial adaptation passes with loosely converged solutions, before cycle 0
  Source source = Source::variables;
  std::vector<std::string> variables{"density"};  ///< or the single size or error field
  Indicator indicator = Indicator::difference;
  Threshold threshold = Threshold::deviation;
  /// Standard deviations above and below the mean, or fractions of the quadtree cells.
  double refine = DeviationRule{}.refine, coarsen = DeviationRule{}.coarsen;
  std::optional<std::int64_t> max_nodes;  ///< upper limit; the target for Threshold::nodes
  /// The p of the L^p norm of the interpolation error that the target sizes minimise for max_nodes nodes;
  /// empty: quadtree cells are flagged instead.
  std::optional<double> norm;
  std::optional<double> growth;  ///< with a norm: maximum ratio of nodes to those of the previous mesh
  Until until;
  /// Smallest quadtree cell for adaptation, in the geometry's unit; empty: that of the case.
  std::optional<double> min;
  /// Whether quadtree cells at facets of the geometry (FacetZones) may be smaller than half of the segments
  /// there.
  bool facets = false;
  TransferKind transfer = TransferKind::linear;
  /// If set, first heights of layers follow the wall shear of a solution.
  std::optional<WallFlow> wall_flow;
};

}  // namespace quadloop::adapt
