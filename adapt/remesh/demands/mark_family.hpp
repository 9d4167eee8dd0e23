#pragma once

#include <optional>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/sensor/ordered_values.hpp"
#include "adapt/sensor/thresholds.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// Markings of one tree, from few leaves to many, in a row: at 1 the rule's own marks; towards 0 ever fewer
/// leaves are refined, those of the smallest indicators dropping out first (sizes: all wanted sizes grow, up
/// to sixteenfold); towards -1 ever more leaves are coarsened, in the end all.
class MarkFamily {
 public:
  /// The communicator and what is solved must outlive the family. With a mirror axis leaves that are each
  /// other's images are marked alike. *Collective.* Throws InputError as plan_adaptation does.
  MarkFamily(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
             std::optional<MirrorAxis> mirror = {});

  /// From -1 to 1. *Collective.*
  std::vector<Mark> marks(double at) const;

  double mean() const { return statistics_.mean; }
  double deviation() const { return statistics_.deviation; }
  /// Whether all leaves have the same indicator, which marks none.
  bool flat() const { return statistics_.flat; }

 private:
  std::vector<Mark> size_marks(double at) const;

  const SolvedMesh& solved_;
  bool by_size_;
  std::vector<double> values_;          ///< of each leaf: its indicator, or the size wanted in it
  std::optional<OrderedValues> order_;  ///< of indicators
  IndicatorStatistics statistics_;
  Thresholds rule_;
  double refined_share_ = 1, coarsened_share_ = 0;  ///< of the leaves with cells, by the rule
};

}  // namespace quadloop
