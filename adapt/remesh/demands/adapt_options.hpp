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

namespace quadloop {

/// What a case says of adaptation.
struct AdaptOptions {
  /// Changes from one cycle to the next below which the cycles end; those that are given all count.
  struct Until {
    std::optional<double> cl = {}, cd = {};
    std::optional<double> estimate = {};  ///< relative to the cycle before

    bool empty() const { return !cl && !cd && !estimate; }
    friend bool operator==(const Until&, const Until&) = default;
  };
  /// What marks are made from: differences of variables, or a field that the solver wrote for it.
  enum class Source { variables, size, error };
  enum class Threshold { deviation, fraction, nodes };  ///< how many leaves are marked
  static constexpr WordTable<Threshold, 3> threshold_words{
      {{"deviation", Threshold::deviation}, {"fraction", Threshold::fraction}, {"nodes", Threshold::nodes}}};

  int cycles = 5;  ///< adaptations; there is one more solve
  int passes = 0;  ///< adaptations by flows that are solved roughly, before cycle 0
  Source source = Source::variables;
  std::vector<std::string> variables{"density"};  ///< or the one size or error field
  Indicator indicator = Indicator::difference;
  Threshold threshold = Threshold::deviation;
  /// Deviations above and below the mean, or shares of the leaves.
  double refine = DeviationRule{}.refine, coarsen = DeviationRule{}.coarsen;
  std::optional<std::int64_t> max_nodes;  ///< a cap; the target for Threshold::nodes
  /// The p of the L^p norm of the interpolation error that sizes are to make least, for max_nodes nodes;
  /// none: leaves are marked instead.
  std::optional<double> norm;
  std::optional<double> growth;  ///< with a norm: at most so many times the nodes of the mesh before
  Until until;
  /// Leaf size that adaptation may reach, in the geometry's unit; none: that of the case.
  std::optional<double> min;
  /// Whether leaves at facets of the outline (FacetZones) may become smaller than half of the segments there.
  bool facets = false;
  TransferKind transfer = TransferKind::linear;
  /// Where first heights of layers are to follow the wall shear of a solution.
  std::optional<WallFlow> wall_flow;
};

}  // namespace quadloop
